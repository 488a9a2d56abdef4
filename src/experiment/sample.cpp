#include "experiment/sample.hpp"

#include "experiment/schema.hpp"
#include "bristle/model/elementary.hpp"
#include "util/error.hpp"
#include "util/file.hpp"
#include "util/sensitivity.hpp"
#include "util/sobol.hpp"
#include "util/text.hpp"

#include <boost/algorithm/string/replace.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numeric>
#include <sstream>

namespace bristle::experiment {
namespace {

// The number that the text states, or else the text itself, also if that is nan or inf, or beyond the
// largest.
Json cell_value(const std::string& text) {
  const auto number = number_in(text);
  return number && std::isfinite(*number) ? Json(*number) : Json(text);
}

bool is_beyond_the_largest(const Json& value) {
  if (!value.is_string() || value.get<std::string>().find_first_of("0123456789") == std::string::npos)
    return false;
  const auto number = number_in(value);
  return number && std::isinf(*number);
}

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r\""), last = text.find_last_not_of(" \t\r\"");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

// The cells of a line of comma-separated values. Numbers and words contain no commas.
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  for (const char c : line)
    if (c == ',') cells.emplace_back();
    else cells.back() += c;
  for (std::string& cell : cells) cell = trimmed(cell);
  return cells;
}

}  // namespace

Json read_table(const std::string& path) {
  const auto fail = [&](std::size_t line, const std::string& what) {
    throw InputError(fmt::format("{}: line {}: {}", path, line, what));
  };
  std::string text = read_file(path, kMaxJsonBytes);
  boost::replace_all(text, "\r\n", "\n");
  std::ranges::replace(text, '\r', '\n');  // the line ends of some programs
  if (!is_utf8(text)) throw InputError(path + ": is not a table of text in UTF-8");
  if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);  // byte order mark
  std::istringstream lines(text);
  Json table = {{"columns", Json::array()}, {"rows", Json::array()}};
  std::vector<std::string> names;
  std::vector<std::size_t> line_of_row;
  std::size_t number = 0, first_line = 0;
  bool has_index = false;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (trimmed(line).empty() || trimmed(line).front() == '#') continue;
    const std::vector<std::string> cells = cells_of(line);
    if (names.empty()) {
      names = cells;
      first_line = number;
      has_index = names.size() > 1 && (names[0].empty() || names[0] == "Unnamed: 0");
      if (names.size() == 1 && names[0].find_first_of("; \t") != std::string::npos)
        fail(number, "the columns are not separated by commas; write k_r,tau_f and numbers such as 0.5,3e4");
      continue;
    }
    if (cells.size() != names.size())
      fail(number,
           fmt::format("has {} cells, and the first line names {} columns", cells.size(), names.size()));
    Json row = Json::array();
    for (std::size_t i = has_index ? 1 : 0; i < cells.size(); ++i) {
      if (cells[i].empty())
        fail(number, fmt::format("the cell of {} is empty; give it a value, or remove the row", names[i]));
      row.push_back(cell_value(cells[i]));
    }
    table["rows"].push_back(row);
    line_of_row.push_back(number);
  }
  if (table["rows"].empty())
    throw InputError(
        fmt::format("{}: has no rows; a table needs a line with the names of its columns, such "
                    "as k_r,tau_f, and one line for each point",
                    path));
  if (has_index) names.erase(names.begin());
  for (const std::string& name : names) table["columns"].push_back(printable(name));
  // The values are checked here, where their lines are known.
  const auto place_of = [&](const std::string& pointer) {
    std::size_t row = 0;
    const bool is_row = std::sscanf(pointer.c_str(), "/sweep/sample/table/rows/%zu", &row) == 1;
    return fmt::format("{}: line {}", path, is_row ? line_of_row[row] : first_line);
  };
  read_sample(Document::with_places({{"sweep", {{kSample, {{"table", table}}}}}}, place_of));
  return table;
}

namespace {

double ratio(double r, const double (&a)[8], const double (&b)[8]) {
  double numerator = 0, denominator = 0;
  for (int i = 7; i >= 0; --i) {
    numerator = numerator * r + a[i];
    denominator = denominator * r + b[i];
  }
  return numerator / denominator;
}

class SampleReader {
 public:
  explicit SampleReader(const Document& document)
      : document_(document), at_("/sweep/sample"), json_(document.json().at(at_)) {}

  Axis read() const {
    if (json_.contains("table") == json_.contains("sobol"))
      fail(at_, fmt::format("needs exactly one of table and sobol; {} given",
                            json_.contains("table") ? "both are" : "neither is"));
    for (const char* key : {"seed", "over"})
      if (json_.contains("table") == json_.contains(key))
        fail(at_ / key, json_.contains("table") ? "is allowed with sobol only"
                                                : "is missing; a sample by sobol needs it");
    if (!json_.contains("table") && json_.contains("take"))
      fail(at_ / "take", "is allowed with table only; a smaller number for sobol takes the first points");
    Axis axis{kSample, {}, json_.contains("table") ? table() : distributions()};
    axis.values.resize(axis.columns.front().values.size());
    std::iota(axis.values.begin(), axis.values.end(), 0.0);
    return axis;
  }

