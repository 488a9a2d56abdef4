#include "run/analysis.hpp"

#include "json/node.hpp"
#include "results/reader.hpp"
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

const char* const kRemedy = "raise sobol, or choose ranges in which more points have a value";
const std::vector<double> kShares = {0.05, 0.25, 0.5, 0.75, 0.95};

using Values = std::map<std::string, std::vector<double>>;

// Variables of the result whose values over a sample are analysed.
struct Analysis {
  std::vector<std::string> sobol_indices, quantiles;
};

Analysis analysis_of(const Experiment& experiment) {
  const json::Node node(*experiment.source, "/analysis");
  return {node.get("sobol_indices", std::vector<std::string>()),
          node.get("quantiles", std::vector<std::string>())};
}

const sweep::Axis& sample_of(const Experiment& e) {
  return e.sweep.axes[e.sweep.axis_number(sweep::kSample)];
}

// Returns the sweep over all axes other than the sample.
Sweep others_of(const Experiment& e) { return e.sweep.without(sweep::kSample); }

// Returns the values over the sample at a point of the other axes.
std::vector<double> over_sample(const Experiment& e, const std::vector<double>& values, std::size_t other) {
  const std::size_t sample = e.sweep.axis_number(sweep::kSample);
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
  std::size_t ambiguous = 0;  // number of these points whose load another gap carries as well
};

// Returns the values that a statistic uses at a point of the other axes: the first ones of each block of the
// sample. block: points of a block; first: how many of them count
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

// Returns the number of points in a block of the design for indices; 1 without indices.
std::size_t block_of(const Experiment& e) {
  return analysis_of(e).sobol_indices.empty() ? 1 : sample_of(e).columns.size() + 2;
}

std::vector<std::string> inputs_of(const Experiment& e) {
  std::vector<std::string> names;
  for (const sweep::Axis& column : sample_of(e).columns) names.push_back(column.name);
  return names;
}

// Returns a group over the axes beside the sample; other dimensions follow.
results::Dataset over_others(const std::string& name, const Experiment& e) {
  results::Dataset out(name);
  for (const sweep::Axis& axis : others_of(e).axes)
    out.add_axis(results::axis_variable(axis.name), axis.values.size());
  return out;
}

results::Column integers(const std::string& name, const std::string& meaning) {
  return {name, meaning, "", "", results::Number::integer};
}

// Adds the number of ambiguous points among the points that each output uses. size: number of values of each
// output
void add_ambiguous(results::Dataset& data, const std::vector<double>& ambiguous, std::size_t size) {
  data.add(integers("ambiguous", "points that are used, whose load another gap carries as well"),
           [&](std::size_t i) { return ambiguous[i / size]; });
}

results::Dataset indices(const Experiment& e, const Values& values) {
  const std::vector<std::string> outputs = analysis_of(e).sobol_indices, inputs = inputs_of(e);
  results::Dataset out = over_others("indices", e);
  const std::size_t points = out.size();
  out.add_dimension(results::coordinates("output", "variable whose variance is shared out", outputs));
  out.add_dimension(results::coordinates("input", "parameter of the sample", inputs));
  std::vector<SobolIndices> rows;
  std::vector<double> ambiguous;
  for (std::size_t other = 0; other < points; ++other)
    for (const std::string& output : outputs) {
      rows.push_back(sobol_indices(over_sample(e, values.at(output), other), inputs.size()));
      ambiguous.push_back(double(used_of(e, values, output, other, 1, 1).ambiguous));
    }
  add_indices(out, rows);
  add_ambiguous(out, ambiguous, inputs.size());
  return out;
}

