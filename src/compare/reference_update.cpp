
#include "claims/checks.hpp"
#include "compare/reference.hpp"
#include "results/reader.hpp"
#include "results/variables.hpp"
#include "util/error.hpp"
#include "util/file.hpp"
#include "util/git.hpp"
#include "util/text.hpp"

#include <boost/algorithm/string/replace.hpp>
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

namespace bristle::compare {
namespace fs = std::filesystem;
namespace {

constexpr const char* kLogTitle = "# Changes of the references";
const std::string kLogStart = kLogTitle + std::string(
                                              "\n\nWritten by `bristle reference update`, oldest first. "
                                              "CONTRIBUTING.md describes the references.\n");

void require_reason(const std::string& reason) {
  if (reason.find_first_not_of(" \t\n") == std::string::npos || reason.find('\n') != std::string::npos)
    throw InputError(
        "--reason: give in one line why the reference changes; the reason is written to the references' "
        "CHANGELOG.md");
}

void require_origin(const results::ResultReader& result, const Reference& made,
                    const ReferenceUpdate& update) {
  const std::string tier = made.text("tier"), commit = made.text("commit"),
                    path = shell_quoted(result.path());
  const std::string run_again = fmt::format("`bristle run {} --force -o {}`", path, path);
  if (tier != "smoke")
    throw InputError(fmt::format(
        "{}: contains the {} tier, but a reference contains the smoke tier; {}", result.path(), tier,
        smoke_commands(result, made, update.most_bytes,
                       update.folder == kReferences ? "" : " --reference " + shell_quoted(update.folder))));
  if (commit.find("-dirty") != std::string::npos || commit.find("unknown") != std::string::npos)
    throw InputError(
        fmt::format("{}: computed by a program of commit {}, which cannot be built again; commit, "
                    "build, then {}",
                    result.path(), commit, run_again));
}

// Returns the number of points of an experiment's tier smoke; 0 if it cannot be read.
std::size_t smoke_points(const std::string& file) {
  try {
    return experiment::load_experiment(file, {{}, "smoke"}).sweep.size();
  } catch (const InputError&) {
    return 0;
  }
}

const std::set<PointStatus> kUnsound = {PointStatus::incomplete, PointStatus::not_converged,
                                        PointStatus::failed, PointStatus::work_limit};

// Returns the names of the variables that need not have a value at points with values.
std::set<std::string> may_be_missing(const results::ResultReader& result) {
  const Experiment experiment =
      experiment::stored_experiment(result.experiment(), result.text("tier"), result.path());
  std::set<std::string> names;
  for (const results::ResultVariable& variable : results::result_variables(experiment.sweep))
    if (variable.may_be_missing) names.insert(variable.name);
  return names;
}

void require_sound_run(const results::ResultReader& result, const Reference& made) {
  const auto require = [&](const results::Array& array, auto is_wrong) {
    for (std::size_t i = 0; i < array.values.size(); ++i)
      if (is_wrong(i))
        throw InputError(fmt::format("{}: {}: {} at {}; a reference requires a run without failures",
                                     result.path(), array.about.name, array.text(array.values[i]),
                                     results::place(result, array.about.name, i)));
  };
  const results::Array& status = result.variable("status");
  const std::set<std::string> absent = may_be_missing(result);
  require(status, [&](std::size_t i) { return kUnsound.contains(PointStatus(status.values[i])); });
  for (const results::Array& array : made.numbers.arrays())
    if (array.about.number == results::Number::real)
      require(array, [&](std::size_t i) {
        const auto at = PointStatus(status.values[i]);
        const bool has_values = at == PointStatus::ok || at == PointStatus::load_jump;
        return std::isinf(array.values[i]) ||
               (std::isnan(array.values[i]) && has_values && !absent.contains(array.about.name));
      });
}

// Returns the largest change of every variable, and the changes that have no size. Leaves out the result's
// folder, because it belongs to one machine.
std::string changes(const Comparison& comparison, const std::string& result) {
  std::string text;
  for (const auto* lines : {&comparison.notes, &comparison.subsets, &comparison.failures})
    for (const std::string& line : *lines) text += fmt::format("- {}\n", line);
  for (const Difference& d : comparison.differences) {
    const std::string size =
        std::isfinite(d.tolerances) ? fmt::format(", {:.3g} of the old tolerance", d.tolerances) : "";
    text += fmt::format("- {}: {} -> {} at {}{}\n", d.name, d.b, d.a, d.place, size);
  }
  boost::replace_all(text, result, fs::path(result).filename().string());
  return text.empty() ? "- the same values, but different tolerances, inputs or digests\n" : text;
}

// Writes both files under temporary names first, so that a full disk leaves both old files unchanged.
void write_files(const std::string& reference, const std::string& text, const std::string& log,
                 const std::string& record) {
  WholeFile new_reference(reference, {"a reference of bristle", "{", {"\"bristle-reference/"}});
  WholeFile new_log(log, {"the record of the references", kLogTitle, {}});
  new_reference.write(text);
  new_log.write(record);
  new_reference.close();
  new_log.close();
  new_log.publish();
  new_reference.publish();
}

// Throws InputError if the work tree outside the folder of the references, which need not exist yet, differs
// from its commit: the state that produced a reference must be reproducible.
void require_clean_work_tree(const std::string& folder) {
  const std::string option = "--reference " + folder;
  const fs::path path = fs::absolute(fs::path(folder) / "").lexically_normal().parent_path();
  if (!fs::is_directory(path.parent_path()))
    throw InputError(fmt::format("{}: there is no folder {}", option, path.parent_path().string()));
  const Repository repository(path.parent_path().string(), option,
                              "references belong to the program's repository");
  if (const std::string changes = repository.changes(path.filename().string()); !changes.empty())
    throw InputError(fmt::format("{}: the work tree differs from its commit; commit or stash first:\n{}",
                                 option, changes));
}

}  // namespace

std::string smoke_commands(const results::ResultReader& result, const Reference& made,
                           std::uintmax_t most_bytes, const std::string& options) {
  const auto provenance = result.provenance();
  const auto known = provenance.find("experiment_file");
  const std::string experiment = known == provenance.end() ? "" : known->second, name = result.text("name");
  const bool exists = experiment.ends_with(".json") && fs::is_regular_file(experiment);
  const std::size_t points = result.variable("status").values.size();
  if (const std::size_t smoke = exists ? smoke_points(experiment) : 0;
      double(smoke) * double(file_text(made).size()) > double(most_bytes) * double(points))
    return fmt::format(
        "the {} points of the tier smoke are too many for a reference: give {} a tier /tiers/smoke with "
        "fewer",
        smoke, experiment);
  const fs::path folder = fs::path(result.path()).parent_path();
  std::string output = (folder / (name + "-smoke.h5")).string();
  if (fs::path(output) == fs::path(result.path())) output = (folder / (name + "-smoke-tier.h5")).string();
  return fmt::format(
      "`bristle run {} --tier smoke -o {}`, then `bristle reference update {} --reason \"...\"{}`",
      exists ? shell_quoted(experiment) : "EXPERIMENT.json", shell_quoted(output), shell_quoted(output),
      options);
}

std::string update_reference(const ReferenceUpdate& update) {
  require_reason(update.reason);
  const results::ResultReader result(update.file);
  result.require_intact();
  const auto checks = claims::evaluate_checks(result);
  const Reference made = make_reference(result, checks);
  require_origin(result, made, update);
  require_sound_run(result, made);
  const std::string path = reference_path(update.folder, result.text("name"));
  std::optional<Reference> old;
  if (fs::exists(path)) old = read_reference(path);
  const std::string text = file_text(made);
  if (text.size() > update.most_bytes)
    throw InputError(fmt::format(
        "{}: has too many points for a reference, which would have {} bytes, and no more than {} are read; "
        "/tiers/smoke of the experiment chooses fewer points",
        update.file, text.size(), update.most_bytes));
  if (old) {
    Reference same_commit = made;
    same_commit.about["commit"] = old->about["commit"];
    if (file_text(*old) == file_text(same_commit)) return "";
  }
  require_clean_work_tree(update.folder);
  const std::string added = fmt::format(
      "\n## {} {}\n\n{}\n\n- program: {}\n- payload: {} -> {}\n{}", update.day, made.text("name"),
      update.reason, made.text("commit"), old ? old->text("payload_sha256") : "none",
      made.text("payload_sha256"),
      old ? changes(compare_with_reference(result, checks, *old, "the old reference"), update.file)
          : "- new reference\n");
  const std::string log = (fs::path(update.folder) / "CHANGELOG.md").string();
  const std::string before = fs::exists(log) ? read_file(log) : kLogStart;
  write_files(path, text, log, before + added);
  return added;
}

}  // namespace bristle::compare