 private:
  [[noreturn]] void fail(const JsonPointer& at, const std::string& what) const {
    document_.fail(at.to_string(), what);
  }

  // The number or the index of the word. at(): the pointer, which is made for messages only.
  template <class At>
  double value_of(At at, const Sweepable& sweepable, const Json& value) const {
    if (!sweepable.options.empty()) {
      const auto& options = sweepable.options;
      const auto found =
          std::ranges::find(options, value.is_string() ? value.get_ref<const std::string&>() : "");
      return found == options.end() ? option_index(document_, at(), sweepable, value)
                                    : double(found - options.begin());
    }
    if (is_beyond_the_largest(value))
      fail(at(), fmt::format("{} is beyond the largest number, 1.8e308", value.get<std::string>()));
    if (!value.is_number() || !std::isfinite(value.get<double>()))
      fail(at(), fmt::format("{} is not a number, which {} needs", shown(value), sweepable.name));
    return value;
  }

  std::vector<std::size_t> taken_rows(std::size_t rows) const {
    std::vector<std::size_t> taken(rows);
    std::iota(taken.begin(), taken.end(), 0);
    if (!json_.contains("take")) return taken;
    taken = json_["take"].get<std::vector<std::size_t>>();
    for (std::size_t i = 0; i < taken.size(); ++i)
      if (taken[i] >= rows || (i > 0 && taken[i] <= taken[i - 1]))
        fail(at_ / "take",
             fmt::format("{} is not allowed; allowed: ascending indices from 0 to {}", taken[i], rows - 1));
    return taken;
  }

  std::vector<Axis> table() const {
    const Json& rows = json_["table"]["rows"];
    const JsonPointer at = at_ / "table";
    const std::vector<std::size_t> taken = taken_rows(rows.size());
    std::vector<Axis> columns;
    for (const std::string name : json_["table"]["columns"]) {
      const auto column = columns.size();
      const JsonPointer place = at / "columns" / column;
      const Sweepable& sweepable = require_sweepable(document_, place, name);
      if (varies(columns, name)) fail(at / "columns" / column, name + " appears twice");
      columns.push_back({name, {}, {}});
      for (const std::size_t i : taken) {
        if (column >= rows[i].size())
          fail(at / "rows" / i, fmt::format("has {} values, and the table has {} columns", rows[i].size(),
                                            json_["table"]["columns"].size()));
        const auto cell = [&] { return at / "rows" / i / column; };
        columns.back().values.push_back(value_of(cell, sweepable, rows[i][column]));
      }
      check_values(document_, name, columns.back().values,
                   [&](std::size_t i) { return at / "rows" / taken[i] / column; });
    }
    return columns;
  }

  std::vector<Axis> distributions() const {
    const Json& over = json_["over"];
    const std::size_t count = json_["sobol"];
    const JsonPointer indices("/analysis/sobol_indices");
    const bool design = document_.json().contains(indices) && !document_.json().at(indices).empty();
    const auto points = design ? saltelli_design(count, over.size(), json_["seed"])
                               : sobol_points(count, over.size(), json_["seed"]);
    std::vector<Axis> columns;
    for (const auto& [name, distribution] : over.items()) {
      const JsonPointer at = at_ / "over" / name;
      const auto quantile = quantile_of(at, require_sweepable(document_, at, name), distribution);
      Axis column{name, {}, {}};
      for (const auto& point : points) column.values.push_back(quantile(point[columns.size()]));
      check_values(document_, name, column.values, [&](std::size_t) { return JsonPointer(at); });
      columns.push_back(std::move(column));
    }
    return columns;
  }

  // The value below which this share of the distribution lies.
  std::function<double(double)> quantile_of(const JsonPointer& at, const Sweepable& sweepable,
                                            const Json& distribution) const {
    if (distribution.size() != 1)
      fail(at, fmt::format("{} gives {} distributions; one is needed: uniform, log, normal or values",
                           shown(distribution), distribution.size()));
    const std::string kind = distribution.begin().key();
    const Json& given = distribution.front();
    std::vector<double> values;
    if (kind == "values") {
      for (const Json& value : given) values.push_back(value_of([&] { return at / kind; }, sweepable, value));
      return [values](double share) { return values[std::size_t(share * double(values.size()))]; };
    }
    if (!sweepable.options.empty())
      fail(at / kind, fmt::format("{} is a choice; it needs \"values\", a list of words; allowed: {}",
                                  sweepable.name, fmt::join(sweepable.options, ", ")));
    const double first = given[0], second = given[1];
    if (kind == "normal") {
      if (!(second > 0)) fail(at / kind, fmt::format("the standard deviation {} is not positive", second));
      require_distinct(document_, at / kind, first - second, first + second, json_["sobol"]);
      return [first, second](double share) { return rounded(first + second * normal_quantile(share)); };
    }
    if (!(first < second))
      fail(at / kind, fmt::format("{} is not below {}; {}", first, second,
                                  first == second ? "give a range" : "swap them"));
    require_distinct(document_, at / kind, first, second, json_["sobol"]);
    if (kind == "uniform")
      return [first, second](double share) { return rounded(first + (second - first) * share); };
    if (!(first > 0))
      fail(at / kind,
           fmt::format("a logarithmic distribution cannot begin at {}; allowed: greater than 0", first));
    return [first, second](double share) { return rounded(first * pow(second / first, share)); };
  }