results::Dataset quantiles(const Experiment& e, const Values& values) {
  const std::vector<std::string> outputs = analysis_of(e).quantiles;
  results::Dataset out = over_others("quantiles", e);
  const std::size_t points = out.size(), block = block_of(e), independent = std::min<std::size_t>(block, 2);
  out.add_dimension(results::coordinates("output", "variable", outputs));
  out.add_dimension(
      results::coordinates({"share", "share of the sample below the quantile", "p", ""}, kShares));
  std::vector<Quantity> found;
  std::vector<double> used_points, ambiguous;
  for (std::size_t other = 0; other < points; ++other)
    for (const std::string& output : outputs) {
      const Used used = used_of(e, values, output, other, block, independent);
      for (const double share : kShares) found.push_back(quantile(used.values, share));
      used_points.push_back(double(used.values.size()));
      ambiguous.push_back(double(used.ambiguous));
    }
  out.add({"quantile", "quantile of the variable over the sample", "", ""},
          [&](std::size_t i) { return found[i].value; });
  out.add({"quantile_err", "standard error of the quantile", "", ""},
          [&](std::size_t i) { return found[i].error; });
  out.add(integers("points", "points that are used: drawn independently and with a value"),
          [&](std::size_t i) { return used_points[i / kShares.size()]; });
  add_ambiguous(out, ambiguous, kShares.size());
  return out;
}

// Reads one row of indices back from a group, as add_indices() has written it.
SobolIndices indices_of(const results::Dataset& group, std::size_t row) {
  const std::size_t inputs = group.dimension("input").shape.front();
  const auto read = [&](const std::string& name) { return group.array(name).values.data() + row * inputs; };
  SobolIndices out;
  for (std::size_t i = 0; i < inputs; ++i) {
    out.first.push_back({{read("S1")[i], read("S1_err")[i]}, std::size_t(read("S1_blocks")[i])});
    out.total.push_back({{read("ST")[i], read("ST_err")[i]}, std::size_t(read("blocks")[i])});
  }
  return out;
}

std::string index_text(const SobolIndex& index) {
  return std::isnan(index.value) ? "none" : fmt::format("{:.2f} +- {:.2f}", index.value, index.error);
}

// Returns a text that says from how many blocks of the design the indices follow, and why some have no value;
// empty if all follow from all blocks.
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

std::string quantiles_line(const results::Dataset& group, std::size_t row, std::size_t points) {
  const auto read = [&](const std::string& name, std::size_t i) {
    return group.array(name).values[row * kShares.size() + i];
  };
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < kShares.size(); ++i) {
    parts.push_back(fmt::format("{:.0f} % {:.4g}", 100 * kShares[i], read("quantile", i)));
    if (const double error = read("quantile_err", i); std::isfinite(error))
      parts.back() += fmt::format(" +- {:.1g}", error);
  }
  const auto present = std::size_t(read("points", 0));
  if (present == 0) return fmt::format("none, as none of {} points has a value", points);
  return fmt::format(
      "{}{}", fmt::join(parts, ", "),
      present < points ? fmt::format("; {} points have no value and are left out", points - present) : "");
}

}  // namespace

void require_variable(const Experiment& experiment, const json::Node& place, const std::string& name,
                      std::vector<std::string> known) {
  for (const results::ResultVariable& variable : results::result_variables(experiment.sweep))
    known.push_back(variable.name);
  if (std::ranges::find(known, name) == known.end())
    place.fail(fmt::format("{} is not a variable of the result{}; allowed: {}", Json(name).dump(),
                           did_you_mean(name, known), fmt::join(known, ", ")));
}

void read_analysis(const Experiment& experiment) {
  const json::Node block(*experiment.source, "/analysis"), design(*experiment.source, "/design"),
      sample(*experiment.source, "/sweep/sample");
  if (!block.exists() || block.value().empty()) return;
  if (design.exists())
    block.fail("cannot be combined with /design, which computes the indices of its tolerances itself");
  if (!sample.exists()) block.fail("needs a sample in the sweep (/sweep/sample)");
  if (!analysis_of(experiment).sobol_indices.empty() && !sample.has("sobol"))
    block["sobol_indices"].fail("needs a sample by sobol, of which the program makes the design for indices");
}

void validate_analysis(const Experiment& experiment) {
  read_analysis(experiment);
  const json::Node block(*experiment.source, "/analysis");
  for (const auto& [key, names] : block.members())
    for (const std::string name : names.value()) require_variable(experiment, names, name);
}

