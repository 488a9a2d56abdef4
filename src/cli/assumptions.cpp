#include "cli/assumptions.hpp"

#include "cli/exit_code.hpp"
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
    ++counts[assumptions::conclusion(row)];
    fmt::print("{:<5} {:<10} {:<20} {}\n", row.cells.front().result.check.claim,
               checks::to_string(row.cells.front().result.verdict), assumptions::conclusion(row),
               row.cells.front().result.check.statement);
  }
  fmt::print("{} checks under {} alternatives: {} robust, {} weakened, {} assumption-dependent, {} open\n",
             matrix.rows.size(), matrix.alternatives.size() - 1, counts["robust"], counts["weakened"],
             counts["assumption-dependent"], counts["open"]);
}

}  // namespace

int assumptions_command(assumptions::AssumptionsOptions options) {
  if (options.files.empty())
    options.files = assumption_files((fs::path(options.experiments) / "assumptions").string());
  const assumptions::Matrix matrix = assumptions::run_assumptions(options);
  write_whole(options.output, assumptions::matrix_json(matrix).dump(1) + "\n",
              assumptions::replaceable_by_matrix());
  print_conclusions(matrix);
  return kSuccess;
}

}  // namespace bristle::cli
