#include "compare/comparison.hpp"
#include "shards.hpp"

#include "catch.hpp"

// Results of samples are compared by the values of their rows.
namespace bristle::rows_test {
using namespace testing;
using Catch::Contains;

namespace {

// A result of a table. The numbers of a row follow from its k_r.
std::string result_of(const Scratch& s, const std::string& name, const std::string& table,
                      const std::string& take = "") {
  s.write("paper.json", bytes_of(std::string(BRISTLE_EXPERIMENTS) + "/paper.json"));
  s.write(name + ".csv", table);
  const Experiment e =
      load_experiment(s.write(name + ".json", R"({"extends": "paper.json", "name": "n", "sweep": {"sample": {
      "table": ")" + name + R"(.csv")" + take + "}}}"),
                      {});
  return small_result(s, name + ".h5", e, [&](std::size_t i, PointResult& p) {
    p = small_point(std::size_t(e.sweep.axes.front().columns.front().values[i]));
  });
}

Comparison diff(const std::string& a, const std::string& b) {
  return diff_results(ResultReader(a), ResultReader(b), {});
}

}  // namespace

TEST_CASE("rows of samples are found by their values, in any order") {
  const Scratch s;
  const std::string a = result_of(s, "a", "k_r,friction\n5,nss\n20,nss\n9,coulomb\n");
  const Comparison other_order = diff(a, result_of(s, "b", "k_r,friction\n9,coulomb\n5,nss\n20,nss\n"));
  CHECK(other_order.agree());
  CHECK_THAT(other_order.notes.at(0), Contains("sample: the rows of") && Contains("have another order"));
  const Comparison part =
      diff(a, result_of(s, "c", "k_r,friction\n1,nss\n9,coulomb\n20,nss\n", R"(, "take": [1, 2])"));
  CHECK(part.differences.empty());
  CHECK_THAT(part.failures.at(0), Contains("sample: different rows: 3 in") && Contains(", 2 of them in"));
  CHECK(part.points == 2);
}

TEST_CASE("rows and columns of samples that differ are named and not compared") {
  const Scratch s;
  const std::string a = result_of(s, "a", "k_r,friction\n5,nss\n20,nss\n");
  const Comparison rows = diff(a, result_of(s, "b", "k_r,friction\n5,coulomb\n20,nss\n"));
  CHECK_FALSE(rows.agree());
  CHECK(rows.differences.empty());
  CHECK_THAT(rows.failures.at(0), Contains("sample: different rows: 1 of the 2 rows of") &&
                                      Contains("row 0 (k_r = 5, friction = coulomb)"));
  const Comparison columns = diff(a, result_of(s, "c", "k_r,k_theta\n5,1\n20,1\n"));
  CHECK(columns.differences.empty());
  CHECK_THAT(comparison_text(columns),
             Contains("sample: different columns: k_r, friction in") && Contains("k_r, k_theta in"));
}

TEST_CASE("a reference states the rows of its sample") {
  const Scratch s;
  const std::string smoke =
      result_of(s, "smoke", "k_r,friction\n5,nss\n20,nss\n9,coulomb\n", R"(, "take": [1, 2])");
  Json reference = reference_of(smoke);
  CHECK(reference["sample"] == Json({{"k_r", {20, 9}}, {"friction", {"nss", "coulomb"}}}));
  const auto compared = [&](const std::string& file) {
    return compare_with(ResultReader(file), {}, reference, "r.json");
  };
  CHECK(compared(smoke).agree());
  const Comparison full = compared(result_of(s, "full", "k_r,friction\n5,nss\n20,nss\n9,coulomb\n"));
  CHECK(full.agree());
  CHECK(full.points == 2);
  const std::string other = result_of(s, "other", "k_r,friction\n5,nss\n20,nss\n");
  CHECK_THAT(compared(other).failures.at(0), Contains("row 1 (k_r = 9, friction = coulomb)"));
  reference.erase("sample");
  CHECK_THAT(compared(other).failures.at(0), Contains("r.json does not state the rows of its sample"));
  CHECK(compared(smoke).agree());
  reference["sample"] = {{"k_r", {20}}};
  CHECK_THROWS_WITH(compared(smoke), Contains("/sample/k_r: 1 values, but the sample has 2 rows"));
}

}  // namespace bristle::rows_test
