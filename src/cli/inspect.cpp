#include "cli/inspect.hpp"

#include "cli/exit_code.hpp"
#include "results/reader.hpp"
#include "results/variables.hpp"
#include "util/error.hpp"
#include "util/grid.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>

namespace bristle::cli {
namespace {

void print_variable(const results::ResultReader& result, const std::string& name) {
  const results::Variable v = result.variable(name);
  double low = INFINITY, high = -INFINITY;
  std::size_t values = 0;
  for (const double x : v.values)
    if (std::isfinite(x)) {
      low = std::min(low, x);
      high = std::max(high, x);
      ++values;
    }
  const std::string where = v.dimensions.empty() ? "" : fmt::format("({})", fmt::join(v.dimensions, ", "));
  if (values == 0) {
    fmt::print("  {:<22} {:<20} no values\n", name, where);
    return;
  }
  fmt::print("  {:<22} {:<20} {:>12.6g} .. {:<12.6g}{}\n", name, where, low, high,
             values < v.values.size() ? fmt::format(" {} without a value", v.values.size() - values) : "");
}

// Prints which part of the sweep the file contains, and reduces status to its points.
void restrict_to_part(const results::ResultReader& result, results::Variable& status) {
  const std::size_t points = grid_size(result.sweep_shape());
  const auto own = result.part_points();
  if (points == 0 || status.values.size() % points != 0 || (!own.empty() && own.back() >= points))
    throw InputError(
        fmt::format("{}: damaged: status, part/points and the sweep are inconsistent", result.path()));
  const std::size_t nodes = status.values.size() / points;  // of a traced curve; otherwise 1
  fmt::print("part {}: {} of {} points; {}\n", results::shard_text(*result.shard()), own.size(), points,
             results::how_to_merge(result.path(), *result.shard()));
  std::vector<double> kept;
  for (const std::size_t p : own)
    kept.insert(kept.end(), status.values.begin() + long(p * nodes),
                status.values.begin() + long((p + 1) * nodes));
  status.values = std::move(kept);
}

void print_statuses(const results::ResultReader& result) {
  results::Variable status = result.variable("status");
  if (result.shard()) restrict_to_part(result, status);
  fmt::print("points:{}", status.values.empty() ? " none" : "");
  for (std::size_t s = 0; s < results::kPointStatusNames.size(); ++s)
    if (const auto n = std::count(status.values.begin(), status.values.end(), double(s)))
      fmt::print(" {} {}", n, results::kPointStatusNames[s]);
  fmt::print("\n");
}

void print_failures(const results::ResultReader& result) {
  const auto failures = result.failures();
  if (!failures.empty()) fmt::print("failed points, by index (the last axis fastest):\n");
  for (const auto& [point, error] : failures) fmt::print("  {:<22} {}\n", point, error);
}

void print_provenance(const results::ResultReader& result) {
  const auto provenance = result.provenance();
  if (provenance.empty()) return;
  // Order of the entries; all others follow.
  std::vector<std::string> names = {"command_line",    "started",        "finished", "host",
                                    "system",          "threads",        "cpu",      "cpu_features",
                                    "instruction_set", "version",        "commit",   "dirty",
                                    "points_computed", "points_commits", "compiler", "flags"};
  for (const auto& [name, text] : provenance)
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  fmt::print("provenance:\n");
  for (const std::string& name : names)
    if (const auto entry = provenance.find(name); entry != provenance.end())
      fmt::print("  {:<22} {}\n", name, entry->second);
}

}  // namespace

int info_command(const std::string& file) {
  const results::ResultReader result(file, results::Expected::either);
  const bool intact = result.damage().empty();
  fmt::print("{}: {}\n", file, result.text("title"));
  fmt::print("schema {}, experiment {}\npayload sha256 {}{}\n", result.text("schema_version"),
             result.text("name"), result.text("payload_sha256"), intact ? " (verified)" : "");
  for (const std::string& what : result.damage()) fmt::print("DAMAGED: {}\n", what);
  print_statuses(result);
  print_failures(result);
  fmt::print("variables (smallest .. largest):\n");
  for (const std::string& name : result.variables()) print_variable(result, name);
  print_provenance(result);
  return intact ? kSuccess : kCheckFailed;
}

}  // namespace bristle::cli
