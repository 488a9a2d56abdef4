#include "assumptions/assumptions.hpp"

#include "claims/checks.hpp"
#include "results/digest.hpp"
#include "results/reader.hpp"
#include "results/version.hpp"
#include "run/progress.hpp"
#include "run/task.hpp"
#include "util/error.hpp"
#include "util/sha.hpp"
#include "util/text.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <filesystem>
#include <map>

namespace bristle::assumptions {
namespace {

namespace fs = std::filesystem;

constexpr const char* kClaims = "claims to evaluate: checks, and either a figure or a tier \"study\"";

// Returns all experiments with checks that belong to a figure of the paper or have a tier `study`, in the
// order of their file names.
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
    if (!claims::read_checks(e).empty() && (e.has_study_tier || !e.figure.empty()))
      out.push_back(std::move(e));
  }
  if (out.empty())
    throw InputError(
        fmt::format("--experiments {}: no experiment in this folder has {}", options.experiments, kClaims));
  return out;
}

std::vector<std::string> names_of(const std::vector<Experiment>& experiments) {
  std::vector<std::string> names;
  for (const Experiment& e : experiments) names.push_back(e.name);
  return names;
}

// Throws InputError for a name that none of these experiments has; `where` says who gives the name.
void require_experiment(const std::vector<Experiment>& all, const std::string& name,
                        const std::string& where) {
  if (std::ranges::find(all, name, &Experiment::name) == all.end())
    throw InputError(fmt::format("{}: no experiment {} has {}{}", where, name, kClaims,
                                 did_you_mean(name, names_of(all))));
}

// Returns the experiments that --only names, or all.
std::vector<Experiment> chosen_experiments(const AssumptionsOptions& options) {
  std::vector<Experiment> all = experiments_with_claims(options);
  for (const std::string& name : options.only) require_experiment(all, name, "--only " + name);
  if (!options.only.empty())
    std::erase_if(all, [&](const Experiment& e) { return std::ranges::count(options.only, e.name) == 0; });
  return all;
}

// Throws InputError if an alternative changes an experiment that does not exist.
void check_names(const std::vector<Alternative>& alternatives, const std::vector<Experiment>& all) {
  for (const Alternative& a : alternatives)
    for (const auto& declaration : a.declarations) {
      const Json changes = declaration->value("experiments", Json::object());
      for (const auto& [name, change] : changes.items())
        require_experiment(all, name, fmt::format("alternative {}: /experiments", a.name));
    }
}

// Replaces characters that should not be in the name of a folder.
std::string folder_name(std::string name) {
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && std::string("_.-+").find(c) == std::string::npos)
      c = '_';
  return name;
}

// Throws InputError if the results of an alternative would lie outside the folder of the matrix or in the
// folder of another alternative.
void check_folders(const std::vector<Alternative>& alternatives) {
  std::map<std::string, std::string> names;  // by folder
  for (const Alternative& a : alternatives) {
    const std::string folder = folder_name(a.name);
    if (folder.find_first_not_of('.') == folder.npos)
      throw InputError(
          fmt::format("alternative {}: its name cannot be the name of a folder; give it another one",
                      Json(a.name).dump()));
    if (const auto [same, is_new] = names.emplace(folder, a.name); !is_new)
      throw InputError(
          fmt::format("alternatives {} and {}: both have the folder {} for their results; give one "
                      "of them another name",
                      Json(same->second).dump(), Json(a.name).dump(), folder));
  }
}

// Returns whether two experiments differ in the numbers of a point, or in their checks.
bool differ(const Experiment& a, const Experiment& b) {
  if (claims::read_checks(a) != claims::read_checks(b) || a.sweep.size() != b.sweep.size()) return true;
  Json of_a = *a.document, of_b = *b.document;
  for (const char* block : {"model", "si", "load"})  // points tell whether these differ
    for (Json* document : {&of_a, &of_b}) document->erase(block);
  for (const char* key : {"mean_deg", "concentration"})
    for (Json* document : {&of_a, &of_b})
      if (document->contains("orientation")) (*document)["orientation"].erase(key);
  if (results::inputs_sha256(of_a) != results::inputs_sha256(of_b)) return true;
  for (std::size_t i = 0; i < a.sweep.size(); ++i)
    if (!same_effect(a.sweep.point(i), b.sweep.point(i))) return true;
  return false;
}

class AssumptionsRun {
 public:
  explicit AssumptionsRun(const AssumptionsOptions& options)
      : options_(options), baseline_(chosen_experiments(options)) {
    matrix_.tier = options.tier;
    matrix_.only = options.only;
    matrix_.inputs_sha256 = inputs_sha256(options);
    matrix_.alternatives = read_alternatives(options.files);
    check_names(matrix_.alternatives, experiments_with_claims(options));
    check_folders(matrix_.alternatives);
  }

  void validate() const {
    std::vector<Experiment> compared;
    for (const Alternative& a : matrix_.alternatives) {
      bool any_differ = false;
      for (std::size_t i = 0; i < baseline_.size(); ++i) {
        const Experiment experiment = experiment_under(a, baseline_[i]);
        claims::validate_checks(experiment);
        if (&a == &matrix_.alternatives.front()) compared.push_back(experiment);
        else any_differ = any_differ || differ(experiment, compared[i]);
      }
      if (!any_differ && &a != &matrix_.alternatives.front() && options_.only.empty())
        throw InputError(fmt::format(
            "alternative {}: changes no number of any experiment, so that every verdict would be called "
            "robust; mend its patch, or remove it",
            Json(a.name).dump()));
    }
  }

  Matrix run() {
    // Reports a mistake in an alternative, and a file that is in the way, before computing anything.
    validate();
    require_replaceable(options_.output, replaceable_by_matrix());
    for (const Alternative& a : matrix_.alternatives)
      for (const Experiment& e : baseline_) require_replaceable(result_path(a, e), results::result_file());
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
        claims::read_checks(experiment) != claims::read_checks(compared);
    const std::string path = result_path(affected ? a : of_baseline, baseline);
    if (affected)
      run::run_experiment(
          experiment,
          {.output = path, .threads = options_.threads, .quiet = true, .arguments = options_.arguments});
    const results::ResultReader result(path);
    for (claims::CheckResult& one : claims::evaluate_checks(result)) {
      if (matrix_.rows.size() == row) matrix_.rows.push_back({baseline.name, {}});
      matrix_.rows[row++].cells.push_back({std::move(one), affected});
    }
  }

  const AssumptionsOptions& options_;
  std::vector<Experiment> baseline_;
  Matrix matrix_;
};

}  // namespace

void validate_assumptions(const AssumptionsOptions& options) { AssumptionsRun(options).validate(); }

Matrix run_assumptions(const AssumptionsOptions& options) { return AssumptionsRun(options).run(); }

std::string inputs_sha256(const AssumptionsOptions& options) {
  std::vector<std::string> declarations;
  for (const std::string& file : options.files) declarations.push_back(read_json_file(file).dump());
  std::ranges::sort(declarations);
  Json inputs = {{"numerics_version", results::kNumericsVersion},
                 {"tier", options.tier},
                 {"declarations", declarations},
                 {"experiments", Json::array()}};
  for (const Experiment& e : chosen_experiments(options)) inputs["experiments"].push_back(*e.document);
  return sha256_of(inputs.dump());
}

}  // namespace bristle::assumptions
