// Compiled once per instruction set (CMakeLists.txt).
#define HWY_COMPILE_ONLY_STATIC
#include "simd/kernels.hpp"

#include "simd/explicit_kernel.hpp"
#include "simd/implicit_kernel.hpp"
#include "simd/tableau.hpp"

// A missing compiler option would silently choose a lesser set.
static_assert(HWY_TARGET == BRISTLE_TARGET, "not the instruction set that this file is compiled for");

namespace bristle::HWY_NAMESPACE {

extern const Kernels kKernels;
const Kernels kKernels = {hwy::TargetName(HWY_TARGET), Lanes::kWidth, Kernel<ExplicitStep<CashKarp5>>::run,
                          Kernel<AdditiveStep<KennedyCarpenter4>>::run};

}  // namespace bristle::HWY_NAMESPACE
