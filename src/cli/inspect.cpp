#include "cli/commands.hpp"

#include "experiment/experiment.hpp"
#include "results/phases.hpp"
#include "results/reader.hpp"
#include "results/variables.hpp"
#include "util/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace bristle::cli {
namespace {

// The values of a variable that are numbers.
struct Range {
  double low = INFINITY, high = -INFINITY;
  std::size_t values = 0;
};

Range range_of(const results::Array& array) {
  Range out;
  for (const double x : array.values) {
    if (!std::isfinite(x)) continue;
    out.low = std::min(out.low, x);
    out.high = std::max(out.high, x);
    ++out.values;
  }
  return out;
}

// Returns the words along the axis of a choice; empty for other variables.
std::vector<std::string> words_along(const results::Array& array) {
  std::vector<std::string> words;
  if (!array.coordinate || array.about.words.empty()) return words;
  for (const double code : array.values) words.push_back(array.text(code));
  return words;
}

// Returns how often an array of codes has each of its words: "12 contact", ...
std::vector<std::string> counts_of_words(const results::Array& array) {
  std::vector<std::string> out;
  for (std::size_t code = 0; code < array.about.words.size(); ++code)
    if (const auto n = std::ranges::count(array.values, double(code)))
      out.push_back(fmt::format("{} {}", n, array.about.words[code]));
  return out;
}

// Returns the greatest error of a variable in words; empty if it has none.
std::string error_text(const results::ResultReader& result, const std::string& name) {
  if (!result.has(name + "_err")) return "";
  const Range range = range_of(result.variable(name + "_err"));
  return range.values == 0 || range.high == 0 ? "" : fmt::format(" +- {:.2g} or less", range.high);
}

void print_variable(const results::ResultReader& result, const std::string& name) {
  const results::Array& array = result.variable(name);
  const Range range = range_of(array);
  const std::vector<std::string> words = words_along(array);
  const std::string where =
      array.dimensions.empty() ? "" : fmt::format("({})", fmt::join(array.dimensions, ", "));
  const std::size_t missing = array.values.size() - range.values;
  if (!words.empty()) fmt::print("  {:<22} {:<20} {}\n", name, where, fmt::join(words, ", "));
  else if (!array.about.words.empty())
    fmt::print("  {:<22} {:<20} {}\n", name, where, fmt::join(counts_of_words(array), ", "));
  else if (range.values == 0) fmt::print("  {:<22} {:<20} no values\n", name, where);
  else
    fmt::print("  {:<22} {:<20} {:>12.6g} .. {:<12.6g}{}{}\n", name, where, range.low, range.high,
               error_text(result, name), missing > 0 ? fmt::format(", {} without a value", missing) : "");
}

// What most people look for, in this order, after the axes.
constexpr const char* kImportant[] = {"friction_coefficient",
                                      "R_x_norm",
                                      "R_n_in_N",
                                      "R_x_in_N",
                                      "pressure_in_Pa",
                                      "friction_in_Pa",
                                      "phase",
                                      "R_n",
                                      "R_x",
                                      "z_0",
                                      "gamma_1",
                                      "gamma_2",
                                      "gamma_3",
                                      "N_c_ratio",
                                      "off_slab_share",
                                      "load_over_lift_off",
                                      "lift_off_load",
                                      "lift_off_load_in_N",
                                      "F_n_peak_in_N",
                                      "tip_travel_in_m",
                                      "root_strain",
                                      "wear_power_in_W_per_m2"};

// Prints the variables: axes, what most people look for, and the others. Errors stand beside their variables.
// intact: whether the experiment of the result can be read, which names the axes
void print_variables(const results::ResultReader& result, bool intact) {
  std::vector<std::string> names;
  if (intact) names = result.coordinates();
  const auto add = [&](const std::string& name) {
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  };
  for (const char* name : kImportant)
    if (result.has(name)) add(name);
  const std::size_t important = names.size();
  for (const std::string& name : result.variables())
    if (!name.ends_with("_err")) add(name);
  fmt::print("variables (smallest .. largest; the greatest error):\n");
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i == important) fmt::print("further variables:\n");
    print_variable(result, names[i]);
  }
}

// Returns the number of points with each status that occurs.
std::vector<std::pair<std::string, long>> status_counts(const results::ResultReader& result) {
  const std::vector<double> status = result.variable("status").values;
  std::vector<std::pair<std::string, long>> counts;
  const Words names = words<PointStatus>();
  for (std::size_t s = 0; s < names.size(); ++s)
    if (const auto n = std::count(status.begin(), status.end(), double(s))) counts.emplace_back(names[s], n);
  return counts;
}

