#include "cli/commands.hpp"

#include "util/error.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

namespace bristle::cli {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> assumption_files(const std::string& folder) {
  std::vector<std::string> files;
  if (fs::is_directory(folder))
    for (const auto& entry : fs::directory_iterator(folder))
      if (entry.path().extension() == ".json") files.push_back(entry.path().string());
  if (files.empty())
    throw InputError(fmt::format("{}: no files of assumptions (*.json) in this folder", folder));
  std::sort(files.begin(), files.end());
  return files;
}

void print_conclusions(const assumptions::Matrix& matrix) {
  std::map<std::string, int> counts;
  for (const assumptions::Matrix::Row& row : matrix.rows) {
    ++counts[assumptions::conclusion(matrix, row)];
    fmt::print("{:<5} {:<10} {:<20} {}\n", row.cells.front().result.check.claim,
               word(row.cells.front().result.verdict), assumptions::conclusion(matrix, row),
               row.cells.front().result.check.statement);
  }
  fmt::print("{} checks under {} alternatives: {} robust, {} weakened, {} assumption-dependent, {} open\n",
             matrix.rows.size(), matrix.alternatives.size() - 1, counts["robust"], counts["weakened"],
             counts["assumption-dependent"], counts["open"]);
}

// Returns true if the output is a matrix, unchanged, of the same inputs.
bool is_up_to_date(const assumptions::AssumptionsOptions& options) {
  if (!is_of_kind(options.output, assumptions::replaceable_by_matrix())) return false;
  try {
    const Json matrix = read_json_file(options.output);
    return matrix.value("inputs_sha256", "") == assumptions::inputs_sha256(options) &&
           matrix.value("payload_sha256", "") == assumptions::matrix_payload_sha256(matrix);
  } catch (const InputError&) {  // damaged, or a mistake in the inputs, which the run reports
    return false;
  } catch (const Json::exception&) {  // a digest that is not text
    return false;
  }
}

}  // namespace

int assumptions_command(assumptions::AssumptionsOptions options) {
  if (options.files.empty())
    options.files = assumption_files((fs::path(options.experiments) / "assumptions").string());
  if (is_up_to_date(options)) {
    fmt::print("{}: up to date; remove it to evaluate the checks again\n", options.output);
    return kSuccess;
  }
  const assumptions::Matrix matrix = assumptions::run_assumptions(options);
  write_whole(options.output, json_lines(assumptions::matrix_json(matrix)),
              assumptions::replaceable_by_matrix());
  print_conclusions(matrix);
  return kSuccess;
}

}  // namespace bristle::cli
