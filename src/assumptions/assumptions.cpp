#include "assumptions/assumptions.hpp"

#include "checks/validate.hpp"
#include "results/digest.hpp"
#include "results/reader.hpp"
#include "results/version.hpp"
#include "run/progress.hpp"
#include "run/task.hpp"
#include "util/error.hpp"
#include "util/sha.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <chrono>
#include <filesystem>
#include <iterator>

namespace bristle::assumptions {
namespace {

namespace fs = std::filesystem;

// The experiments with checks of claims of the paper, in the order of their file names.
std::vector<Experiment> experiments_with_claims(const AssumptionsOptions& options) {
  if (!fs::is_directory(options.experiments))
    throw InputError(fmt::format("--experiments {}: not a folder", options.experiments));
  std::vector<std::string> files;
  for (const auto& entry : fs::directory_iterator(options.experiments))
    if (entry.path().extension() == ".json") files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  std::vector<Experiment> out;
  for (const std::string& file : files) {
    Experiment e = experiment::load_experiment(file, {{}, options.tier});
    const bool wanted = options.only.empty() || std::ranges::count(options.only, e.name) > 0;
    if (wanted && !e.figure.empty() && !e.checks.empty()) out.push_back(std::move(e));
  }
  for (const std::string& name : options.only)
    if (std::ranges::find(out, name, &Experiment::name) == out.end())
      throw InputError(fmt::format("--only {}: {} has no experiment of this name with checks of a figure",
                                   name, options.experiments));
  if (out.empty())
    throw InputError(fmt::format("--experiments {}: no experiment in this folder has a figure with checks",
                                 options.experiments));
  return out;
}

// Replaces characters that should not be in the name of a folder.
std::string folder_name(std::string name) {
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && std::string("_.-+").find(c) == std::string::npos)
      c = '_';
  return name;
}

class AssumptionsRun {
 public:
  explicit AssumptionsRun(const AssumptionsOptions& options)
      : options_(options), baseline_(experiments_with_claims(options)) {
    matrix_.tier = options.tier;
    matrix_.only = options.only;
    matrix_.inputs_sha256 = inputs_sha256(options);
    Declarations declared = read_declarations(options.files);
    matrix_.alternatives = {std::move(declared.baseline)};
    std::ranges::move(declared.alternatives, std::back_inserter(matrix_.alternatives));
    matrix_.windows = std::move(declared.windows);
  }

  Matrix run() {
    // Reports a mistake in an alternative, and a file that is in the way, before computing anything.
    require_replaceable(options_.output, replaceable_by_matrix());
    for (const Alternative& a : matrix_.alternatives)
      for (const Experiment& e : baseline_) {
        checks::validate_checks(experiment_under(a, e));
        require_replaceable(result_path(a, e), results::replaceable_by({}));
      }
    run::Progress progress("assumptions", matrix_.alternatives.size() * baseline_.size(), options_.quiet);
    for (const Alternative& a : matrix_.alternatives) {
      std::size_t row = 0;
      for (const Experiment& e : baseline_) {
        add_cells(a, e, row);
        progress.step();
      }
    }
    progress.finish();
    return std::move(matrix_);
  }

 private:
  Experiment experiment_under(const Alternative& a, const Experiment& e) const {
    return experiment::stored_experiment(a.apply(e.name, *e.document), options_.tier,
                                         fmt::format("{} under {}", e.path, a.name));
  }

  std::string result_path(const Alternative& a, const Experiment& e) const {
    return (fs::path(options_.output).replace_extension() / folder_name(a.name) / (e.name + ".h5")).string();
  }

  // Adds the cells of the checks of one experiment under one alternative.
  // row is the row of the first check; it is advanced past the last one.
  void add_cells(const Alternative& a, const Experiment& baseline, std::size_t& row) {
    const Experiment experiment = experiment_under(a, baseline);
    const Alternative& of_baseline = matrix_.alternatives.front();
    const Experiment compared = experiment_under(of_baseline, baseline);
    const bool affected =
        &a == &of_baseline ||
        results::inputs_sha256(*experiment.document) != results::inputs_sha256(*compared.document) ||
        experiment.checks != compared.checks;
    const std::string path = result_path(affected ? a : of_baseline, baseline);
    if (affected)
      run::run_task({experiment, {}, path}, {options_.threads, false, true, options_.command_line});
    const results::ResultReader result(path);
    const std::size_t first = row;
    for (const Window& window : matrix_.windows) {
      row = first;
      const bool limited = std::ranges::count(window.experiments, baseline.name) > 0;
      for (checks::CheckResult& one :
           checks::evaluate_checks(result, limited ? window.where : decltype(window.where)())) {
        if (matrix_.rows.size() == row) matrix_.rows.push_back({baseline.name, {}});
        matrix_.rows[row++].cells.push_back({std::move(one), affected});
      }
    }
  }

  const AssumptionsOptions& options_;
  std::vector<Experiment> baseline_;
  Matrix matrix_;
};

}  // namespace

Matrix run_assumptions(const AssumptionsOptions& options) { return AssumptionsRun(options).run(); }

std::string inputs_sha256(const AssumptionsOptions& options) {
  std::vector<std::string> declarations;
  for (const std::string& file : options.files) declarations.push_back(read_json_file(file).dump());
  std::ranges::sort(declarations);
  Json inputs = {{"numerics_version", results::kNumericsVersion},
                 {"tier", options.tier},
                 {"declarations", declarations},
                 {"experiments", Json::array()}};
  for (const Experiment& e : experiments_with_claims(options)) inputs["experiments"].push_back(*e.document);
  return sha256_of(inputs.dump());
}

}  // namespace bristle::assumptions
