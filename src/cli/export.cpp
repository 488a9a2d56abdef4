#include "cli/commands.hpp"

#include "claims/store.hpp"
#include "results/csv.hpp"
#include "util/error.hpp"
#include "util/file.hpp"
#include "util/text.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <filesystem>

namespace bristle::cli {
namespace {

// Returns results/fig4.csv for results/fig4.h5 or, for a table, results/fig4.checks.csv.
std::string default_output(const ExportOptions& options) {
  std::filesystem::path path = options.file;
  return path.replace_extension(options.group.empty() ? ".csv" : "." + options.group + ".csv").string();
}

// Returns the table with these variables alone, their errors, the coordinates and the status. Throws
// InputError for a name that the table does not have.
results::Dataset reduced(const results::Dataset& table, const std::vector<std::string>& only,
                         const results::ResultReader& result) {
  require_variables(table, only, result.path());
  std::vector<std::string> kept = result.coordinates();
  kept.emplace_back("status");
  for (const std::string& name : only) {
    kept.push_back(name);
    kept.push_back(name + "_err");
  }
  results::Dataset out;
  out.add_dimension(table.dimensions().front());
  for (const results::Array& array : table.arrays())
    if (array.coordinate || std::ranges::find(kept, array.about.name) != kept.end()) out.add(array);
  return out;
}

}  // namespace

void require_variables(const results::Dataset& table, const std::vector<std::string>& only,
                       const std::string& path) {
  std::vector<std::string> known;
  for (const results::Array& array : table.arrays()) known.push_back(array.about.name);
  for (const std::string& name : only)
    if (std::ranges::find(known, name) == known.end())
      throw InputError(fmt::format("{}: --only {}: there is no such variable{}; `bristle info` lists all",
                                   path, printable(name), did_you_mean(name, known)));
}

int export_command(const ExportOptions& options) {
  if (!options.checks.empty() && options.group != "checks")
    throw InputError("--checks needs --group checks: other tables have no checks");
  const std::string output = options.output.empty() ? default_output(options) : options.output;
  const bool to_standard_output = output == "-";
  if (!to_standard_output) require_replaceable(output, results::csv_kind());
  const results::ResultReader result(options.file);
  result.require_intact();
  // Stored verdicts are not trusted: the checks are evaluated again.
  results::Dataset table = options.group == "checks"
                               ? claims::dataset_of(claims::evaluate_checks(result, options.checks))
                               : results::table_of(result, options.group);
  if (!options.only.empty()) table = reduced(table, options.only, result);
  if (to_standard_output) {
    fmt::print("{}", results::csv_text(result, table));
    return kSuccess;
  }
  write_whole(output, results::csv_text(result, table), results::csv_kind());
  fmt::print("{}: {} rows, {} columns\n", output, table.size(), table.arrays().size());
  return kSuccess;
}

}  // namespace bristle::cli
