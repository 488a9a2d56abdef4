#pragma once

namespace bristle {

// Loops of independent vector operations, for their throughput: kChains n of them are executed. The result
// is only there to be used.
struct Rates {
  static constexpr int kChains = 12;  // enough to hide the latency of a multiply-add
  double (*multiply_adds)(long n);
  double (*divisions)(long n);
};

}  // namespace bristle
