# Refuses flags of compiler and linker that change numbers. Such a program would compute other bits under the same
# commit. No list of them is complete: the program itself looks at its numbers, too (src/bristle/simd/probe.cpp).
set(arithmetic_flags
  # GCC and clang. A linker driven by one of the first four makes the program flush subnormal numbers to zero.
  "-Ofast" "-ffast-math" "-funsafe-math-optimizations" "-mdaz-ftz"
  "-fassociative-math" "-freciprocal-math" "-ffinite-math-only" "-fno-signed-zeros" "-fsingle-precision-constant"
  "-ffp-contract=(fast|on|fast-honor-pragmas)" "-fexcess-precision=(fast|16)" "-mrecip(=.*)?" "-fcx-.*"
  "-mfpmath=.*(387|both).*" "-mno-sse2?" "-m32" "-mpc(32|64|80)"
  # clang and compilers that derive from it
  "-ffp-model=(fast|aggressive)" "-fp-model=?(fast.*)?" "-ffp-eval-method=(double|extended)" "-fdenormal-fp-math.*"
  "-fapprox-func" "-fno-honor-(nans|infinities)" "-menable-(unsafe-fp-math|no-nans|no-infs)" "-fp-contract=(fast|on)"
  "-enable-(unsafe-fp-math|no-nans-fp-math|no-infs-fp-math|no-signed-zeros-fp-math)")

# refuse_arithmetic_flags(WHERE FLAGS): fails if FLAGS, which came from WHERE, has one of them.
function(refuse_arithmetic_flags where flags)
  separate_arguments(flags UNIX_COMMAND "${flags}")
  foreach(flag IN LISTS flags)
    string(REGEX REPLACE "^-Wl,|^SHELL:" "" flag "${flag}")
    string(REGEX REPLACE "^@" "" file "${flag}")
    if(NOT file STREQUAL flag AND EXISTS "${file}")  # a file of more flags
      file(READ "${file}" more)
      refuse_arithmetic_flags("${where}, ${file}" "${more}")
    endif()
    foreach(pattern IN LISTS arithmetic_flags)
      if(flag MATCHES "^${pattern}$")
        message(FATAL_ERROR "${where}: ${flag} changes numbers, and the same commit of bristle has the same bits "
          "everywhere. Remove the flag there (it may be from CXXFLAGS or LDFLAGS), remove "
          "${CMAKE_BINARY_DIR}/CMakeCache.txt, which keeps it, and configure again.")
      endif()
    endforeach()
  endforeach()
endfunction()

foreach(name CMAKE_CXX_FLAGS CMAKE_EXE_LINKER_FLAGS)
  foreach(config "" ${CMAKE_BUILD_TYPE} ${CMAKE_CONFIGURATION_TYPES})
    string(TOUPPER "${name}_${config}" variable)
    string(REGEX REPLACE "_$" "" variable ${variable})
    refuse_arithmetic_flags(${variable} "${${variable}}")
  endforeach()
endforeach()
refuse_arithmetic_flags("the compiler's command (CXX)" "${CMAKE_CXX_COMPILER_ARG1}")
refuse_arithmetic_flags(BRISTLE_KERNEL_OPTIMISATION "${BRISTLE_KERNEL_OPTIMISATION}")
foreach(property COMPILE_OPTIONS LINK_OPTIONS)
  get_directory_property(options ${property})
  list(JOIN options " " options)
  refuse_arithmetic_flags("${property} of the folder" "${options}")
endforeach()
