#include "run/analysis.hpp"

#include "experiment/sample.hpp"
#include "results/reader.hpp"
#include "util/error.hpp"
#include "util/grid.hpp"
#include "util/sensitivity.hpp"
#include "util/text.hpp"

#include <boost/algorithm/string/erase.hpp>
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
  return {"ambiguous", "points of the sample whose load another gap carries as well", "", "", H5T_NATIVE_LONG};
}

const std::vector<double> kShares = {0.05, 0.25, 0.5, 0.75, 0.95};

std::size_t sample_axis(const Experiment& e) {
  return std::size_t(std::ranges::find(e.axes, experiment::kSample, &experiment::Axis::name) - e.axes.begin());
}

// The sweep with the first point only of the sample. Its points are those of the other axes.
Experiment without_sample(Experiment e) {
  e.axes[sample_axis(e)].keep_first();
  return e;
}

// The values over the sample at a point of the other axes.
std::vector<double> over_sample(const Experiment& e, const std::vector<double>& values, std::size_t other) {
  const std::size_t sample = sample_axis(e);
  auto at = unravel(other, without_sample(e).shape());
  std::vector<double> out;
  for (std::size_t i = 0; i < e.axes[sample].values.size(); ++i) {
    at[sample] = i;
    out.push_back(values[ravel(at, e.shape())]);
  }
  return out;
}

// How many of these points are ambiguous: another gap carries the load as well.
double ambiguous(const Experiment& e, const std::map<std::string, std::vector<double>>& values,
                      std::size_t other) {
  const std::vector<double> statuses = over_sample(e, values.at("status"), other);
  return double(std::ranges::count(statuses, double(PointStatus::ambiguous)));
}

std::vector<std::size_t> other_axes(const Experiment& e) {
  std::vector<std::size_t> out;
  for (std::size_t axis = 0; axis < e.axes.size(); ++axis)
    if (axis != sample_axis(e)) out.push_back(axis);
  return out;
}

std::vector<std::string> inputs_of(const Experiment& e) {
  std::vector<std::string> names;
  for (const experiment::Axis& column : e.axes[sample_axis(e)].columns) names.push_back(column.name);
  return names;
}

using Values = std::map<std::string, std::vector<double>>;

results::Group indices(const Experiment& e, const Values& values) {
  const std::vector<std::string> &outputs = e.analysis.sobol_indices, inputs = inputs_of(e);
  results::Group group{"indices",
                       other_axes(e),
                       {results::word_dimension("output", "variable whose variance is shared out", outputs),
                        results::word_dimension("input", "parameter of the sample", inputs)},
                       index_columns(),
                       std::vector<std::vector<double>>(6)};
  group.columns.push_back(
      {"blocks", "blocks of the design whose points all have a value", "", "", H5T_NATIVE_LONG});
  group.columns.push_back(ambiguous_column());
  for (std::size_t other = 0; other < without_sample(e).points(); ++other)
    for (const std::string& output : outputs) {
      const SobolIndices found = sobol_indices(over_sample(e, values.at(output), other), inputs.size());
      for (std::size_t i = 0; i < inputs.size(); ++i) {
        const double row[] = {found.first[i].value, found.first[i].error, found.total[i].value,
                              found.total[i].error, double(found.complete), ambiguous(e, values, other)};
        for (std::size_t column = 0; column < 6; ++column) group.values[column].push_back(row[column]);
      }
    }
  return group;
}

results::Group quantiles(const Experiment& e, const Values& values) {
  const std::vector<std::string>& outputs = e.analysis.quantiles;
  results::Group group{"quantiles",
                       other_axes(e),
                       {results::word_dimension("output", "variable", outputs),
                        {{"share", "share of the sample below the quantile", "p", ""}, {}, kShares}},
                       {{"quantile", "quantile of the variable over the sample", "", ""},
                        {"quantile_err", "standard error of the quantile", "", ""},
                        {"points", "points of the sample with a value", "", "", H5T_NATIVE_LONG},
                        ambiguous_column()},
                       std::vector<std::vector<double>>(4)};
  // Of a design for indices, the two points of a block that are drawn independently.
  const std::size_t block = e.analysis.sobol_indices.empty() ? 1 : inputs_of(e).size() + 2;
  for (std::size_t other = 0; other < without_sample(e).points(); ++other)
    for (const std::string& output : outputs) {
      std::vector<double> present;
      const std::vector<double> all = over_sample(e, values.at(output), other);
      for (std::size_t i = 0; i < all.size(); ++i)
        if (std::isfinite(all[i]) && i % block < 2) present.push_back(all[i]);
      for (const double share : kShares) {
        const Estimate q = quantile(present, share);
        group.values[0].push_back(q.value);
        group.values[1].push_back(q.error);
        group.values[2].push_back(double(present.size()));
        group.values[3].push_back(ambiguous(e, values, other));
      }
    }
  return group;
}

