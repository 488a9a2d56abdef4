#include "compare/reference.hpp"

#include "json/document.hpp"
#include "json/schema.hpp"
#include "util/error.hpp"
#include "util/file.hpp"
#include "util/text.hpp"

#include <fmt/format.h>
#include <cmath>

// Reads and writes references as files.
namespace bristle::compare {

const char* reference_schema();  // the text of reference.schema.json, embedded by the build

namespace {

using results::Array;
using results::Number;

// Returns the length of the rows, which are along the last axis.
std::size_t row_length(const Reference& reference) {
  const auto shape = reference.numbers.shape();
  return shape.empty() ? 1 : shape.back();
}

// Returns numbers by rows; a row ends after its last value. values: tell which numbers have a value; empty if
// all have one
template <class T>
Json rows_of(const std::vector<T>& numbers, std::size_t length, const std::vector<double>& values) {
  Json out = Json::array();
  for (std::size_t first = 0; first < numbers.size(); first += length) {
    std::size_t end = first + length;
    while (end > first && !values.empty() && std::isnan(values[end - 1])) --end;
    out.push_back(std::vector<T>(numbers.begin() + long(first), numbers.begin() + long(end)));
  }
  return out;
}

// Returns one number if the tolerance is the same at all points that have a value, otherwise rows.
Json tolerance_json(const std::vector<double>& tolerance, std::size_t length,
                    const std::vector<double>& values) {
  std::optional<double> same;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isnan(values[i]) && tolerance[i] != same.value_or(tolerance[i]))
      return rows_of(tolerance, length, values);
    else if (!std::isnan(values[i])) same = tolerance[i];
  return same.value_or(0);
}

// Returns the words of a choice, or numbers.
Json coordinates_json(const Array& array) {
  if (array.about.words.empty()) return array.values;
  Json out = Json::array();
  for (const double code : array.values) out.push_back(array.text(code));
  return out;
}

// Returns an array over a dimension of this name. Words become codes in the order in which they occur.
Array coordinates_of(const json::Document& document, const JsonPointer& at, const std::string& name) {
  const Json& json = document.json().at(at);
  Array out = results::coordinates({name, "", "", ""}, {});
  for (std::size_t i = 0; i < json.size(); ++i) {
    if (json[i].is_string() != json[0].is_string())
      document.fail((at / i).to_string(), "words and numbers on one axis");
    out.values.push_back(json[i].is_string() ? double(i) : json[i].get<double>());
    if (json[i].is_string()) out.about.words.push_back(json[i]);
  }
  if (!out.about.words.empty()) out.about.number = Number::code;
  out.shape = {out.values.size()};
  return out;
}

// Reads the numbers of a reference's flags and variables.
class NumbersReader {
 public:
  NumbersReader(const json::Document& document, const std::map<std::string, NumberRows>& rows,
                Reference& reference)
      : document_(document),
        rows_(rows),
        reference_(reference),
        length_(row_length(reference)),
        count_(reference.numbers.size() / length_) {}

  void read_flags(const std::string& name) {
    const std::vector<std::size_t> whole(count_, length_);
    std::vector<double> codes = read(JsonPointer("/flags") / name, false, whole);
    reference_.numbers.add(
        Array{.about = {.name = name, .number = Number::code}, .values = std::move(codes)});
  }

  void read_variable(const std::string& name) {
    const JsonPointer at = JsonPointer("/variables") / name;
    const std::vector<std::size_t> whole(count_, length_);
    std::vector<double> values = read(at / "values", true, whole);
    const Json& tolerance = document_.json().at(at / "tolerance");
    reference_.tolerances[name] = tolerance.is_array()
                                      ? read(at / "tolerance", false, lengths_of(at / "values"))
                                      : std::vector<double>(values.size(), tolerance.get<double>());
    reference_.numbers.add(Array{.about = {.name = name}, .values = std::move(values)});
  }

 private:
  const NumberRows& rows_at(const JsonPointer& at) const {
    static const NumberRows none;
    const auto found = rows_.find(at.to_string());
    return found == rows_.end() ? none : found->second;
  }

  std::vector<std::size_t> lengths_of(const JsonPointer& at) const {
    std::vector<std::size_t> out;
    std::size_t before = 0;
    for (const std::size_t end : rows_at(at).ends) {
      out.push_back(end - before);
      before = end;
    }
    return out;
  }