  const Document& document_;
  const JsonPointer at_;
  const Json& json_;
};

}  // namespace

double rounded(double value) { return *number_in(fmt::format("{:.7g}", value)); }

// M. J. Wichura, algorithm AS 241, Appl. Statist. 37, 1988. Boost.Math calls functions of the C library,
// whose last bits differ between machines.
double normal_quantile(double share) {
  static const double a[] = {3.3871328727963666080e0, 1.3314166789178437745e2, 1.9715909503065514427e3,
                             1.3731693765509461125e4, 4.5921953931549871457e4, 6.7265770927008700853e4,
                             3.3430575583588128105e4, 2.5090809287301226727e3},
                      b[] = {1.0,
                             4.2313330701600911252e1,
                             6.8718700749205790830e2,
                             5.3941960214247511077e3,
                             2.1213794301586595867e4,
                             3.9307895800092710610e4,
                             2.8729085735721942674e4,
                             5.2264952788528545610e3},
                      c[] = {1.42343711074968357734e0,  4.63033784615654529590e0, 5.76949722146069140550e0,
                             3.64784832476320460504e0,  1.27045825245236838258e0, 2.41780725177450611770e-1,
                             2.27238449892691845833e-2, 7.74545014278341407640e-4},
                      d[] = {1.0,
                             2.05319162663775882187e0,
                             1.67638483018380384940e0,
                             6.89767334985100004550e-1,
                             1.48103976427480074590e-1,
                             1.51986665636164571966e-2,
                             5.47593808499534494600e-4,
                             1.05075007164441684324e-9};
  const double from_middle = share - 0.5;
  if (std::abs(from_middle) <= 0.425) return from_middle * ratio(0.180625 - from_middle * from_middle, a, b);
  const double size = ratio(sqrt(-log(from_middle < 0 ? share : 1 - share)) - 1.6, c, d);
  return from_middle < 0 ? -size : size;
}

Axis read_sample(const Document& document) { return SampleReader(document).read(); }

void check_finite(const Document& document, const std::string& name, const std::vector<double>& values,
                  const std::function<JsonPointer(std::size_t)>& at) {
  if (const auto wrong = std::ranges::find_if_not(values, [](double v) { return std::isfinite(v); });
      wrong != values.end())
    document.fail(
        at(std::size_t(wrong - values.begin())).to_string(),
        fmt::format("the values of {}, or the width or ratio of their range, are beyond the largest "
                    "number, 1.8e308; give a narrower range",
                    name));
}

void check_values(const Document& document, const std::string& name, const std::vector<double>& values,
                  const std::function<JsonPointer(std::size_t)>& at) {
  if (!find_sweepable(name)->options.empty()) return;  // option_index() has found the words
  check_finite(document, name, values, at);
  const auto check = [&](auto value) {
    if (value != values.end())
      check_parameter(document, at(std::size_t(value - values.begin())), name, *value);
  };
  check(std::ranges::min_element(values));
  check(std::ranges::max_element(values));
  check(std::ranges::find_if(values, [](double v) { return v != std::floor(v); }));
}

void require_distinct(const Document& document, const JsonPointer& at, double low, double high,
                      std::size_t count) {
  const double size = std::max(std::abs(low), std::abs(high));
  double digit = 1e-6;  // the seventh
  for (double rest = size; rest >= 10; rest /= 10) digit *= 10;
  for (double rest = size; rest < 1 && rest > 0; rest *= 10) digit /= 10;
  const double values = std::floor((high - low) / digit * (1 + 1e-9)) + 1;
  if (values >= double(count)) return;
  document.fail(at.to_string(),
                fmt::format("the range from {} to {} has {} value{} of seven digits, to which values are "
                            "rounded, for {} points; give a wider one",
                            low, high, values, values == 1 ? "" : "s", count));
}

double option_index(const Document& document, const JsonPointer& at, const Sweepable& choice,
                    const Json& word) {
  const auto& options = choice.options;
  const std::string text = word.is_string() ? word.get<std::string>() : shown(word);
  const auto found = std::ranges::find(options, text);
  if (found == options.end())
    document.fail(at.to_string(), fmt::format("{} is not known{}; allowed: {}", shown(word),
                                              did_you_mean(text, options), fmt::join(options, ", ")));
  return double(found - options.begin());
}

const Sweepable& require_sweepable(const Document& document, const JsonPointer& at, const std::string& name) {
  if (const Sweepable* sweepable = find_sweepable(name)) return *sweepable;
  std::vector<std::string> known;
  for (const Sweepable& s : sweepables()) known.push_back(s.name);
  document.fail(at.to_string(), fmt::format("{} cannot be swept{}; allowed: {}", name,
                                            did_you_mean(name, known), fmt::join(known, ", ")));
}

}  // namespace bristle::experiment
