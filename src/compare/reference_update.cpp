#include "compare/reference_update.hpp"

#include "claims/checks.hpp"
#include "compare/deviation.hpp"
#include "compare/reference_file.hpp"
#include "results/datasets.hpp"
#include "results/digest.hpp"
#include "results/variables.hpp"
#include "util/error.hpp"
#include "util/file.hpp"
#include "util/git.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

namespace bristle::compare {
namespace fs = std::filesystem;
namespace {

// Variables without a value at some points: only points with a jump, an incomplete passage or a lattice have
// one.
const std::set<std::string> kMayBeMissing = {"jump_z_0", "jump_R_n", "incomplete_theta_0", "R_n_fluctuation",
                                             "R_n_fluctuation_of_rows"};

constexpr const char* kLogTitle = "# Changes of the references";

bool status_is(double status, PointStatus wanted) { return status == double(wanted); }

void require_reason(const std::string& reason) {
  if (reason.find_first_not_of(" \t\n") == std::string::npos || reason.find('\n') != std::string::npos)
    throw InputError(
        "--reason: give in one line why the reference changes; the reason is written to the references' "
        "CHANGELOG.md");
}

void require_origin(const results::ResultReader& result, const Reference& made) {
  const std::string run_again =
      fmt::format("`bristle run EXPERIMENT.json --tier smoke --force -o {}`", result.path());
  if (made.tier != "smoke")
    throw InputError(fmt::format("{}: contains the {} tier, but a reference contains the smoke tier; {}",
                                 result.path(), made.tier, run_again));
  const bool dirty = made.commit.find("-dirty") != std::string::npos;
  if (dirty || made.commit.find("unknown") != std::string::npos)
    throw InputError(
        fmt::format("{}: computed by a program of commit {}, which cannot be built again; commit, "
                    "build, then {}",
                    result.path(), made.commit, run_again));
}

const std::set<PointStatus> kUnsound = {PointStatus::incomplete, PointStatus::not_converged,
                                        PointStatus::failed, PointStatus::work_limit, PointStatus::ambiguous};

// Whether a value is infinite, or NaN although the point has values.
bool is_invalid(const std::string& name, double value, double status) {
  if (std::isinf(value)) return true;
  const bool has_values = status_is(status, PointStatus::ok) || status_is(status, PointStatus::load_jump);
  return std::isnan(value) && has_values && !kMayBeMissing.contains(name);
}

void require_sound_run(const results::ResultReader& result, const Reference& made) {
  const auto fail = [&](const std::string& name, const std::string& what) {
    throw InputError(
        fmt::format("{}: {}: {}; a reference requires a run without failures", result.path(), name, what));
  };
  const std::vector<double> status = result.variable("status").values;
  for (const ReferenceFlags& f : made.flags)
    if (!f.misfit.empty()) fail(f.name, f.misfit);
  for (std::size_t i = 0; i < status.size(); ++i)
    if (kUnsound.contains(PointStatus(status[i])))
      fail("status", fmt::format("{} at {}", results::value_text(result, "status", status[i]),
                                 results::place(result, "status", i)));
  for (const ReferenceVariable& v : made.variables) {
    if (!v.misfit.empty()) fail(v.name, v.misfit);
    for (std::size_t i = 0; i < v.values.size(); ++i)
      if (is_invalid(v.name, v.values[i], status[i]))
        fail(v.name, fmt::format("{} at {}", v.values[i], results::place(result, v.name, i)));
  }
}

// Whether two references contain the same, whichever commit computed them.
bool equivalent(Reference a, const Reference& b) {
  a.commit = b.commit;
  return reference_text(a) == reference_text(b);
}

std::string change_line(const results::ResultReader& result, const Deviation& d) {
  const std::string size =
      std::isfinite(d.tolerances) ? fmt::format(", {:.3g} of the old tolerance", d.tolerances) : "";
  return fmt::format(
      "- {}: {} -> {} at {}{}\n", d.variable, results::value_text(result, d.variable, d.reference),
      results::value_text(result, d.variable, d.now), results::place(result, d.variable, d.point), size);
}

// The largest change of every variable, and the changes that have no size.
std::string changes(const results::ResultReader& result, const Reference& old, const Reference& made) {
  const DeviationReport report = compare_with_reference(old, made);
  std::string text;
  for (const std::string& note : report.notes) text += fmt::format("- {}\n", note);
  for (const std::string& failure : report.failures) text += fmt::format("- {}\n", failure);
  std::set<std::string> listed;
  for (const Deviation& d : report.deviations)  // worst first
    if (listed.insert(d.variable).second) text += change_line(result, d);
  if (report.deviations.empty() && report.failures.empty())
    text += "- the same values, but different tolerances, inputs or digests\n";
  return text;
}

std::string entry(const ReferenceUpdate& update, const results::ResultReader& result, const Reference* old,
                  const Reference& made) {
  return fmt::format("\n## {} {}\n\n{}\n\n- program: {}\n- payload: {} -> {}\n{}", update.day, made.name,
                     update.reason, made.commit, old ? old->payload_sha256 : "none", made.payload_sha256,
                     old ? changes(result, *old, made) : std::string("- new reference\n"));
}

// Writes both files under temporary names first, so that a full disk leaves both old files.
void write_files(const std::string& reference, const std::string& text, const std::string& log,
                 const std::string& record) {
  WholeFile new_reference(reference, {"a reference of bristle", "{", {"\"bristle-reference/"}});
  WholeFile new_log(log, {"the record of the references", kLogTitle, {}});
  new_reference.write(text.data(), text.size());
  new_log.write(record.data(), record.size());
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

std::string update_reference(const ReferenceUpdate& update) {
  require_reason(update.reason);
  const results::ResultReader result(update.file);
  result.require_intact();
  const Reference made = make_reference(result, claims::evaluate_checks(result));
  require_origin(result, made);
  require_sound_run(result, made);
  const std::string path = reference_path(update.folder, made.name);
  std::optional<Reference> old;
  if (fs::exists(path)) old = read_reference(path);
  if (old && equivalent(*old, made)) return "";
  require_clean_work_tree(update.folder);
  const std::string log = (fs::path(update.folder) / "CHANGELOG.md").string();
  std::string added = entry(update, result, old ? &*old : nullptr, made);
  const std::string before = fs::exists(log)
                                 ? read_file(log)
                                 : kLogTitle + std::string(
                                                   "\n\nWritten by `bristle reference update`, "
                                                   "oldest first. docs/reference.md describes the "
                                                   "references.\n");
  write_files(path, reference_text(made), log, before + added);
  return added;
}

}  // namespace bristle::compare
