// Compiled once per instruction set (cmake/kernels.cmake).
#include "bristle/simd/kernels.hpp"

#include "bristle/simd/step.hpp"
#include "bristle/simd/tableau.hpp"

// Without the compiler options of the instruction set, Highway would silently select a lower one.
// NOLINTNEXTLINE(misc-redundant-expression)
static_assert(HWY_TARGET == BRISTLE_TARGET,
              "the compiler options do not enable the instruction set BRISTLE_TARGET");

namespace bristle::HWY_NAMESPACE {

extern const Kernels kKernels;
const Kernels kKernels = {
    hwy::TargetName(HWY_TARGET), Lanes::kWidth, AdditiveKernel<KennedyCarpenter4, FarFromPole>::run,
    AdditiveKernel<KennedyCarpenter4, NearPole>::run, AdditiveKernel<KennedyCarpenter4, WithoutPole>::run};

}  // namespace bristle::HWY_NAMESPACE
