#include "sampling/sensitivity.hpp"

#include "catch.hpp"
#include <cmath>
#include <functional>
#include <limits>

namespace bristle::sensitivity_test {
namespace {

using Function = std::function<double(const std::vector<double>&)>;

std::vector<double> values_of(const Function& f, std::size_t blocks, std::size_t inputs,
                              std::uint64_t seed = 1) {
  std::vector<double> values;
  for (const auto& point : saltelli_design(blocks, inputs, seed)) values.push_back(f(point));
  return values;
}

double ishigami(const std::vector<double>& u) {
  const auto x = [&](std::size_t i) { return M_PI * (2 * u[i] - 1); };
  return std::sin(x(0)) + 7 * std::pow(std::sin(x(1)), 2) + 0.1 * std::pow(x(2), 4) * std::sin(x(0));
}

// T. Ishigami, T. Homma, ISUMA 1990, with a = 7 and b = 0.1
const double kFirst[] = {0.3139, 0.4424, 0}, kTotal[] = {0.5576, 0.4424, 0.2437};

}  // namespace

TEST_CASE("Sobol indices of Ishigami's function") {
  const SobolIndices found = sobol_indices(values_of(ishigami, 4096, 3), 3);
  CHECK(found.total[2].blocks == 4096);
  CHECK(found.first[2].blocks == 4096);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(std::abs(found.first[i].value - kFirst[i]) < 3 * found.first[i].error + 1e-3);
    CHECK(std::abs(found.total[i].value - kTotal[i]) < 3 * found.total[i].error + 1e-3);
    CHECK(found.first[i].error < 0.04);
    CHECK(found.total[i].error < 0.04);
  }
}

TEST_CASE("the errors of Sobol indices cover their deviations over seeds, and are not far too large") {
  int inside = 0, all = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const SobolIndices found = sobol_indices(values_of(ishigami, 256, 3, seed), 3);
    for (std::size_t i = 0; i < 3; ++i) {
      inside += std::abs(found.total[i].value - kTotal[i]) < 2 * found.total[i].error;
      inside += std::abs(found.first[i].value - kFirst[i]) < 2 * found.first[i].error;
      all += 2;
      CHECK(found.total[i].error < 0.15);
    }
  }
  CHECK(inside >= 0.9 * all);
}

TEST_CASE("an additive function: first-order and total indices are the shares of the variance") {
  const SobolIndices found =
      sobol_indices(values_of([](const auto& u) { return 1e6 + 3 * u[0] + 4 * u[1]; }, 1024, 3), 3);
  const double shares[] = {9.0 / 25, 16.0 / 25, 0};
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(found.first[i].value == Approx(shares[i]).margin(0.01));
    CHECK(found.total[i].value == Approx(shares[i]).margin(0.01));
  }
}

TEST_CASE("a constant function has no indices, and missing values cost the pairs that need them only") {
  const SobolIndices constant = sobol_indices(values_of([](const auto&) { return 0.1; }, 64, 2), 2);
  CHECK(std::isnan(constant.total[0].value));
  CHECK(std::isnan(constant.first[1].error));
  auto values = values_of(ishigami, 512, 3);
  for (const std::size_t i : {7, 8, 1000, 2006}) values[i] = std::numeric_limits<double>::quiet_NaN();
  // Missing are input 0 of block 1, input 1 of block 1, the point a of block 200, and the point b of block
  // 401.
  const SobolIndices found = sobol_indices(values, 3);
  const std::size_t pairs[] = {510, 510, 511};
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(found.total[i].blocks == pairs[i]);
    CHECK(found.first[i].blocks == pairs[i] - 1);
    CHECK(found.total[i].value == Approx(kTotal[i]).margin(3 * found.total[i].error));
    CHECK(found.first[i].value == Approx(kFirst[i]).margin(3 * found.first[i].error));
  }
  CHECK(std::isnan(sobol_indices(std::vector<double>(5, NAN), 3).total[0].value));
}

TEST_CASE("total indices use every pair, also where no block has all values") {
  auto values = values_of(ishigami, 4096, 3);
  // In turn, one of the points of a block has no value: b, or a with a coordinate of b.
  for (std::size_t block = 0; block < 4096; ++block) values[5 * block + 1 + block % 4] = NAN;
  const SobolIndices found = sobol_indices(values, 3);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(found.total[i].blocks == 3072);
    CHECK(found.first[i].blocks == 2048);
    CHECK(found.total[i].value == Approx(kTotal[i]).margin(3 * found.total[i].error + 1e-3));
    CHECK(found.first[i].value == Approx(kFirst[i]).margin(3 * found.first[i].error + 1e-3));
  }
}

TEST_CASE("an index from too few pairs, or with an error that covers all indices, has no value") {
  for (std::uint64_t seed = 0; seed < 200; ++seed)
    for (const std::size_t with_values : {1, 2, 4, 15, 16, 20}) {
      auto values = values_of(ishigami, 64, 3, seed);
      for (std::size_t i = 5 * with_values; i < values.size(); ++i) values[i] = NAN;
      const SobolIndices found = sobol_indices(values, 3);
      for (const auto* list : {&found.first, &found.total})
        for (const SobolIndex& index : *list) {
          CHECK(index.blocks == with_values);
          if (with_values < kLeastBlocks) CHECK(std::isnan(index.value));
          CHECK(std::isnan(index.value) == std::isnan(index.error));
          if (std::isnan(index.value)) continue;
          CHECK(index.error <= 0.5);
          CHECK(std::abs(index.value - 0.5) <= 0.5 + std::fmax(0.1, 3 * index.error));
        }
    }
}

TEST_CASE("a longer design begins with the shorter one") {
  const auto few = saltelli_design(8, 3, 5), more = saltelli_design(64, 3, 5);
  REQUIRE(few.size() == 40);
  CHECK(std::equal(few.begin(), few.end(), more.begin()));
  CHECK(few[2][0] == few[1][0]);
  CHECK(few[2][1] == few[0][1]);
}

TEST_CASE("quantiles and their errors") {
  CHECK(quantile({3, 1, 2}, 0.5).value == 2);
  CHECK(quantile({0, 1}, 0.25).value == 0.25);
  CHECK(quantile({4}, 0.95).value == 4);
  CHECK(std::isnan(quantile({4}, 0.95).error));  // one value says nothing about its error
  CHECK(std::isnan(quantile({}, 0.5).value));
  // Of n uniform values the median's standard error is 1/(2 sqrt(n)).
  std::vector<double> uniform;
  for (int i = 0; i < 1000; ++i) uniform.push_back(i / 1000.0);
  CHECK(quantile(uniform, 0.5).error == Approx(0.5 / std::sqrt(1000)).epsilon(0.2));
}

}  // namespace bristle::sensitivity_test
