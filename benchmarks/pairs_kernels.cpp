// Compiled once per instruction set, like src/simd/kernels.cpp.
#include "simd/explicit_kernel.hpp"
#include "pairs.hpp"

namespace bristle::HWY_NAMESPACE {

using Steps = Events (*)(Block&);
extern const Steps kOtherPairs[3];
const Steps kOtherPairs[3] = {Kernel<ExplicitStep<DormandPrince5>>::run,
                              Kernel<ExplicitStep<Tsitouras5>>::run,
                              Kernel<ExplicitStep<DormandPrince8>>::run};

}  // namespace bristle::HWY_NAMESPACE
