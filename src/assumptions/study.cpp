#include "assumptions/study.hpp"

#include "util/error.hpp"
#include "results/writer.hpp"
#include "run/progress.hpp"
#include "run/task.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iterator>

namespace bristle {
namespace {

namespace fs = std::filesystem;

// In the order of their names.
std::vector<Experiment> with_claims(const StudyOptions& options) {
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

// A name as a folder's.
std::string folder_name(std::string name) {
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && std::string("_.-+").find(c) == std::string::npos)
      c = '_';
  return name;
}

class Study {
 public:
  explicit Study(const StudyOptions& options) : options_(options), settled_(with_claims(options)) {
    matrix_.tier = options.tier;
    matrix_.alternatives = {{"settled", "", "every open choice as docs/model.md settles it", {}, {}}};
    std::ranges::copy(read_alternatives(options.files), std::back_inserter(matrix_.alternatives));
  }

  Matrix run() {
    // All alternatives are looked at before the first is computed.
    for (const Alternative& a : matrix_.alternatives)
      for (const Experiment& e : settled_) validate_checks(under(a, e));
    Progress progress("assumptions", matrix_.alternatives.size() * settled_.size(), options_.quiet);
    for (const Alternative& a : matrix_.alternatives) {
      std::size_t row = 0;
      for (const Experiment& e : settled_) {
        add(a, e, row);
        progress.step();
      }
    }
    progress.finish();
    return std::move(matrix_);
  }

 private:
  Experiment under(const Alternative& a, const Experiment& e) const {
    return stored_experiment(a.apply(e.name, e.document), options_.tier,
                             fmt::format("{} under {}", e.path, a.name));
  }

  // The cells of one experiment's checks under one alternative; row is that of its first check.
  void add(const Alternative& a, const Experiment& settled, std::size_t& row) {
    const Experiment experiment = under(a, settled);
    const bool affected = a.declared.empty() ||
                          inputs_sha256(experiment.document) != inputs_sha256(settled.document) ||
                          experiment.checks != settled.checks;
    const std::string& folder = affected ? a.name : matrix_.alternatives.front().name;
    const std::string path =
        (fs::path(options_.output).replace_extension() / folder_name(folder) / (settled.name + ".h5"))
            .string();
    if (affected) carry_out({experiment, {}, path}, {options_.threads, false, true, options_.command_line});
    for (CheckResult& check : evaluate_checks(ResultReader(path))) {
      if (matrix_.rows.size() == row)
        matrix_.rows.push_back({settled.name, check.claim, check.statement, {}});
      matrix_.rows[row++].cells.push_back({std::move(check), affected});
    }
  }

  const StudyOptions& options_;
  std::vector<Experiment> settled_;
  Matrix matrix_;
};

}  // namespace

Matrix study(const StudyOptions& options) { return Study(options).run(); }

}  // namespace bristle