void print_statuses(const results::ResultReader& result) {
  const auto counts = status_counts(result);
  fmt::print("points:{}", counts.empty() ? " none" : "");
  for (const auto& [name, n] : counts) fmt::print(" {} {}", n, name);
  fmt::print("\n");
}

// Prints how much the brush of the first unreachable point carries, if there is one.
void print_unreachable(const results::ResultReader& result) {
  const std::vector<double>& status = result.variable("status").values;
  const auto first =
      std::size_t(std::ranges::find(status, double(PointStatus::unreachable)) - status.begin());
  if (first == status.size() || !result.has("R_n_largest")) return;
  const Sweep sweep =
      experiment::stored_experiment(result.experiment(), result.text("tier"), result.path()).sweep;
  fmt::print("unreachable at {}: {}\n", sweep.place(first),
             results::carried_text(sweep.point(first), result.variable("R_n_largest").values[first],
                                   result.variable("z_0_of_R_n_largest").values[first]));
}

void print_failures(const results::ResultReader& result) {
  const auto failures = result.failures();
  if (!failures.empty()) fmt::print("failed points, by index (the last axis fastest):\n");
  for (const auto& [point, error] : failures) fmt::print("  {:<22} {}\n", point, error);
}

// Prints what a design found, in words, with its details.
void print_design(const results::ResultReader& result) {
  for (const char* name : {"summary", "details"})
    fmt::print("{}", wrapped_lines(result.lines("trials", name), terminal_columns()));
}

void print_provenance(const results::ResultReader& result) {
  const auto provenance = result.provenance();
  if (provenance.empty()) return;
  // Order of the entries; all others follow.
  std::vector<std::string> names = {"command_line",    "started",        "finished", "host",
                                    "system",          "threads",        "cpu",      "cpu_features",
                                    "instruction_set", "version",        "commit",   "dirty",
                                    "points_computed", "points_commits", "compiler", "flags"};
  for (const auto& [name, text] : provenance)
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  fmt::print("provenance:\n");
  for (const std::string& name : names)
    if (const auto entry = provenance.find(name); entry != provenance.end())
      fmt::print("  {:<22} {}\n", name, entry->second);
}

Json variable_json(const results::Array& array) {
  const Range range = range_of(array);
  const std::vector<std::string> words = words_along(array);
  Json out = {{"dimensions", array.dimensions},
              {"shape", array.shape},
              {"long_name", array.about.long_name},
              {"units", array.about.units}};
  if (!words.empty()) out["words"] = words;
  else if (range.values > 0) out.update({{"min", range.low}, {"max", range.high}});
  out["missing"] = array.values.size() - range.values;
  return out;
}

void print_json(const results::ResultReader& result) {
  Json out = {{"file", result.path()}};
  for (const char* name : {"name", "title", "tier", "schema_version", "payload_sha256", "inputs_sha256"})
    out[name] = result.text(name);
  out["numerics_version"] = result.integer("numerics_version");
  out["damage"] = result.damage();
  out["axes"] = Json::object();
  for (const std::string& axis : result.axes()) {
    const results::Array& array = result.variable(axis);
    const std::vector<std::string> words = words_along(array);
    out["axes"][axis] = words.empty() ? Json(array.values) : Json(words);
  }
  out["points"] = Json::object();
  for (const auto& [name, n] : status_counts(result)) out["points"][name] = n;
  out["variables"] = Json::object();
  for (const std::string& name : result.variables())
    out["variables"][name] = variable_json(result.variable(name));
  out["failures"] = result.failures();
  out["provenance"] = result.provenance();
  out["experiment"] = result.experiment();
  fmt::print("{}\n", out.dump(1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace

int info_command(const InfoOptions& options) {
  const std::string& file = options.file;
  const results::ResultReader result(file);
  const bool intact = result.damage().empty();
  if (options.json) {
    print_json(result);
    return intact ? kSuccess : kCheckFailed;
  }
  fmt::print("{}: {}\n", file, result.text("title"));
  fmt::print("schema {}, experiment {}\npayload sha256 {}{}\n", result.text("schema_version"),
             result.text("name"), result.text("payload_sha256"), intact ? " (verified)" : "");
  for (const std::string& what : result.damage()) fmt::print("DAMAGED: {}\n", what);
  print_statuses(result);
  results::Phases phases;
  phases.add([&](const std::string& name) {
    return result.has(name) ? result.variable(name).values : std::vector<double>();
  });
  fmt::print("{}", phases.text());
  if (intact) print_unreachable(result);
  print_design(result);
  print_failures(result);
  print_variables(result, intact);
  print_provenance(result);
  return intact ? kSuccess : kCheckFailed;
}

}  // namespace bristle::cli
