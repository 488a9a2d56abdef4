# add_kernels(NAME SOURCE): sets NAME to the list of object files of SOURCE, one per instruction set with fused
# multiply-add. The kernels are optimised in every build type, because without inlining they are too slow to use.
set(BRISTLE_KERNEL_OPTIMISATION -O3 CACHE STRING "optimisation of the SIMD kernels in every build type")

function(add_kernels_for target prefix source)
  set(name ${prefix}_${target})
  add_library(${name} OBJECT ${source})
  target_link_libraries(${name} PRIVATE options PkgConfig::SLEEF)
  # Without debugging information, sanitizers and coverage, with which compiling this heavily inlined code takes ten
  # minutes. The kernels allocate no memory.
  target_compile_options(${name} PRIVATE ${BRISTLE_KERNEL_OPTIMISATION} -g0 -fno-sanitize=all
    -fno-profile-arcs -fno-test-coverage ${ARGN})
  if(target STREQUAL "SCALAR")
    set(only HWY_COMPILE_ONLY_SCALAR)
  else()
    set(only HWY_COMPILE_ONLY_STATIC)
  endif()
  target_compile_definitions(${name} PRIVATE BRISTLE_TARGET=HWY_${target} ${only} NDEBUG)
  set(${prefix} ${${prefix}} $<TARGET_OBJECTS:${name}> PARENT_SCOPE)
endfunction()

macro(add_kernels prefix source)
  set(${prefix})
  add_kernels_for(SCALAR ${prefix} ${source})
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    set(avx2 -mavx2 -mbmi -mbmi2 -mfma -mf16c -maes -mpclmul)
    add_kernels_for(AVX2 ${prefix} ${source} ${avx2})
    add_kernels_for(AVX3 ${prefix} ${source} ${avx2} -mavx512f -mavx512vl -mavx512dq -mavx512bw -mavx512cd)
  else()
    # Highway's target includes the instructions for AES.
    add_kernels_for(NEON ${prefix} ${source} -march=armv8-a+crypto)
  endif()
endmacro()
