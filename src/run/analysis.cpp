#include "run/analysis.hpp"

#include "experiment/sample.hpp"
#include "results/reader.hpp"
#include "util/error.hpp"
#include "util/grid.hpp"
#include "util/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

namespace bristle::run {
namespace {

// A function, because HDF5 must not be used before main().
results::Column ambiguous_column() {
  return {"ambiguous", "points that are used, whose load another gap carries as well", "", "",
          H5T_NATIVE_LONG};
}

const char* const kRemedy = "raise sobol, or choose ranges in which more points have a value";
const std::vector<double> kShares = {0.05, 0.25, 0.5, 0.75, 0.95};

using Values = std::map<std::string, std::vector<double>>;

const experiment::Axis& sample_of(const Experiment& e) {
  return e.sweep.axes[e.sweep.axis_number(experiment::kSample)];
}

// The sweep over the other axes.
Sweep others_of(const Experiment& e) { return e.sweep.without(experiment::kSample); }

// The values over the sample at a point of the other axes.
std::vector<double> over_sample(const Experiment& e, const std::vector<double>& values, std::size_t other) {
  const std::size_t sample = e.sweep.axis_number(experiment::kSample);
  const std::vector<std::size_t> shape = e.sweep.shape();
  auto at = unravel(other, others_of(e).shape());
  at.insert(at.begin() + long(sample), 0);
  std::vector<double> out;
  for (std::size_t i = 0; i < shape[sample]; ++i) {
    at[sample] = i;
    out.push_back(values[ravel(at, shape)]);
  }
  return out;
}

// The points of a sample that a statistic uses.
struct Used {
  std::vector<double> values;
  std::size_t ambiguous = 0;  // of these points, those whose load another gap carries as well
};

// The values at a point of the other axes. Of each block of the sample the first points count.
Used used_of(const Experiment& e, const Values& all, const std::string& output, std::size_t other,
             std::size_t block, std::size_t first) {
  const std::vector<double> values = over_sample(e, all.at(output), other),
                            statuses = over_sample(e, all.at("status"), other);
  Used out;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i]) || i % block >= first) continue;
    out.values.push_back(values[i]);
    out.ambiguous += statuses[i] == double(PointStatus::ambiguous);
  }
  return out;
}

// The points of a block of the design for indices, 1 without them.
std::size_t block_of(const Experiment& e) {
  return e.analysis.sobol_indices.empty() ? 1 : sample_of(e).columns.size() + 2;
}

std::vector<std::size_t> other_axes(const Experiment& e) {
  std::vector<std::size_t> out;
  for (std::size_t axis = 0; axis < e.sweep.axes.size(); ++axis)
    if (e.sweep.axes[axis].name != experiment::kSample) out.push_back(axis);
  return out;
}

std::vector<std::string> inputs_of(const Experiment& e) {
  std::vector<std::string> names;
  for (const experiment::Axis& column : sample_of(e).columns) names.push_back(column.name);
  return names;
}

results::Group indices(const Experiment& e, const Values& values) {
  const std::vector<std::string>&outputs = e.analysis.sobol_indices, inputs = inputs_of(e);
  results::Group group{"indices",
                       other_axes(e),
                       {results::word_dimension("output", "variable whose variance is shared out", outputs),
                        results::word_dimension("input", "parameter of the sample", inputs)},
                       index_columns(),
                       {}};
  group.columns.push_back(ambiguous_column());
  group.values.resize(group.columns.size());
  for (std::size_t other = 0; other < others_of(e).size(); ++other)
    for (const std::string& output : outputs) {
      add_indices(group, sobol_indices(over_sample(e, values.at(output), other), inputs.size()));
      group.values.back().resize(group.values.front().size(),
                                 double(used_of(e, values, output, other, 1, 1).ambiguous));
    }
  return group;
}

