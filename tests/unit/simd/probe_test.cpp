#include "results/version.hpp"
#include "bristle/simd/dispatch.hpp"
#include "bristle/simd/probe.hpp"
#include "util/error.hpp"

#include "catch.hpp"
#include <cfenv>
#include <fmt/format.h>

namespace bristle::probe_test {
using Catch::Contains;

TEST_CASE("probe: the stored bits of a passage are those that it has") {
  const std::string advice = fmt::format(
      "If the numerics of a passage were changed on purpose: raise kNumericsVersion, now {} "
      "(src/results/version.hpp), and set in src/bristle/simd/probe.hpp kPassageBits = {:#x} and "
      "kReferencePassageBits = {:#x}",
      results::kNumericsVersion, passage_bits(best_kernels()), reference_passage_bits());
  for (const Kernels* kernels : available_kernels()) {
    INFO(kernels->target << ". " << advice);
    CHECK(passage_bits(*kernels) == kPassageBits);
  }
  INFO(advice);
  CHECK(reference_passage_bits() == kReferencePassageBits);
  CHECK_NOTHROW(require_same_bits());
}

TEST_CASE("probe: a process that rounds otherwise is refused") {
  const auto message = [](int rounding) {
    std::string text = "(not refused)";
    std::fesetround(rounding);
    try {
      require_same_bits();
    } catch (const ArithmeticError& e) {
      text = e.what();
    }
    std::fesetround(FE_TONEAREST);
    return text;
  };
  for (const int rounding : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO})
    CHECK_THAT(message(rounding), Contains("sums are not rounded to the nearest number") &&
                                      Contains("LD_PRELOAD") && Contains("nothing was computed"));
  CHECK_NOTHROW(require_same_bits());
}

}  // namespace bristle::probe_test
