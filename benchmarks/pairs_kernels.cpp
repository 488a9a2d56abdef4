// Compiled once per instruction set, like src/bristle/simd/kernels.cpp.
#include "bristle/simd/step.hpp"
#include "pairs.hpp"
#include "rates.hpp"

namespace bristle::HWY_NAMESPACE {

using Steps = Events (*)(Block&);
extern const Steps kOtherPairs[3];
const Steps kOtherPairs[3] = {AdditiveKernel<KennedyCarpenter3, FarFromPole>::run,
                              AdditiveKernel<KennedyCarpenter4Later, FarFromPole>::run,
                              AdditiveKernel<KennedyCarpenter5, FarFromPole>::run};

namespace {

template <class Operation>
double repeat(long n, Operation operation) {
  Lanes chain[Rates::kChains];
  for (int i = 0; i < Rates::kChains; ++i) chain[i] = 1.0 + i;
  for (long i = 0; i < n; ++i)
    for (Lanes& x : chain) x = operation(x);
  Lanes sum = 0.0;
  for (const Lanes& x : chain) sum += x;
  return hn::GetLane(sum.v);
}

}  // namespace

extern const Rates kRates;
const Rates kRates = {
    [](long n) { return repeat(n, [](Lanes x) -> Lanes { return x * Lanes(0.5) + Lanes(1.0); }); },
    [](long n) { return repeat(n, [](Lanes x) -> Lanes { return Lanes(2.0) / x; }); }};

}  // namespace bristle::HWY_NAMESPACE
