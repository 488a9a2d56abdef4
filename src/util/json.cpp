#include "util/json.hpp"

#include "util/error.hpp"
#include "util/file.hpp"

#include <nlohmann/json.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <set>
#include <vector>

namespace bristle {

namespace {

std::string layout(const Json& json, const std::string& indent) {
  const bool objects = json.is_array() && !json.empty() && json[0].is_object();
  if ((!json.is_object() && !objects) || json.empty()) return json.dump();
  std::vector<std::string> entries;
  const std::string inner = indent + " ";
  for (const auto& [key, value] : json.items()) {
    const std::string text = objects ? value.dump() : Json(key).dump() + ": " + layout(value, inner);
    entries.push_back(inner + text);
  }
  return fmt::format("{}\n{}\n{}{}", objects ? "[" : "{", fmt::join(entries, ",\n"), indent,
                     objects ? "]" : "}");
}

}  // namespace

std::string json_lines(const Json& json) { return layout(json, "") + "\n"; }

bool is_utf8(const std::string& text) {
  try {
    Json(text).dump();  // throws for text that is not UTF-8
    return true;
  } catch (const Json::exception&) {
    return false;
  }
}

std::string json_error(const std::string& message) {
  const auto end = message.find("] ");
  return end == std::string::npos ? message : message.substr(end + 2);
}

Json read_json_file(const std::string& path) { return json_object(path, read_file(path, kMaxJsonBytes)); }

Json json_object(const std::string& name, const std::string& text) {
  try {
    Json content = parse_json(text);
    if (!content.is_object())
      throw InputError(fmt::format("expected a JSON object {{...}}, found {}", shown(content)));
    return content;
  } catch (const InputError& e) {
    throw InputError(fmt::format("{}: {}", name, e.what()));
  }
}

Json parse_json(const std::string& text) {
  std::vector<std::set<std::string>> keys;
  const auto watch = [&](int depth, Json::parse_event_t event, Json& parsed) {
    if (depth > kMaxJsonDepth)
      throw InputError(fmt::format("JSON nested more than {} levels deep", kMaxJsonDepth));
    if (event == Json::parse_event_t::object_start) keys.emplace_back();
    if (event == Json::parse_event_t::object_end) keys.pop_back();
    if (event == Json::parse_event_t::key && !keys.back().insert(parsed.get<std::string>()).second)
      throw InputError(fmt::format("the key {} appears twice in one object", shown(parsed)));
    return true;
  };
  try {
    return Json::parse(text, watch);
  } catch (const Json::out_of_range& e) {  // "... overflow parsing '1e400'"
    const std::string message = e.what(), number = message.substr(message.find('\'') + 1);
    throw InputError(
        fmt::format("{} is beyond the largest number, 1.8e308", number.substr(0, number.find('\''))));
  } catch (const Json::exception& e) {
    throw InputError(fmt::format("not JSON: {}", json_error(e.what())));
  }
}

std::string shown(const Json& value) {
  std::string text = value.dump();
  if (text.size() > 60) text = text.substr(0, 57) + "...";
  return text;
}

}  // namespace bristle