results::Group quantiles(const Experiment& e, const Values& values) {
  const std::vector<std::string>& outputs = e.analysis.quantiles;
  results::Group group{
      "quantiles",
      other_axes(e),
      {results::word_dimension("output", "variable", outputs),
       {{"share", "share of the sample below the quantile", "p", ""}, {}, kShares}},
      {{"quantile", "quantile of the variable over the sample", "", ""},
       {"quantile_err", "standard error of the quantile", "", ""},
       {"points", "points that are used: drawn independently and with a value", "", "", H5T_NATIVE_LONG},
       ambiguous_column()},
      std::vector<std::vector<double>>(4)};
  const std::size_t block = block_of(e), independent = std::min<std::size_t>(block, 2);
  for (std::size_t other = 0; other < others_of(e).size(); ++other)
    for (const std::string& output : outputs) {
      const Used used = used_of(e, values, output, other, block, independent);
      for (const double share : kShares) {
        const Estimate q = quantile(used.values, share);
        const double row[] = {q.value, q.error, double(used.values.size()), double(used.ambiguous)};
        for (std::size_t column = 0; column < std::size(row); ++column)
          group.values[column].push_back(row[column]);
      }
    }
  return group;
}

// Reads one row of indices back from a group, as add_indices() has written it.
SobolIndices indices_of(const results::Group& group, std::size_t row) {
  const std::size_t inputs = group.dimensions[1].words.size();
  SobolIndices out;
  for (std::size_t at = row * inputs; at < (row + 1) * inputs; ++at) {
    out.first.push_back({group.values[0][at], group.values[1][at], std::size_t(group.values[5][at])});
    out.total.push_back({group.values[2][at], group.values[3][at], std::size_t(group.values[4][at])});
  }
  return out;
}

std::string index_text(const SobolIndex& index) {
  return std::isnan(index.value) ? "none" : fmt::format("{:.2f} +- {:.2f}", index.value, index.error);
}

// Says from how many blocks of the design the indices follow, and why some have no value; empty if all follow
// from all blocks.
std::string origin_text(const SobolIndices& indices, std::size_t blocks, const std::string& remedy) {
  std::vector<std::size_t> all, without_value;
  for (const auto* list : {&indices.first, &indices.total})
    for (const SobolIndex& index : *list) {
      all.push_back(index.blocks);
      if (std::isnan(index.value)) without_value.push_back(index.blocks);
    }
  const auto [fewest, most] = std::ranges::minmax(all);
  const std::string from =
      fmt::format("{} of {} pairs",
                  fewest == most ? fmt::format("{}", most) : fmt::format("{} to {}", fewest, most), blocks);
  if (without_value.empty())
    return fewest == blocks ? "" : fmt::format("from {}, as the others have points without a value", from);
  if (std::ranges::min(without_value) >= kLeastBlocks)
    return fmt::format(
        "an index is missing where all or nearly all values are the same, or where its error is above 0.5; "
        "from {}; {}",
        from, remedy);
  return fmt::format("too few of the points have a value: {}; an index needs {}: {}", from, kLeastBlocks,
                     remedy);
}

std::string quantiles_line(const results::Group& group, std::size_t row, std::size_t points) {
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < kShares.size(); ++i) {
    const std::size_t at = row * kShares.size() + i;
    parts.push_back(fmt::format("{:.0f} % {:.4g}", 100 * kShares[i], group.values[0][at]));
    if (const double error = group.values[1][at]; std::isfinite(error))
      parts.back() += fmt::format(" +- {:.1g}", error);
  }
  const auto present = std::size_t(group.values[2][row * kShares.size()]);
  if (present == 0) return fmt::format("none, as none of {} points has a value", points);
  return fmt::format(
      "{}{}", fmt::join(parts, ", "),
      present < points ? fmt::format("; {} points have no value and are left out", points - present) : "");
}

}  // namespace

void require_variable(const Experiment& experiment, const std::string& place, const std::string& name) {
  std::vector<std::string> known;
  for (const results::ResultVariable& variable : results::result_variables(experiment.sweep))
    known.push_back(variable.name);
  if (std::ranges::find(known, name) == known.end())
    throw InputError(fmt::format("{}: {}: {} is not a variable of the result{}; allowed: {}", experiment.path,
                                 place, Json(name).dump(), did_you_mean(name, known),
                                 fmt::join(known, ", ")));
}

