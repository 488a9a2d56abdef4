#include "util/sensitivity.hpp"

#include "util/random.hpp"
#include "util/sobol.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bristle {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kResamples = 200;

// The standard deviation of a statistic over resamples of `size` items, which are drawn with replacement. The
// same draws each time.
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

// A block of the design. One of the values is subtracted from all, so that constant values have no variance.
struct Block {
  double a, b;
  std::vector<double> mixed;  // a with the coordinate of b, by input
};

std::vector<Block> complete_blocks(const std::vector<double>& values, std::size_t inputs) {
  std::vector<Block> blocks;
  for (auto at = values.begin(); at != values.end(); at += long(inputs) + 2)
    if (std::all_of(at, at + long(inputs) + 2, [](double v) { return std::isfinite(v); }))
      blocks.push_back({at[0], at[1], {at + 2, at + 2 + long(inputs)}});
  return blocks;
}

// First-order indices, then total ones.
std::vector<double> estimates(const std::vector<Block>& blocks, const std::vector<std::size_t>& drawn,
                           std::size_t inputs) {
  const double n = double(drawn.size());
  double sum = 0, sum_of_squares = 0;
  std::vector<double> products(inputs), changes(inputs), squares(inputs);
  for (const std::size_t j : drawn) {
    const Block& block = blocks[j];
    sum += block.a + block.b;
    sum_of_squares += block.a * block.a + block.b * block.b;
    for (std::size_t i = 0; i < inputs; ++i) {
      const double change = block.mixed[i] - block.a;
      products[i] += block.b * change;
      changes[i] += change;
      squares[i] += change * change;
    }
  }
  const double mean = sum / (2 * n), variance = sum_of_squares / (2 * n) - mean * mean;
  std::vector<double> out;
  for (std::size_t i = 0; i < inputs; ++i)
    out.push_back(variance > 0 ? (products[i] - mean * changes[i]) / (n * variance) : kNone);
  for (const double square : squares) out.push_back(variance > 0 ? square / (2 * n * variance) : kNone);
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
    const std::vector<double> a(both.begin(), both.begin() + long(inputs)), b(both.begin() + long(inputs), both.end());
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
  std::vector<Block> blocks = complete_blocks(values, inputs);
  const std::size_t n = blocks.size();
  SobolIndices out{std::vector<Estimate>(inputs, {kNone, kNone}), std::vector<Estimate>(inputs, {kNone, kNone}), n};
  if (n < 2) return out;
  const double origin = blocks.front().a;
  for (Block& block : blocks) {
    block.a -= origin;
    block.b -= origin;
    for (double& value : block.mixed) value -= origin;
  }
  const std::vector<double> indices = estimates(blocks, all_of(n), inputs);
  const std::vector<double> errors =
      bootstrap_errors(n, [&](const auto& drawn) { return estimates(blocks, drawn, inputs); });
  // Where a resample has no variance, nearly all values are the same, and an index would be noise.
  if (!std::ranges::all_of(errors, [](double one) { return std::isfinite(one); })) return out;
  for (std::size_t i = 0; i < inputs; ++i) {
    out.first[i] = {indices[i], errors[i]};
    out.total[i] = {indices[inputs + i], errors[inputs + i]};
  }
  return out;
}

Estimate quantile(std::vector<double> values, double share) {
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
