#include "checks/comparison.hpp"
#include "checks/drift.hpp"
#include "util/error.hpp"
#include "results/writer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <sstream>

namespace bristle {
namespace {

constexpr std::size_t kAlwaysShown = 5, kMostShown = 25;
constexpr double kWarning = 0.5;  // of a tolerance

std::string tier_of(const ResultReader& result) {
  return h5::has_attribute(result.file(), "tier") ? result.text("tier") : "full";
}

// The experiment's file as the run was told, or else where it would be.
std::string experiment_file(const ResultReader& result) {
  if (h5::exists(result.file(), "provenance")) {
    const h5::Handle group(H5Gopen2(result.file(), "provenance", H5P_DEFAULT), H5Gclose,
                           "opening /provenance");
    if (h5::has_attribute(group, "command_line")) {
      std::istringstream words(h5::read_text_attribute(group, "command_line"));
      for (std::string word; words >> word;)
        if (word.size() > 5 && word.substr(word.size() - 5) == ".json") return word;
    }
  }
  return fmt::format("experiments/{}.json", result.text("name"));
}

// A coordinate as the experiment spells it: a word on an axis of words, else the number to the bit.
Json coordinate(const Json& axis, double value, std::size_t index) {
  if (!axis.contains("values")) return value;
  const Json& values = axis["values"];
  const std::size_t i = axis.contains("take") ? axis["take"].at(index).get<std::size_t>() : index;
  return values.at(i).is_string() ? values.at(i) : Json(value);
}

void add_set(std::vector<std::string>& words, const JsonPointer& at, const Json& value) {
  words.emplace_back("--set");
  words.push_back(at.to_string() + "=" + value.dump());
}

// What --set had changed in the run, found as the difference from the experiment's file, if that is there.
void add_changes(std::vector<std::string>& words, const Json& run, const std::string& file,
                 const std::string& tier) {
  Json read;
  try {
    read = load_experiment(file, {{}, tier}).document;
  } catch (const InputError&) {
    return;
  }
  for (const char* section : {"model", "si", "load", "orientation", "integrator"}) {
    const Json was = read.value(section, Json::object()), is = run.value(section, Json::object());
    for (const auto& [key, value] : is.items())
      if (!was.contains(key) || was[key] != value) add_set(words, JsonPointer() / section / key, value);
    for (const auto& [key, value] : was.items())
      if (!is.contains(key)) add_set(words, JsonPointer() / section / key, nullptr);
  }
}

std::string row(const ResultReader& result, const Drift& d) {
  const std::string units = std::isfinite(d.units) ? fmt::format("{:.3g}", d.units) : "-";
  const char* verdict = d.units > 1 ? "  FAILED" : d.units > kWarning ? "  above half its tolerance" : "";
  return fmt::format("{:<18} {:>10} {:>24} {:>24}  {}{}\n", d.variable, units,
                     value_text(result, d.variable, d.reference), value_text(result, d.variable, d.now),
                     place(result, d.variable, d.point), verdict);
}

std::string replays(const DriftReport& report, const ResultReader& result, std::size_t shown) {
  std::string text;
  std::vector<std::size_t> told;
  for (std::size_t i = 0; i < shown; ++i) {
    const Drift& d = report.drifts[i];
    if (std::find(told.begin(), told.end(), d.point) != told.end()) continue;
    told.push_back(d.point);
    text += fmt::format("To compute {} again:\n  {}\n", place(result, d.variable, d.point),
                        replay_command(result, d.point));
  }
  return text;
}

}  // namespace

std::size_t sweep_points(const ResultReader& result) {
  std::size_t points = 1;
  const Json sweep = result.experiment().value("sweep", Json::object());
  for (const auto& [name, axis] : sweep.items()) points *= result.variable(axis_variable(name)).values.size();
  return points;
}

std::string replay_command(const ResultReader& result, std::size_t point) {
  const Json experiment = result.experiment();
  const std::string file = experiment_file(result), tier = tier_of(result);
  std::vector<std::string> words = {"build/bristle", "run", file};
  if (tier != "full") words.insert(words.end(), {"--tier", tier});
  add_changes(words, experiment, file, tier);
  const Json sweep = experiment.value("sweep", Json::object());
  std::vector<std::vector<double>> values;
  std::vector<std::size_t> shape;
  for (const auto& [name, axis] : sweep.items()) {
    values.push_back(result.variable(axis_variable(name)).values);
    shape.push_back(values.back().size());
  }
  const std::size_t nodes =
      result.variable("status").values.size() / sweep_points(result);  // of a traced curve, else 1
  const auto at = unravel(point / nodes, shape);
  std::size_t d = 0;
  for (const auto& [name, axis] : sweep.items()) {
    Json one;
    one["values"] = Json::array({coordinate(axis, values[d][at[d]], at[d])});
    for (const char* other : {"logspace", "linspace", "take"}) one[other] = nullptr;
    add_set(words, JsonPointer("/sweep") / name, one);
    ++d;
  }
  if (experiment.contains("checks"))
    add_set(words, JsonPointer("/checks"), nullptr);  // of one point there are none
  std::string command;
  for (const std::string& word : words) command += shell_quoted(word) + " ";
  return command + "-o results/replay.h5";
}

std::string drift_text(const DriftReport& report, const ResultReader& result, const std::string& reference) {
  const std::size_t warnings = report.above(kWarning), failed = report.above(1);
  const std::size_t wanted = std::min(std::max(kAlwaysShown, warnings), kMostShown);
  const std::size_t shown = std::min(wanted, report.drifts.size());
  std::string text;
  for (const std::string& note : report.notes) text += fmt::format("note: {}\n", note);
  for (const std::string& failure : report.failures) text += fmt::format("FAILED: {}\n", failure);
  if (shown > 0)
    text += fmt::format("{:<18} {:>10} {:>24} {:>24}  {}\n", "quantity", "tolerances", "reference", "new",
                        "point");
  for (std::size_t i = 0; i < shown; ++i) text += row(result, report.drifts[i]);
  if (warnings > shown)
    text += fmt::format("... and {} more above half their tolerances\n", warnings - shown);
  text += replays(report, result, shown);
  const std::string where = report.points == report.points_in_file
                                ? fmt::format("{} points", report.points)
                                : fmt::format("{} of {} points", report.points, report.points_in_file);
  const std::string summary = fmt::format("{}: {} values at {}: ", reference, report.values, where);
  if (report.failed())
    return text + fmt::format("{}FAILED: {} above their tolerances, {} other failures\n", summary, failed,
                              report.failures.size());
  if (report.drifts.empty()) return text + summary + "the same, bit for bit\n";
  return text + fmt::format("{}{} differ, by at most {:.3g} of the tolerance, {} above half of it\n", summary,
                            report.drifts.size(), report.drifts[0].units, warnings);
}

}  // namespace bristle
