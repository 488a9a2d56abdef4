#include "json/table.hpp"

#include "util/error.hpp"
#include "util/file.hpp"
#include "util/text.hpp"

#include <boost/algorithm/string/replace.hpp>
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <sstream>

namespace bristle::json {
namespace {

// Returns the number that the text states, or the text itself if it states none, nan, inf or a number beyond
// the largest.
Json cell_value(const std::string& text) {
  const auto number = number_in(text);
  return number && std::isfinite(*number) ? Json(*number) : Json(text);
}

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r\""), last = text.find_last_not_of(" \t\r\"");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

// Returns the cells of a line of comma-separated values. Numbers and words contain no commas.
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  for (const char c : line)
    if (c == ',') cells.emplace_back();
    else cells.back() += c;
  for (std::string& cell : cells) cell = trimmed(cell);
  return cells;
}

// Returns the first number in quotes that has a comma, such as "0,02" with its quotes; empty if there is
// none.
std::string number_with_comma(const std::string& line) {
  for (auto from = line.find('"'); from != line.npos;) {
    const auto to = line.find('"', from + 1);
    if (to == line.npos) return "";
    const std::string quoted = line.substr(from, to + 1 - from);
    if (quoted.find(',') != quoted.npos && number_in(boost::replace_all_copy(trimmed(quoted), ",", ".")))
      return quoted;
    from = line.find('"', to + 1);
  }
  return "";
}

}  // namespace

std::string Table::place(const std::string& pointer) const {
  std::size_t row = 0;
  const bool is_row = std::sscanf(pointer.c_str(), "/rows/%zu", &row) == 1 && row < line_of_row.size();
  return fmt::format("{}: line {}", path, is_row ? line_of_row[row] : line_of_names);
}

Table read_table(const std::string& path) {
  const auto fail = [&](std::size_t line, const std::string& what) {
    throw InputError(fmt::format("{}: line {}: {}", path, line, what));
  };
  std::string text = read_file(path, kMaxJsonBytes);
  boost::replace_all(text, "\r\n", "\n");
  std::ranges::replace(text, '\r', '\n');  // the line ends of some programs
  if (!is_utf8(text)) throw InputError(path + ": is not a table of text in UTF-8");
  if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);  // byte order mark
  std::istringstream lines(text);
  Table table{{{"columns", Json::array()}, {"rows", Json::array()}}, path, 0, {}};
  std::vector<std::string> names;
  std::size_t number = 0;
  bool has_index = false;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (trimmed(line).empty() || trimmed(line).front() == '#') continue;
    const std::vector<std::string> cells = cells_of(line);
    if (names.empty()) {
      names = cells;
      table.line_of_names = number;
      has_index = names.size() > 1 && (names[0].empty() || names[0] == "Unnamed: 0");
      if (names.size() == 1 && names[0].find_first_of("; \t") != std::string::npos)
        fail(number,
             "the columns are not separated by commas; write commas between names, and numbers such as "
             "0.5,3e4");
      for (std::size_t i = has_index ? 1 : 0; i < names.size(); ++i)
        if (names[i].empty())
          fail(number, fmt::format("column {} has no name: {}", i + 1,
                                   i + 1 < names.size()
                                       ? "give it one, or remove its comma from every line"
                                       : "remove the comma at the end of this line, and of the others"));
      continue;
    }
    if (const std::string text = number_with_comma(line); !text.empty())
      fail(number, fmt::format("{} has a comma; write numbers with a point, such as 0.5, and without quotes",
                               printable(text)));
    if (cells.size() != names.size())
      fail(number,
           fmt::format("has {} cells, and the first line names {} columns{}", cells.size(), names.size(),
                       cells.size() > names.size() ? "; write numbers with a point, such as 0.5" : ""));
    Json row = Json::array();
    for (std::size_t i = has_index ? 1 : 0; i < cells.size(); ++i) {
      if (cells[i].empty())
        fail(number, fmt::format("the cell of {} is empty; give it a value, or remove the row", names[i]));
      row.push_back(cell_value(cells[i]));
    }
    table.content["rows"].push_back(row);
    table.line_of_row.push_back(number);
  }
  if (table.content["rows"].empty())
    throw InputError(
        fmt::format("{}: has no rows; a table needs a line with the names of its columns, such "
                    "as k_r,tau_f, and lines with their values",
                    path));
  if (has_index) names.erase(names.begin());
  for (const std::string& name : names) table.content["columns"].push_back(printable(name));
  return table;
}

}  // namespace bristle::json
