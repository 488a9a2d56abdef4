#include "results/journal.hpp"
#include "util/error.hpp"
#include "util/sha.hpp"

#include <fmt/format.h>
#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace bristle::results {
namespace {

// JSON has no numbers that are not finite.
const std::pair<const char*, double> kNumberWords[] = {
    {"nan", std::numeric_limits<double>::quiet_NaN()}, {"inf", INFINITY}, {"-inf", -INFINITY}};

Json to_json(const std::vector<double>& numbers) {
  Json out = numbers;
  for (std::size_t i = 0; i < numbers.size(); ++i)
    for (const auto& [word, value] : kNumberWords)
      if (value == numbers[i] || (std::isnan(value) && std::isnan(numbers[i]))) out[i] = word;
  return out;
}

double number_of(const Json& json) {
  if (json.is_number()) return json;
  for (const auto& [word, value] : kNumberWords)
    if (json == word) return value;
  throw MalformedError("neither a number nor a word for one");
}

std::vector<double> numbers_of(const Json& list) {
  if (!list.is_array()) throw MalformedError("not a list of numbers");
  std::vector<double> out;
  out.reserve(list.size());
  for (const Json& number : list) out.push_back(number_of(number));
  return out;
}

// The JSON of a line without its digest. None if it is truncated or damaged.
std::optional<std::string_view> intact(std::string_view line) {
  if (line.size() <= kDigestLength || line[kDigestLength] != ' ') return {};
  const std::string_view text = line.substr(kDigestLength + 1);
  if (sha256_of(text) != line.substr(0, kDigestLength)) return {};
  return text;
}

std::optional<JournalLine> line_of(const Json& json) {
  if (json.at("schema") != kJournalSchema) return {};
  try {
    JournalLine line{json.at("key"), json.at("commit"), json.at("host"), {}};
    for (const auto& [name, numbers] : json.at("values").items())
      line.record.values.emplace_hint(line.record.values.end(), name, numbers_of(numbers));
    for (const auto& [name, columns] : json.at("tables").items())
      for (Rows& rows = line.record.tables[name]; const Json& column : columns)
        rows.push_back(numbers_of(column));
    line.record.failure = json.value("failure", "");
    return line;
  } catch (const Json::exception&) {
    return {};
  } catch (const MalformedError&) {
    return {};
  }
}

// Reads the JSON that encode() writes, some ten times as fast as a parser of all JSON. Each function returns
// false for any other text.
class LineReader {
 public:
  explicit LineReader(std::string_view text) : rest_(text) {}

  bool start(JournalLine& line) {
    return literal(R"({"schema":")") && literal(kJournalSchema) && literal(R"(","key":)") && word(line.key) &&
           literal(R"(,"commit":)") && word(line.commit) && literal(R"(,"host":)") && word(line.host);
  }
  bool line(JournalLine& out) {
    const auto numbers = [&](std::vector<double>& list) { return this->numbers(list); };
    const auto columns = [&](Rows& rows) {
      return list('[', ']', [&] { return this->numbers(rows.emplace_back()); });
    };
    return start(out) && literal(R"(,"values":)") && members(out.record.values, numbers) &&
           literal(R"(,"tables":)") && members(out.record.tables, columns) && rest_ == "}";
  }

 private:
  bool literal(std::string_view text) {
    if (!rest_.starts_with(text)) return false;
    rest_.remove_prefix(text.size());
    return true;
  }
  // A text without escapes.
  bool word(std::string& out) {
    if (!literal("\"")) return false;
    const std::size_t end = rest_.find_first_of("\"\\");
    if (end == rest_.npos || rest_[end] == '\\') return false;
    out = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    return true;
  }
  bool number(double& out) {
    for (const auto& [word, value] : kNumberWords)
      if (rest_.starts_with('"') && rest_.substr(1).starts_with(word)) {
        out = value;
        rest_.remove_prefix(1 + std::string_view(word).size());
        return literal("\"");
      }
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), out);
    if (error != std::errc() || !std::isfinite(out)) return false;
    rest_.remove_prefix(std::size_t(end - rest_.data()));
    return true;
  }
  template <class Element>
  bool list(char open, char close, Element element) {
    if (!rest_.starts_with(open)) return false;
    rest_.remove_prefix(1);
    for (bool first = true; !rest_.starts_with(close); first = false)
      if (!(first || literal(",")) || !element()) return false;
    rest_.remove_prefix(1);
    return true;
  }
  bool numbers(std::vector<double>& out) {
    return list('[', ']', [&] { return number(out.emplace_back()); });
  }
  template <class Map, class Value>
  bool members(Map& out, Value value) {
    std::string name;
    return list('{', '}', [&] {
      return word(name) && literal(":") && value(out.try_emplace(out.end(), name)->second);
    });
  }

  std::string_view rest_;
};

}  // namespace

std::string encode(const JournalLine& line) {
  Json values = Json::object(), tables = Json::object();
  for (const auto& [name, numbers] : line.record.values) values[name] = to_json(numbers);
  for (const auto& [name, columns] : line.record.tables)
    for (Json& table = tables[name] = Json::array(); const auto& column : columns)
      table.push_back(to_json(column));
  Json json = {{"schema", kJournalSchema}, {"key", line.key}, {"commit", line.commit}, {"host", line.host}};
  json["values"] = std::move(values);
  json["tables"] = std::move(tables);
  if (!line.record.failure.empty()) json["failure"] = line.record.failure;
  const std::string text = json.dump();
  return fmt::format("{} {}\n", sha256_of(text), text);
}

std::optional<JournalLine> decode(std::string_view line) {
  const auto text = intact(line);
  if (!text) return {};
  if (JournalLine out; LineReader(*text).line(out)) return out;
  const Json json = Json::parse(*text, nullptr, false);
  if (!json.is_object() || !json.value("schema", Json()).is_string()) return {};
  return line_of(json);
}

std::optional<JournalStart> decode_start(std::string_view line) {
  const auto text = intact(line);
  if (!text) return {};
  if (JournalLine out; LineReader(*text).start(out)) return JournalStart{kJournalSchema, out.key, out.commit};
  const Json json = Json::parse(*text, nullptr, false);
  if (!json.is_object() || !json.value("schema", Json()).is_string()) return {};
  JournalStart out{json["schema"], "", ""};
  if (const auto whole = line_of(json)) out = {out.schema, whole->key, whole->commit};
  return out;
}

}  // namespace bristle::results
