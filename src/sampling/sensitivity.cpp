#include "sampling/sensitivity.hpp"

#include "bristle/random.hpp"
#include "bristle/ensemble/sobol.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bristle {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kResamples = 200;
// Limits of an index. With an error above kLargestError all possible indices, 0 to 1, lie within the error.
// An index that is outside of 0 to 1 by more than kOutside and more than kOutsideErrors errors is not noise
// of the sample: the points with a value are not alike.
constexpr double kLargestError = 0.5, kOutside = 0.1, kOutsideErrors = 3;

// Returns the standard deviation of a statistic over resamples of `size` items, which are drawn with
// replacement. The draws are the same each time.
template <class Statistic>
std::vector<double> bootstrap_errors(std::size_t size, const Statistic& statistic) {
  std::vector<double> sum, sum_of_squares;
  std::uint64_t state = 0;
  std::vector<std::size_t> drawn(size);
  for (std::size_t k = 0; k < kResamples; ++k) {
    for (std::size_t& i : drawn) i = std::size_t(split_mix(state++ * kSplitMixStep) % size);
    const std::vector<double> values = statistic(drawn);
    sum.resize(values.size());
    sum_of_squares.resize(values.size());
    for (std::size_t v = 0; v < values.size(); ++v) {
      sum[v] += values[v];
      sum_of_squares[v] += values[v] * values[v];
    }
  }
  std::vector<double> errors;
  const double n = kResamples;
  for (std::size_t v = 0; v < sum.size(); ++v) {
    const double variance = (sum_of_squares[v] - sum[v] * sum[v] / n) / (n - 1);
    errors.push_back(variance < 0 ? 0 : std::sqrt(variance));
  }
  return errors;
}

// The values of a block of the design, minus the first finite value of all blocks, so that constant values
// have no variance.
struct Block {
  double a, b;
  std::vector<double> mixed;  // values at a with the coordinate of b, by input
};

std::vector<Block> blocks_of(const std::vector<double>& values, std::size_t inputs) {
  std::vector<Block> blocks;
  for (auto at = values.begin(); at != values.end(); at += long(inputs) + 2)
    blocks.push_back({at[0], at[1], {at + 2, at + 2 + long(inputs)}});
  const auto first = std::ranges::find_if(values, [](double value) { return std::isfinite(value); });
  const double origin = first == values.end() ? 0 : *first;
  for (Block& block : blocks) {
    block.a -= origin;
    block.b -= origin;
    for (double& value : block.mixed) value -= origin;
  }
  return blocks;
}

// The mean and the variance of the points that are drawn independently, as far as they have a value.
struct Moments {
  double mean, variance;
};
Moments moments_of(const std::vector<Block>& blocks, const std::vector<std::size_t>& drawn) {
  double n = 0, sum = 0, sum_of_squares = 0;
  for (const std::size_t j : drawn) {
    const bool has_a = std::isfinite(blocks[j].a), has_b = std::isfinite(blocks[j].b);
    const double a = has_a ? blocks[j].a : 0, b = has_b ? blocks[j].b : 0;
    n += has_a + has_b;
    sum += a + b;
    sum_of_squares += a * a + b * b;
  }
  const double mean = sum / n;
  return {mean, sum_of_squares / n - mean * mean};
}

bool has_pair(const Block& block, std::size_t input) {
  return std::isfinite(block.a) && std::isfinite(block.mixed[input]);
}
bool has_triple(const Block& block, std::size_t input) {
  return has_pair(block, input) && std::isfinite(block.b);
}

// Returns the first-order indices, then the total ones.
std::vector<double> estimates(const std::vector<Block>& blocks, const std::vector<std::size_t>& drawn,
                              std::size_t inputs) {
  const auto [mean, variance] = moments_of(blocks, drawn);
  std::vector<double> out(2 * inputs, kNone);
  if (!(variance > 0)) return out;
  for (std::size_t i = 0; i < inputs; ++i) {
    double pairs = 0, triples = 0, products = 0, changes = 0, squares = 0;
    for (const std::size_t j : drawn) {
      if (!has_pair(blocks[j], i)) continue;
      const double change = blocks[j].mixed[i] - blocks[j].a;
      squares += change * change;
      ++pairs;
      if (!has_triple(blocks[j], i)) continue;
      products += blocks[j].b * change;
      changes += change;
      ++triples;
    }
    out[i] = (products - mean * changes) / (triples * variance);
    out[inputs + i] = squares / (2 * pairs * variance);
  }
  return out;
}

std::vector<std::size_t> all_of(std::size_t size) {
  std::vector<std::size_t> all(size);
  for (std::size_t i = 0; i < size; ++i) all[i] = i;
  return all;
}

}  // namespace

std::vector<std::vector<double>> saltelli_design(std::size_t base_points, std::size_t inputs,
                                                 std::uint64_t seed) {
  std::vector<std::vector<double>> out;
  for (const std::vector<double>& both : sobol_points(base_points, 2 * inputs, seed)) {
    const std::vector<double> a(both.begin(), both.begin() + long(inputs)),
        b(both.begin() + long(inputs), both.end());
    out.push_back(a);
    out.push_back(b);
    for (std::size_t i = 0; i < inputs; ++i) {
      out.push_back(a);
      out.back()[i] = b[i];
    }
  }
  return out;
}

SobolIndices sobol_indices(const std::vector<double>& values, std::size_t inputs) {
  const std::vector<Block> blocks = blocks_of(values, inputs);
  const std::size_t n = blocks.size();
  const std::vector<double> indices = estimates(blocks, all_of(n), inputs);
  const std::vector<double> errors =
      bootstrap_errors(n, [&](const auto& drawn) { return estimates(blocks, drawn, inputs); });
  SobolIndices out;
  const auto add = [&](std::vector<SobolIndex>& list, std::size_t i, std::size_t count) {
    const double value = indices[i], error = errors[i];
    // Where a resample has no variance, nearly all values are the same, and the error is NaN.
    const bool possible =
        error <= kLargestError && std::abs(value - 0.5) <= 0.5 + std::fmax(kOutside, kOutsideErrors * error);
    if (count >= kLeastBlocks && possible) list.push_back({{value, error}, count});
    else list.push_back({{kNone, kNone}, count});
  };
  for (std::size_t i = 0; i < inputs; ++i) {
    add(out.first, i,
        std::size_t(std::ranges::count_if(blocks, [&](const Block& b) { return has_triple(b, i); })));
    add(out.total, inputs + i,
        std::size_t(std::ranges::count_if(blocks, [&](const Block& b) { return has_pair(b, i); })));
  }
  return out;
}

Quantity quantile(std::vector<double> values, double share) {
  if (values.empty()) return {kNone, kNone};
  std::ranges::sort(values);
  const auto of = [&](std::vector<std::size_t> places) {  // sorted values at sorted places
    std::ranges::sort(places);
    const double at = share * double(places.size() - 1);
    const auto low = std::size_t(at);
    const double below = values[places[low]], above = values[places[std::min(low + 1, places.size() - 1)]];
    return below + (above - below) * (at - double(low));
  };
  if (values.size() == 1) return {values.front(), kNone};
  return {of(all_of(values.size())),
          bootstrap_errors(values.size(), [&](const auto& drawn) { return std::vector{of(drawn)}; }).front()};
}

}  // namespace bristle
