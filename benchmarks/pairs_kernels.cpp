// Compiled once per instruction set, like src/simd/kernels.cpp.
#include "simd/step.hpp"
#include "pairs.hpp"

namespace bristle::HWY_NAMESPACE {

using Steps = Events (*)(Block&);
extern const Steps kOtherPairs[3];
const Steps kOtherPairs[3] = {AdditiveKernel<KennedyCarpenter3, FarFromPole>::run,
                              AdditiveKernel<KennedyCarpenter4Later, FarFromPole>::run,
                              AdditiveKernel<KennedyCarpenter5, FarFromPole>::run};

}  // namespace bristle::HWY_NAMESPACE
