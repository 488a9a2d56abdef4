# find_package(bristle) defines bristle::bristle: what computes a brush (docs/running.md).
include(CMakeFindDependencyMacro)
find_dependency(Boost COMPONENTS context)
find_dependency(PkgConfig)
pkg_check_modules(SLEEF REQUIRED IMPORTED_TARGET sleef)
pkg_check_modules(HWY REQUIRED IMPORTED_TARGET libhwy)
include(${CMAKE_CURRENT_LIST_DIR}/bristleTargets.cmake)
