#include "cli/commands.hpp"
#include "util/error.hpp"
#include "util/file.hpp"
#include "assumptions/study.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>

namespace bristle {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> declared_in(const std::string& folder) {
  std::vector<std::string> files;
  if (fs::is_directory(folder))
    for (const auto& entry : fs::directory_iterator(folder))
      if (entry.path().extension() == ".json") files.push_back(entry.path().string());
  if (files.empty()) throw InputError(fmt::format("{}: no assumptions are declared there (*.json)", folder));
  std::sort(files.begin(), files.end());
  return files;
}

void write_matrix(const std::string& path, const Matrix& matrix) {
  const std::string partial = path + ".partial";
  try {
    std::ofstream out(partial);
    out << matrix_json(matrix).dump(1) << '\n';
    out.close();
    if (!out) throw RunError(fmt::format("{}: cannot be written", path));
    replace_file(partial, path);
  } catch (const RunError&) {
    std::error_code ignored;
    fs::remove(partial, ignored);
    throw;
  }
}

void print_conclusions(const Matrix& matrix) {
  std::map<std::string, int> counts;
  for (const Matrix::Row& row : matrix.rows) {
    ++counts[conclusion(row)];
    fmt::print("{:<5} {:<10} {:<9} {}\n", row.claim, to_string(row.cells.front().check.verdict),
               conclusion(row), row.statement);
  }
  fmt::print("{} checks under {} alternatives: {} robust, {} weakened, {} hang on an assumption, {} open\n",
             matrix.rows.size(), matrix.alternatives.size() - 1, counts["robust"], counts["weakened"],
             counts["hangs"], counts["open"]);
}

}  // namespace

int assumptions_command(StudyOptions options) {
  if (options.files.empty())
    options.files = declared_in((fs::path(options.experiments) / "assumptions").string());
  const fs::path folder = fs::path(options.output).parent_path();
  if (!folder.empty()) fs::create_directories(folder);
  const Matrix matrix = study(options);
  write_matrix(options.output, matrix);
  print_conclusions(matrix);
  return kFine;
}

}  // namespace bristle
