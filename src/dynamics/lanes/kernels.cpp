// Compiled once per instruction set (CMakeLists.txt).
#define HWY_COMPILE_ONLY_STATIC
#include "dynamics/lanes/kernels.hpp"

#include "dynamics/lanes/explicit_kernel.hpp"
#include "dynamics/lanes/implicit_kernel.hpp"
#include "dynamics/lanes/tableau.hpp"

namespace bristle::HWY_NAMESPACE {

extern const Kernels kKernels;
const Kernels kKernels = {hwy::TargetName(HWY_TARGET), Kernel<ExplicitStep<DormandPrince5>>::run,
                          Kernel<AdditiveStep<KennedyCarpenter4>>::run};

}  // namespace bristle::HWY_NAMESPACE
