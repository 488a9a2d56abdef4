#include "cli/commands.hpp"

#include "claims/store.hpp"
#include "results/csv.hpp"
#include "util/error.hpp"
#include "util/file.hpp"

#include <fmt/format.h>
#include <filesystem>

namespace bristle::cli {
namespace {

// results/fig4.h5 -> results/fig4.csv or, for a table, results/fig4.checks.csv
std::string default_output(const ExportOptions& options) {
  std::filesystem::path path = options.file;
  return path.replace_extension(options.group.empty() ? ".csv" : "." + options.group + ".csv").string();
}

}  // namespace

int export_command(const ExportOptions& options) {
  if (!options.checks.empty() && options.group != "checks")
    throw InputError("--checks needs --group checks: other tables have no checks");
  const std::string output = options.output.empty() ? default_output(options) : options.output;
  const bool to_standard_output = output == "-";
  if (!to_standard_output) require_replaceable(output, results::csv_kind());
  const results::ResultReader result(options.file);
  result.require_intact();
  // Stored verdicts are not trusted: the checks are evaluated again.
  const results::Dataset table = options.group == "checks"
                                     ? claims::dataset_of(claims::evaluate_checks(result, {}, options.checks))
                                     : results::table_of(result, options.group);
  if (to_standard_output) {
    fmt::print("{}", results::csv_text(result, table));
    return kSuccess;
  }
  write_whole(output, results::csv_text(result, table), results::csv_kind());
  fmt::print("{}: {} rows, {} columns\n", output, table.size(), table.arrays().size());
  return kSuccess;
}

}  // namespace bristle::cli
