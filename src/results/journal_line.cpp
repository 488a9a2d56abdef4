#include "results/journal_line.hpp"

#include "util/json.hpp"
#include "util/sha.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace bristle::results {
namespace {

constexpr std::size_t kDigestLength = 64;

Json encoded(const std::vector<double>& numbers) {
  Json out = Json::array();
  for (const double x : numbers) {
    if (std::isfinite(x)) out.push_back(x);
    else out.push_back(std::isnan(x) ? "nan" : x > 0 ? "inf" : "-inf");
  }
  return out;
}

std::vector<double> decoded(const Json& json) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::vector<double> out;
  for (const Json& x : json) {
    if (!x.is_string()) out.push_back(x.get<double>());
    else if (x == "nan") out.push_back(std::numeric_limits<double>::quiet_NaN());
    else out.push_back(x == "inf" ? infinity : -infinity);
  }
  return out;
}

// The JSON of a line. None if the checksum does not match.
std::optional<std::string_view> checked(std::string_view line) {
  if (line.size() <= kDigestLength || line[kDigestLength] != ' ') return {};
  const std::string_view json = line.substr(kDigestLength + 1);
  if (sha256_of(std::string(json)) != line.substr(0, kDigestLength)) return {};
  return json;
}

// Removes prefix and the word after it, up to the next quote, from text. Returns the word.
std::optional<std::string> take_word(std::string_view& text, const std::string& prefix) {
  if (!text.starts_with(prefix)) return {};
  text.remove_prefix(prefix.size());
  const auto end = std::min(text.find('"'), text.size());
  std::string word(text.substr(0, end));
  text.remove_prefix(end);
  return word;
}

}  // namespace

std::string encode(const JournalLine& line) {
  Json json = {{"schema", kJournalSchema}, {"key", line.key}, {"commit", line.commit}};
  json["values"] = Json::object();
  for (const auto& [name, numbers] : line.record.values) json["values"][name] = encoded(numbers);
  json["tables"] = Json::object();
  for (const auto& [name, rows] : line.record.tables) {
    Json& columns = json["tables"][name] = Json::array();
    for (const auto& column : rows) columns.push_back(encoded(column));
  }
  if (!line.record.failure.empty()) json["failure"] = line.record.failure;
  const std::string text = json.dump();
  return sha256_of(text) + " " + text + "\n";
}

std::optional<JournalLine> decode(std::string_view line) {
  const auto text = checked(line);
  if (!text) return {};
  try {
    const Json json = Json::parse(*text);
    if (json.at("schema") != kJournalSchema) return {};
    JournalLine out{json.at("key"), json.at("commit"), {}};
    for (const auto& [name, numbers] : json.at("values").items()) out.record.values[name] = decoded(numbers);
    for (const auto& [name, rows] : json.at("tables").items()) {
      Rows& columns = out.record.tables[name];
      for (const Json& column : rows) columns.push_back(decoded(column));
    }
    out.record.failure = json.value("failure", "");
    return out;
  } catch (const Json::exception&) {
    return {};  // written by a program with another record format
  }
}

std::optional<JournalLine> head_of(std::string_view line) {
  const auto text = checked(line);
  if (!text) return {};
  // Relies on the order of keys of encode(), so that the numbers need not be parsed.
  std::string_view rest = *text;
  const auto schema = take_word(rest, R"({"schema":")"), key = take_word(rest, R"(","key":")"),
             commit = take_word(rest, R"(","commit":")");
  if (!commit || *schema != kJournalSchema) return {};
  return JournalLine{*key, *commit, {}};
}

std::optional<std::string> schema_of(std::string_view line) {
  auto text = checked(line);
  return text ? take_word(*text, R"({"schema":")") : std::nullopt;
}

}  // namespace bristle::results
