// The claims of Figure 4 on the smoke tier's points, as the CTest fixture computed them.
#include "checks/checks.hpp"

#include <catch2/catch.hpp>
#include <iostream>
#include <map>

using namespace bristle;

TEST_CASE("fig4 smoke: every point has values, and the claims' verdicts are those on record") {
  const ResultReader result(BRISTLE_FIG4_SMOKE);
  const Variable status = result.variable("status"), R_n = result.variable("R_n");
  REQUIRE(status.values.size() == 15);
  for (const double s : status.values) CHECK(s == 0);
  for (const double x : R_n.values) CHECK(x == Approx(2).epsilon(2e-3));
  const auto checks = evaluate_checks(result);
  std::cout << checks_table(checks);
  const std::map<std::string, Verdict> on_record = {
      {"4a", Verdict::supported}, {"4b", Verdict::supported}, {"4c", Verdict::supported},
      {"4d", Verdict::refuted},   {"4e", Verdict::supported}, {"4f", Verdict::supported},
  };
  REQUIRE(checks.size() == on_record.size());
  for (const CheckResult& c : checks) {
    CAPTURE(c.claim, c.measured.value);
    CHECK(to_string(c.verdict) == std::string(to_string(on_record.at(c.claim))));
  }
}
