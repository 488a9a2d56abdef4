#include "compare/replay.hpp"

#include "experiment/experiment.hpp"
#include "util/error.hpp"
#include "util/grid.hpp"
#include "util/text.hpp"

#include <fmt/format.h>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

namespace bristle::compare {
namespace {

std::string tier_of(const results::ResultReader& result) {
  return h5::has_attribute(result.file(), "tier") ? result.text("tier") : "full";
}

// The experiment file named on the command line of the run; without a command line experiments/NAME.json.
std::string experiment_file(const results::ResultReader& result) {
  const auto provenance = result.provenance();
  if (const auto line = provenance.find("command_line"); line != provenance.end()) {
    std::istringstream words(line->second);
    for (std::string word; words >> word;)
      if (word.size() > 5 && word.ends_with(".json")) return word;
  }
  return fmt::format("experiments/{}.json", result.text("name"));
}

// A coordinate as in an experiment file: a word for a choice, otherwise the exact number.
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

// Adds the --set options that change the experiment file, if it exists, into the experiment of the run.
void add_changes(std::vector<std::string>& words, const Json& run, const std::string& file,
                 const std::string& tier) {
  Json read;
  try {
    read = *experiment::load_experiment(file, {{}, tier}).document;
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

// Number of nodes of a traced curve; otherwise 1.
std::size_t nodes_per_point(const results::ResultReader& result) {
  return result.variable("status").values.size() / grid_size(result.sweep_shape());
}

}  // namespace

std::string replay_command(const results::ResultReader& result, std::size_t point) {
  const Json experiment = result.experiment();
  const std::string file = experiment_file(result), tier = tier_of(result);
  // In a checkout of bristle the program is where `make build` puts it; elsewhere it is an installed one.
  const char* own_build = "build/bristle";
  std::vector<std::string> words = {std::filesystem::exists(own_build) ? own_build : "bristle", "run", file};
  if (tier != "full") words.insert(words.end(), {"--tier", tier});
  add_changes(words, experiment, file, tier);
  const Json sweep = experiment.value("sweep", Json::object());
  const std::vector<std::size_t> shape = result.sweep_shape();
  const auto at = unravel(point / nodes_per_point(result), shape);
  std::size_t d = 0;
  for (const auto& [name, axis] : sweep.items()) {
    const double value = result.variable(results::axis_variable(name)).values[at[d]];
    Json one;
    one["values"] = Json::array({coordinate(axis, value, at[d])});
    for (const char* other : {"logspace", "linspace", "take"}) one[other] = nullptr;
    add_set(words, JsonPointer("/sweep") / name, one);
    ++d;
  }
  if (experiment.contains("checks"))
    add_set(words, JsonPointer("/checks"), nullptr);  // checks need the whole sweep
  std::string command;
  for (const std::string& word : words) command += shell_quoted(word) + " ";
  return command + "-o results/replay.h5";
}

Json replay_json(const results::ResultReader& result) {
  const std::size_t nodes = nodes_per_point(result), values = result.variable("status").values.size();
  Json commands = Json::array();
  for (std::size_t p = 0; p < values; p += nodes) commands.push_back(replay_command(result, p));
  return commands;
}

}  // namespace bristle::compare
