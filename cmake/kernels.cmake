# lane_kernels: object files of src/dynamics/lanes/kernels.cpp, one per instruction set that the compiler knows and that has
# fused multiply-add. Optimised in every build type: nothing of them is inlined otherwise.
set(lane_kernels)
function(add_lane_kernels target)
  set(name kernels_${target})
  add_library(${name} OBJECT src/dynamics/lanes/kernels.cpp)
  target_link_libraries(${name} PRIVATE options Eigen3::Eigen)
  target_compile_options(${name} PRIVATE -O3 ${ARGN})
  target_compile_definitions(${name} PRIVATE BRISTLE_TARGET=HWY_${target} NDEBUG)
  set(lane_kernels ${lane_kernels} $<TARGET_OBJECTS:${name}> PARENT_SCOPE)
endfunction()

if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  set(avx2 -mavx2 -mbmi -mbmi2 -mfma -mf16c -maes -mpclmul)
  add_lane_kernels(AVX2 ${avx2})
  add_lane_kernels(AVX3 ${avx2} -mavx512f -mavx512vl -mavx512dq -mavx512bw -mavx512cd)
else()
  add_lane_kernels(NEON)
endif()
