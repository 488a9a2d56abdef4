#include "checks/reference_update.hpp"

#include "checks/comparison.hpp"
#include "checks/drift.hpp"
#include "checks/work_tree.hpp"
#include "util/error.hpp"
#include "results/variables.hpp"
#include "results/writer.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

namespace bristle {
namespace fs = std::filesystem;
namespace {

// Variables that points may have no value of: there is a jump, a lost passage, a lattice, or there is none.
const std::set<std::string> kMayBeMissing = {"jump_z_0", "jump_R_n", "incomplete_theta_0", "R_n_fluctuation",
                                             "R_n_fluctuation_of_rows"};

bool status_is(double status, PointStatus wanted) { return status == double(wanted); }

void require_reason(const std::string& reason) {
  if (reason.find_first_not_of(" \t\n") == std::string::npos || reason.find('\n') != std::string::npos)
    throw InputError(
        "--reason: say in one line why the reference changes: it is recorded in the references' "
        "CHANGELOG.md");
}

void require_origin(const ResultReader& result, const Reference& made) {
  const std::string again =
      fmt::format("`bristle run EXPERIMENT.json --tier smoke --force -o {}`", result.path());
  if (payload_sha256(result.file()) != made.payload_sha256)
    throw InputError(
        fmt::format("{}: payload_sha256 does not match the numbers: the file was changed or damaged; {}",
                    result.path(), again));
  if (made.tier != "smoke")
    throw InputError(
        fmt::format("{}: holds the {} tier; a reference holds the smoke tier, every commit's: {}",
                    result.path(), made.tier, again));
  const bool dirty = made.commit.find("-dirty") != std::string::npos;
  if (dirty || made.commit.find("unknown") != std::string::npos)
    throw InputError(
        fmt::format("{}: computed by a program of commit {}, which nobody can build again; commit, "
                    "build, then {}",
                    result.path(), made.commit, again));
}

// A value that is not there although its point has values, or is infinite.
bool is_lost(const std::string& name, double value, double status) {
  if (std::isinf(value)) return true;
  const bool has_values = status_is(status, PointStatus::ok) || status_is(status, PointStatus::jump);
  return std::isnan(value) && has_values && !kMayBeMissing.contains(name);
}

void require_sound_run(const ResultReader& result, const Reference& made) {
  const auto fail = [&](const std::string& name, const std::string& what) {
    throw InputError(
        fmt::format("{}: {}: {}; a reference is made of runs without failures", result.path(), name, what));
  };
  const std::vector<double> status = result.variable("status").values;
  for (const ReferenceFlags& f : made.flags)
    if (!f.misfit.empty()) fail(f.name, f.misfit);
  for (std::size_t i = 0; i < status.size(); ++i)
    if (status_is(status[i], PointStatus::incomplete) || status_is(status[i], PointStatus::not_converged))
      fail("status",
           fmt::format("{} at {}", value_text(result, "status", status[i]), place(result, "status", i)));
  for (const ReferenceVariable& v : made.variables) {
    if (!v.misfit.empty()) fail(v.name, v.misfit);
    for (std::size_t i = 0; i < v.values.size(); ++i)
      if (is_lost(v.name, v.values[i], status[i]))
        fail(v.name, fmt::format("{} at {}", v.values[i], place(result, v.name, i)));
  }
}

// Two references that hold a later program against the same: wherever they were computed.
bool says_the_same(Reference a, const Reference& b) {
  a.commit = b.commit;
  a.payload_sha256 = b.payload_sha256;
  return reference_text(a) == reference_text(b);
}

std::string change_line(const ResultReader& result, const Drift& d) {
  const std::string units =
      std::isfinite(d.units) ? fmt::format(", {:.3g} of the old tolerance", d.units) : "";
  return fmt::format("- {}: {} -> {} at {}{}\n", d.variable, value_text(result, d.variable, d.reference),
                     value_text(result, d.variable, d.now), place(result, d.variable, d.point), units);
}

// What changed: the largest change of every variable, and what has no size.
std::string changes(const ResultReader& result, const Reference& old, const Reference& made) {
  const DriftReport report = drift(old, made);
  std::string text;
  for (const std::string& note : report.notes) text += fmt::format("- {}\n", note);
  for (const std::string& failure : report.failures) text += fmt::format("- {}\n", failure);
  std::set<std::string> told;
  for (const Drift& d : report.drifts)  // worst first
    if (told.insert(d.variable).second) text += change_line(result, d);
  if (report.drifts.empty() && report.failures.empty())
    text += "- the same values, other tolerances or inputs\n";
  return text;
}

std::string entry(const ReferenceUpdate& update, const ResultReader& result, const Reference* old,
                  const Reference& made) {
  return fmt::format("\n## {} {}\n\n{}\n\n- program: {}\n- payload: {} -> {}\n{}", update.day, made.name,
                     update.reason, made.commit, old ? old->payload_sha256 : "none", made.payload_sha256,
                     old ? changes(result, *old, made) : std::string("- new reference\n"));
}

std::string read_text(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void write_text(const fs::path& path, const std::string& text) {
  std::ofstream out(path, std::ios::binary);
  out << text;
  out.close();
  if (!out) throw RunError(fmt::format("{}: cannot be written", path.string()));
}

// Both files under temporary names first: a full disk leaves the old ones.
void write_files(const fs::path& reference, const std::string& text, const fs::path& log,
                 const std::string& record) {
  std::error_code error;
  fs::create_directories(reference.parent_path(), error);
  const fs::path new_reference = reference.string() + ".new", new_log = log.string() + ".new";
  try {
    write_text(new_reference, text);
    write_text(new_log, record);
    fs::rename(new_log, log);
    fs::rename(new_reference, reference);
  } catch (...) {
    fs::remove(new_reference, error);
    fs::remove(new_log, error);
    throw;
  }
}

}  // namespace

std::string update_reference(const ReferenceUpdate& update) {
  require_reason(update.reason);
  const ResultReader result(update.file);
  const Reference made = make_reference(result, evaluate_checks(result));
  require_origin(result, made);
  require_sound_run(result, made);
  const std::string path = reference_path(update.folder, made.name);
  std::optional<Reference> old;
  if (fs::exists(path)) old = read_reference(path);
  if (old && says_the_same(*old, made)) return "";
  require_clean_work_tree(update.folder);
  const fs::path log = fs::path(update.folder) / "CHANGELOG.md";
  std::string added = entry(update, result, old ? &*old : nullptr, made);
  const std::string before = fs::exists(log)
                                 ? read_text(log)
                                 : "# Changes of the references\n\nWritten by `bristle reference update`; "
                                   "oldest first. docs/reference.md says what is in a reference.\n";
  write_files(path, reference_text(made), log, before + added);
  return added;
}

}  // namespace bristle