// "S_T of R_x_norm at bending = rod, from 250 of 256 blocks: k_r 0.40 +- 0.02 ..." in descending order.
std::string indices_line(const results::Group& group, std::size_t row, std::size_t blocks) {
  const std::vector<std::string>& inputs = group.dimensions[1].words;
  const std::size_t first = row * inputs.size();
  std::vector<std::size_t> order(inputs.size());
  std::iota(order.begin(), order.end(), first);
  std::ranges::sort(order, std::greater<>(), [&](std::size_t i) { return group.values[2][i]; });
  std::vector<std::string> parts;
  for (const std::size_t i : order)
    parts.push_back(fmt::format("{} {:.2f} +- {:.2f} ({:.2f} +- {:.2f})", inputs[i - first],
                                group.values[2][i], group.values[3][i], group.values[0][i], group.values[1][i]));
  const auto complete = std::size_t(group.values[4][first]);
  if (!std::isfinite(group.values[2][first]))
    return complete < 2 ? fmt::format("none, as they need two blocks of the design with all values, and {} of {} has them", complete, blocks)
                        : "none, as all or nearly all values are the same";
  return fmt::format("{}{}", fmt::join(parts, ", "),
                     complete < blocks ? fmt::format("; from {} of {} blocks of the design, the others have points "
                                                     "without a value",
                                                     complete, blocks)
                                       : "");
}

std::string quantiles_line(const results::Group& group, std::size_t row, std::size_t points) {
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < kShares.size(); ++i) {
    const std::size_t at = row * kShares.size() + i;
    parts.push_back(fmt::format("{:.0f} % {:.4g}", 100 * kShares[i], group.values[0][at]));
    if (const double error = group.values[1][at]; std::isfinite(error)) parts.back() += fmt::format(" +- {:.1g}", error);
  }
  const auto present = std::size_t(group.values[2][row * kShares.size()]);
  return fmt::format("{}{}", fmt::join(parts, ", "),
                     present < points ? fmt::format("; {} points have no value and are left out", points - present) : "");
}

}  // namespace

void require_variable(const Experiment& experiment, const std::string& place, const std::string& name) {
  std::vector<std::string> known;
  for (const results::ResultVariable& variable : results::result_variables(experiment)) known.push_back(variable.name);
  if (std::ranges::find(known, name) == known.end())
    throw InputError(fmt::format("{}: {}: {} is not a variable of the result{}; allowed: {}", experiment.path, place,
                                 Json(name).dump(), did_you_mean(name, known), fmt::join(known, ", ")));
}

void validate_analysis(const Experiment& experiment) {
  for (const std::string& name : experiment.analysis.sobol_indices)
    require_variable(experiment, "/analysis/sobol_indices", name);
  for (const std::string& name : experiment.analysis.quantiles) require_variable(experiment, "/analysis/quantiles", name);
}

std::vector<results::Column> index_columns() {
  return {{"S1", "first-order Sobol index", "S_1", ""},
          {"S1_err", "standard error of S1", R"(\delta S_1)", ""},
          {"ST", "total Sobol index", "S_T", ""},
          {"ST_err", "standard error of ST", R"(\delta S_T)", ""}};
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
    const Experiment others = without_sample(experiment);
    const std::size_t points = experiment.axes[sample_axis(experiment)].values.size();
    const std::size_t block = experiment.analysis.sobol_indices.empty() ? 1 : inputs_of(experiment).size() + 2;
    for (std::size_t row = 0; row < others.points() * outputs.size(); ++row) {
      std::string place = others.place(row / outputs.size());
      for (const char* sample : {"sample = 0, ", ", sample = 0"}) boost::erase_all(place, sample);
      text += fmt::format("{} of {}{}: {}\n",
                          of_indices ? "total (and first-order) Sobol indices" : "quantiles", outputs[row % outputs.size()],
                          place == "sample = 0" ? "" : " at " + place,
                          of_indices ? indices_line(group, row, points / block)
                                     : quantiles_line(group, row, block == 1 ? points : 2 * points / block));
      const std::size_t width = group.values.back().size() / (others.points() * outputs.size());
      if (const double count = group.values.back()[row * width]; count > 0) {
        text.pop_back();
        text += fmt::format("; ambiguous points: {} of {}\n", count, points);
      }
    }
  }
  return text;
}

}  // namespace bristle::run
