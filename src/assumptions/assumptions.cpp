#include "assumptions/assumptions.hpp"

#include "checks/validate.hpp"
#include "results/digest.hpp"
#include "results/reader.hpp"
#include "run/progress.hpp"
#include "run/task.hpp"
#include "util/error.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <chrono>
#include <filesystem>
#include <iterator>

namespace bristle {
namespace {

namespace fs = std::filesystem;

// The experiments that check claims of the paper, in the order of their names.
std::vector<Experiment> with_claims(const AssumptionsOptions& options) {
  if (!fs::is_directory(options.experiments))
    throw InputError(fmt::format("--experiments {}: not a folder", options.experiments));
  std::vector<std::string> files;
  for (const auto& entry : fs::directory_iterator(options.experiments))
    if (entry.path().extension() == ".json") files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  std::vector<Experiment> out;
  for (const std::string& file : files) {
    Experiment e = load_experiment(file, {{}, options.tier});
    if (!e.figure.empty() && !e.checks.empty()) out.push_back(std::move(e));
  }
  if (out.empty())
    throw InputError(
        fmt::format("--experiments {}: no experiment has checks of a figure's claims", options.experiments));
  return out;
}

// A name that is valid as a folder's name.
std::string folder_name(std::string name) {
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && std::string("_.-+").find(c) == std::string::npos)
      c = '_';
  return name;
}

class Runner {
 public:
  explicit Runner(const AssumptionsOptions& options) : options_(options), baseline_(with_claims(options)) {
    matrix_.tier = options.tier;
    matrix_.alternatives = {{"baseline", "", "every open choice as in docs/model.md", {}, {}}};
    std::ranges::copy(read_alternatives(options.files), std::back_inserter(matrix_.alternatives));
  }

  Matrix run() {
    // A mistake in an alternative is reported before anything is computed.
    for (const Alternative& a : matrix_.alternatives)
      for (const Experiment& e : baseline_) validate_checks(under(a, e));
    Progress progress("assumptions", matrix_.alternatives.size() * baseline_.size(), options_.quiet);
    for (const Alternative& a : matrix_.alternatives) {
      std::size_t row = 0;
      for (const Experiment& e : baseline_) {
        add(a, e, row);
        progress.step();
      }
    }
    progress.finish();
    return std::move(matrix_);
  }

 private:
  Experiment under(const Alternative& a, const Experiment& e) const {
    return stored_experiment(a.apply(e.name, *e.document), options_.tier,
                             fmt::format("{} under {}", e.path, a.name));
  }

  // The cells of one experiment's checks under one alternative; row is that of its first check.
  void add(const Alternative& a, const Experiment& baseline, std::size_t& row) {
    const Experiment experiment = under(a, baseline);
    const bool affected = a.declarations.empty() ||
                          inputs_sha256(*experiment.document) != inputs_sha256(*baseline.document) ||
                          experiment.checks != baseline.checks;
    const std::string& folder = affected ? a.name : matrix_.alternatives.front().name;
    const std::string path =
        (fs::path(options_.output).replace_extension() / folder_name(folder) / (baseline.name + ".h5"))
            .string();
    if (affected) run_task({experiment, {}, path}, {options_.threads, false, true, options_.command_line});
    for (CheckResult& result : evaluate_checks(ResultReader(path))) {
      if (matrix_.rows.size() == row) matrix_.rows.push_back({baseline.name, {}});
      matrix_.rows[row++].cells.push_back({std::move(result), affected});
    }
  }

  const AssumptionsOptions& options_;
  std::vector<Experiment> baseline_;
  Matrix matrix_;
};

}  // namespace

Matrix run_assumptions(const AssumptionsOptions& options) { return Runner(options).run(); }

}  // namespace bristle
