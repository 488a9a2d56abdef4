#include "cli/commands.hpp"

#include "claims/checks.hpp"
#include "compare/comparison.hpp"
#include "compare/reference.hpp"
#include "compare/replay.hpp"
#include "run/provenance.hpp"
#include "util/data.hpp"
#include "util/text.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

namespace bristle::cli {
namespace {

bool all_supported(const std::vector<claims::CheckResult>& checks) {
  return std::ranges::all_of(
      checks, [](const claims::CheckResult& c) { return c.claim_verdict == Verdict::supported; });
}

// Returns ", " and the name of a reading, with its word in files if that is another; empty for no reading.
std::string with_key(const std::string& reading) {
  const std::string name = claims::name_of_reading(reading);
  return name == reading ? (name.empty() ? "" : ", " + name) : fmt::format(", {} ({})", name, reading);
}

// Prints the verdicts of the claims; returns whether all are supported.
bool report_claims(const CheckOptions& options, const std::vector<claims::CheckResult>& checks) {
  if (checks.empty()) {
    fmt::print("{}: the experiment has no checks\n", options.file);
    return true;
  }
  fmt::print("{}", claims::checks_table(checks, options.all, terminal_columns()));
  const auto further =
      std::ranges::count_if(checks, [](const claims::CheckResult& c) { return !c.check.main; });
  if (further > 0 && !options.all)
    fmt::print("{} further verdicts decide nothing; `bristle check {} --all` prints them\n", further,
               shell_quoted(options.file));
  std::vector<std::pair<std::string, std::map<Verdict, int>>> counts;  // by reading
  for (const claims::ClaimVerdict& c : claims::claim_verdicts(checks)) {
    auto of_reading = std::ranges::find(counts, c.reading, [](const auto& one) { return one.first; });
    if (of_reading == counts.end()) of_reading = counts.insert(counts.end(), {c.reading, {}});
    ++of_reading->second[c.verdict];
  }
  for (auto& [reading, count] : counts)
    fmt::print("claims{}: {} supported, {} refuted, {} undecided, {} that depend on what is meant\n",
               with_key(reading), count[Verdict::supported], count[Verdict::refuted],
               count[Verdict::undecided], count[Verdict::depends]);
  return all_supported(checks);
}

std::string reference_of(const CheckOptions& options, const results::ResultReader& result) {
  std::string folder = options.reference;
  if (folder.empty() && !std::filesystem::exists("reference")) folder = data_path("reference").value_or("");
  return compare::reference_path(folder.empty() ? "reference" : folder, result.text("name"));
}

// Returns the commands that compute the points of the largest differences again.
std::string replays(const compare::Comparison& comparison, const results::ResultReader& result) {
  constexpr std::size_t kMaxShown = 5;
  std::string text;
  const compare::ReplayCommands commands(result);
  std::set<std::size_t> listed;
  for (const compare::Difference& d : comparison.differences)
    if (listed.size() < kMaxShown && listed.insert(d.where).second)
      text += fmt::format("To compute {} again:\n  {}\n", d.place, commands.of_point(d.where));
  return text;
}

// Compares with the stored reference; returns whether all is within the tolerances.
bool report_deviations(const CheckOptions& options, const results::ResultReader& result,
                       const std::vector<claims::CheckResult>& checks) {
  const std::string path = reference_of(options, result);
  if (!std::filesystem::exists(path)) {
    const std::string folder =
        options.reference.empty() ? "" : " --reference " + shell_quoted(options.reference);
    const std::string advice =
        result.text("tier") == "smoke"
            ? fmt::format("`bristle reference update {} --reason \"...\"{}`", shell_quoted(options.file),
                          folder)
            : compare::smoke_commands(result, compare::make_reference(result, checks), kMaxJsonBytes, folder);
    fmt::print(
        "FAILED: {}: no such reference; it is made of a result of the smoke tier: {}; --claims-only skips "
        "the comparison\n",
        path, advice);
    return false;
  }
  const auto comparison =
      compare::compare_with_reference(result, checks, compare::read_reference(path), path);
  fmt::print("{}", compare::comparison_text(comparison, replays(comparison, result)));
  return comparison.agree();
}

// Prints deviations and replay commands as JSON; "deviation" is
// null if there is no reference, and "error" says so. Returns whether no check failed.
bool print_json(const CheckOptions& options, const results::ResultReader& result,
                const std::vector<claims::CheckResult>& checks) {
  const std::string path = reference_of(options, result);
  Json out = {{"file", options.file},
              {"deviation", nullptr},
              {"replay", compare::ReplayCommands(result).of_all_points()}};
  if (std::filesystem::exists(path))
    out["deviation"] = compare::comparison_json(
        compare::compare_with_reference(result, checks, compare::read_reference(path), path));
  else if (!options.claims_only)
    out["error"] = path + ": no such reference; --claims-only skips the comparison";
  fmt::print("{}\n", out.dump(1));
  const bool reference_failed = out["deviation"].is_null() || out["deviation"]["failed"].get<bool>();
  return (all_supported(checks) || options.report_only) && (!reference_failed || options.claims_only);
}

}  // namespace

int diff_command(const DiffOptions& options) {
  const results::ResultReader a(options.a), b(options.b);
  a.require_intact();
  b.require_intact();
  if (!options.only.empty()) return print_side_by_side(a, b, options);
  const compare::Comparison comparison = compare::diff_results(a, b, options.tolerances);
  fmt::print("{}", compare::comparison_text(comparison));
  return comparison.agree() ? kSuccess : kCheckFailed;
}

int check_command(const CheckOptions& options) {
  const results::ResultReader result(options.file);
  result.require_intact();
  const auto checks = claims::evaluate_checks(result);
  if (options.json) return print_json(options, result, checks) ? kSuccess : kCheckFailed;
  const bool supported = report_claims(options, checks), claims = supported || options.report_only;
  if (!claims)
    fmt::print("not every claim is supported: exit code 1; --report-only leaves verdicts out of it\n");
  const bool reference = options.claims_only || report_deviations(options, result, checks);
  return claims && reference ? kSuccess : kCheckFailed;
}

int reference_update_command(compare::ReferenceUpdate update) {
  update.day = run::utc_now().substr(0, 10);
  const std::string entry = compare::update_reference(update);
  if (entry.empty()) fmt::print("unchanged: the reference already has these values; nothing was written\n");
  else
    fmt::print("recorded in {}:\n{}", (std::filesystem::path(update.folder) / "CHANGELOG.md").string(),
               entry);
  return kSuccess;
}

}  // namespace bristle::cli