void add_indices(results::Dataset& data, const std::vector<SobolIndices>& rows) {
  const auto inputs = data.shape().back();
  const auto add = [&](const results::Column& column, std::vector<SobolIndex> SobolIndices::*kind,
                       auto value) {
    data.add(column, [&](std::size_t i) { return ((rows[i / inputs].*kind)[i % inputs]).*value; });
  };
  add({"S1", "first-order Sobol index", "S_1", ""}, &SobolIndices::first, &SobolIndex::value);
  add({"S1_err", "standard error of S1", R"(\delta S_1)", ""}, &SobolIndices::first, &SobolIndex::error);
  add({"ST", "total Sobol index", "S_T", ""}, &SobolIndices::total, &SobolIndex::value);
  add({"ST_err", "standard error of ST", R"(\delta S_T)", ""}, &SobolIndices::total, &SobolIndex::error);
  add(integers("blocks", "blocks of the design with the two values that ST needs"), &SobolIndices::total,
      &SobolIndex::blocks);
  add(integers("S1_blocks", "blocks of the design with the three values that S1 needs"), &SobolIndices::first,
      &SobolIndex::blocks);
}

std::string indices_text(const SobolIndices& indices, const std::vector<std::string>& inputs,
                         std::size_t blocks, const std::string& remedy) {
  std::vector<std::size_t> order(inputs.size());
  std::iota(order.begin(), order.end(), 0);
  // Replaces NaN by -1.
  const auto total = [&](std::size_t i) { return std::fmax(indices.total[i].value, -1); };
  std::ranges::stable_sort(order, std::greater<>(), total);
  std::size_t width = 0;
  for (const std::string& input : inputs) width = std::max(width, input.size());
  std::string text = fmt::format("    {:<{}}  {:>14}  {:>14}\n", "", width, "total", "first order");
  for (const std::size_t i : order)
    text += fmt::format("    {:<{}}  {:>14}  {:>14}\n", inputs[i], width, index_text(indices.total[i]),
                        index_text(indices.first[i]));
  const std::string origin = origin_text(indices, blocks, remedy);
  return origin.empty() ? text : text + "    " + origin + "\n";
}

std::set<std::string> analysed_variables(const Experiment& experiment) {
  const auto [indices, quantiles] = analysis_of(experiment);
  std::set<std::string> names(indices.begin(), indices.end());
  names.insert(quantiles.begin(), quantiles.end());
  if (!names.empty()) names.insert("status");
  return names;
}

std::vector<results::Dataset> analyse(const Experiment& experiment, const Values& values) {
  std::vector<results::Dataset> groups;
  const Analysis analysis = analysis_of(experiment);
  if (!analysis.sobol_indices.empty()) groups.push_back(indices(experiment, values));
  if (!analysis.quantiles.empty()) groups.push_back(quantiles(experiment, values));
  return groups;
}

std::string analysis_text(const Experiment& experiment, const std::vector<results::Dataset>& groups) {
  std::string text;
  for (const results::Dataset& group : groups) {
    const bool of_indices = group.name() == "indices";
    const std::vector<std::string>& outputs = group.dimension("output").about.words;
    const Sweep others = others_of(experiment);
    const std::size_t points = sample_of(experiment).values.size(), block = block_of(experiment);
    for (std::size_t row = 0; row < others.size() * outputs.size(); ++row) {
      const std::string what = outputs[row % outputs.size()] +
                               (others.axes.empty() ? "" : " at " + others.place(row / outputs.size()));
      const double ambiguous = group.array("ambiguous").values[row * group.shape().back()];
      const std::string note =
          ambiguous > 0 ? fmt::format("; ambiguous points among those used: {}", ambiguous) : "";
      if (of_indices)
        text +=
            fmt::format("shares in the variance of {} (Sobol indices){}\n{}", what, note,
                        indices_text(indices_of(group, row), inputs_of(experiment), points / block, kRemedy));
      else
        text += fmt::format("quantiles of {}: {}{}\n", what,
                            quantiles_line(group, row, block == 1 ? points : 2 * points / block), note);
    }
  }
  return text;
}

}  // namespace bristle::run