void validate_analysis(const Experiment& experiment) {
  for (const std::string& name : experiment.analysis.sobol_indices)
    require_variable(experiment, "/analysis/sobol_indices", name);
  for (const std::string& name : experiment.analysis.quantiles)
    require_variable(experiment, "/analysis/quantiles", name);
}

std::vector<results::Column> index_columns() {
  return {{"S1", "first-order Sobol index", "S_1", ""},
          {"S1_err", "standard error of S1", R"(\delta S_1)", ""},
          {"ST", "total Sobol index", "S_T", ""},
          {"ST_err", "standard error of ST", R"(\delta S_T)", ""},
          {"blocks", "blocks of the design with the two values that ST needs", "", "", H5T_NATIVE_LONG},
          {"S1_blocks", "blocks of the design with the three values that S1 needs", "", "", H5T_NATIVE_LONG}};
}

void add_indices(results::Group& group, const SobolIndices& indices) {
  for (std::size_t i = 0; i < indices.total.size(); ++i) {
    const SobolIndex &first = indices.first[i], &total = indices.total[i];
    const double row[] = {first.value, first.error,          total.value,
                          total.error, double(total.blocks), double(first.blocks)};
    for (std::size_t column = 0; column < std::size(row); ++column)
      group.values[column].push_back(row[column]);
  }
}

std::string indices_text(const SobolIndices& indices, const std::vector<std::string>& inputs,
                         std::size_t blocks, const std::string& remedy) {
  std::vector<std::size_t> order(inputs.size());
  std::iota(order.begin(), order.end(), 0);
  const auto total = [&](std::size_t i) { return std::fmax(indices.total[i].value, -1); };  // without NaN
  std::ranges::stable_sort(order, std::greater<>(), total);
  std::vector<std::string> parts;
  for (const std::size_t i : order)
    parts.push_back(
        fmt::format("{} {} ({})", inputs[i], index_text(indices.total[i]), index_text(indices.first[i])));
  const std::string origin = origin_text(indices, blocks, remedy);
  return fmt::format("{}{}{}", fmt::join(parts, ", "), origin.empty() ? "" : "; ", origin);
}

std::set<std::string> analysed_variables(const Experiment& experiment) {
  const auto& [indices, quantiles] = experiment.analysis;
  std::set<std::string> names(indices.begin(), indices.end());
  names.insert(quantiles.begin(), quantiles.end());
  if (!names.empty()) names.insert("status");
  return names;
}

std::vector<results::Group> analyse(const Experiment& experiment, const Values& values) {
  std::vector<results::Group> groups;
  if (!experiment.analysis.sobol_indices.empty()) groups.push_back(indices(experiment, values));
  if (!experiment.analysis.quantiles.empty()) groups.push_back(quantiles(experiment, values));
  return groups;
}

std::string analysis_text(const Experiment& experiment, const std::vector<results::Group>& groups) {
  std::string text;
  for (const results::Group& group : groups) {
    const bool of_indices = group.name == "indices";
    const std::vector<std::string>& outputs = group.dimensions[0].words;
    const Sweep others = others_of(experiment);
    const std::size_t points = sample_of(experiment).values.size(), block = block_of(experiment);
    for (std::size_t row = 0; row < others.size() * outputs.size(); ++row) {
      text += fmt::format(
          "{} of {}{}: {}", of_indices ? "total (and first-order) Sobol indices" : "quantiles",
          outputs[row % outputs.size()],
          others.axes.empty() ? "" : " at " + others.place(row / outputs.size()),
          of_indices ? indices_text(indices_of(group, row), inputs_of(experiment), points / block, kRemedy)
                     : quantiles_line(group, row, block == 1 ? points : 2 * points / block));
      const std::size_t width = group.values.back().size() / (others.size() * outputs.size());
      if (const double count = group.values.back()[row * width]; count > 0)
        text += fmt::format("; ambiguous points among those used: {}", count);
      text += "\n";
    }
  }
  return text;
}

}  // namespace bristle::run