  // Returns the numbers of all points, NaN behind the end of a row. wanted: number of values in each row, or
  // the greatest number if may_end is set
  std::vector<double> read(const JsonPointer& at, bool may_end,
                           const std::vector<std::size_t>& wanted) const {
    const std::vector<std::size_t> lengths = lengths_of(at);
    if (lengths.size() != count_)
      document_.fail(at.to_string(), fmt::format("{} rows, but the axes have {}", lengths.size(), count_));
    std::vector<double> out;
    out.reserve(count_ * length_);
    const double* next = rows_at(at).values.data();
    for (std::size_t row = 0; row < count_; ++row) {
      const std::size_t length = lengths[row];
      if (length > wanted[row] || (length < wanted[row] && !may_end))
        document_.fail((at / row).to_string(),
                       fmt::format("{} numbers, but there are {} points with a value", length, wanted[row]));
      out.insert(out.end(), next, next + length);
      out.resize((row + 1) * length_, NAN);
      next += length;
    }
    return out;
  }

  const json::Document& document_;
  const std::map<std::string, NumberRows>& rows_;
  Reference& reference_;
  const std::size_t length_, count_;
};

// Returns whether the schema allows these rows: integers for flags, no negative tolerances, and null for
// values only.
bool is_allowed(const std::string& at, const NumberRows& rows) {
  const auto all = [&](auto allowed) { return std::ranges::all_of(rows.values, allowed); };
  if (!rows.plain) return false;
  if (at.starts_with("/flags/")) return all([](double x) { return x == std::floor(x); });
  if (at.starts_with("/variables/") && at.ends_with("/tolerance"))
    return all([](double x) { return x >= 0; });
  return at.starts_with("/variables/") && at.ends_with("/values");
}

json::Document checked_document(const std::string& text, const std::string& path,
                                std::map<std::string, NumberRows>& rows) {
  const auto checked = [&](const Json& json) {
    const auto document = json::Document::stored(json, path);
    json::Schema(parse_json(reference_schema())).check(document);
    return document;
  };
  Json json;
  try {
    json = parse_json(text, rows);
  } catch (const InputError& e) {
    throw InputError(fmt::format("{}: {}", path, e.what()));
  }
  // The schema needs the document with all numbers to name the place of a mistake in the rows.
  bool allowed = json.is_object();
  for (const auto& [at, found] : rows) allowed = allowed && is_allowed(at, found);
  if (!allowed) checked(json_object(path, text));
  return checked(json);
}

}  // namespace

std::string Reference::text(const std::string& name) const { return about.at(name).get<std::string>(); }

std::string file_text(const Reference& reference) {
  Json out = reference.about;
  const std::size_t length = row_length(reference);
  for (const char* member : {"axes", "flags", "variables"}) {
    out[member] = Json::object();
    // NOTE: a growing Json object copies its members, as their keys are constant.
    out[member].get_ref<Json::object_t&>().reserve(reference.numbers.arrays().size());
  }
  for (const Array& axis : reference.numbers.dimensions())
    out["axes"][axis.about.name] = coordinates_json(axis);
  for (const auto& [about, dimensions, shape, values, coordinate] : reference.numbers.arrays())
    if (about.number == Number::code)
      out["flags"][about.name] = rows_of(std::vector<long>(values.begin(), values.end()), length, {});
    else
      out["variables"][about.name] = {
          {"values", rows_of(values, length, values)},
          {"tolerance", tolerance_json(reference.tolerances.at(about.name), length, values)}};
  if (reference.sample)
    for (const Array& column : *reference.sample) out["sample"][column.about.name] = coordinates_json(column);
  return json_lines(out);
}

Reference parse_reference(const std::string& text, const std::string& path) {
  std::map<std::string, NumberRows> rows;
  const auto document = checked_document(text, path, rows);
  Reference out;
  out.about = document.json();
  for (const auto& [name, axis] : document.json()["axes"].items())
    out.numbers.add_dimension(coordinates_of(document, JsonPointer("/axes") / name, name));
  if (document.json().contains("sample")) {
    const JsonPointer sample = JsonPointer("/axes") / sweep::kSample;
    const std::size_t points = document.json().contains(sample) ? document.json().at(sample).size() : 0;
    out.sample.emplace();
    for (const auto& [name, column] : document.json()["sample"].items()) {
      if (column.size() != points)
        document.fail("/sample/" + name,
                      fmt::format("{} values, but the sample has {} rows", column.size(), points));
      out.sample->push_back(coordinates_of(document, JsonPointer("/sample") / name, name));
    }
  }
  NumbersReader numbers(document, rows, out);
  for (const auto& [name, flags] : document.json()["flags"].items()) numbers.read_flags(name);
  for (const auto& [name, variable] : document.json()["variables"].items()) numbers.read_variable(name);
  for (const char* member : {"axes", "sample", "flags", "variables"}) out.about.erase(member);
  return out;
}

Reference read_reference(const std::string& path) {
  try {
    return parse_reference(read_file(path, kMaxJsonBytes), path);
  } catch (const InputError& e) {
    throw InputError(
        fmt::format("{}; restore the reference with `git checkout -- {}`, or remove it and write it again "
                    "with `bristle reference update`",
                    e.what(), shell_quoted(path)));
  }
}

}  // namespace bristle::compare
