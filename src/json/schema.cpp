#include "json/schema.hpp"

#include "json/mismatches.hpp"
#include "util/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace bristle::json {
namespace {

std::vector<std::string> keys_of(const Json& object) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : object.items()) keys.push_back(key);
  return keys;
}

std::string number_range(const Json& s) {
  std::vector<std::string> limits;
  const auto add = [&](const char* keyword, const char* words) {
    if (s.contains(keyword)) limits.push_back(fmt::format("{} {}", words, s[keyword].dump()));
  };
  add("exclusiveMinimum", "greater than");
  add("minimum", "at least");
  add("exclusiveMaximum", "less than");
  add("maximum", "at most");
  std::string text = s["type"] == "integer" ? "an integer" : "a number";
  return limits.empty() ? text : fmt::format("{} {}", text, fmt::join(limits, " and "));
}

// Returns the key or index in an element of a place, such as "[k_r]".
std::string token_of(const std::string& element) { return element.substr(1, element.size() - 2); }

}  // namespace

const Json& Schema::resolve(const Json& part) const {
  if (!part.contains("$ref")) return part;
  return root_.at(JsonPointer(part["$ref"].get<std::string>().substr(1)));
}

// Returns the part for a member or an element; null if there is none.
const Json& Schema::member(const Json& part, const std::string& token) const {
  static const Json none;
  const Json& here = resolve(part);
  if (here.contains("properties") && here["properties"].contains(token))
    return resolve(here["properties"][token]);
  if (here.contains("anyOf"))
    for (const Json& option : here["anyOf"])
      if (const Json& found = member(option, token); !found.is_null()) return found;
  const bool is_index = token.find_first_not_of("0123456789") == token.npos;
  if (here.contains("items") && is_index) return resolve(here["items"]);
  if (here.contains("additionalProperties") && here["additionalProperties"].is_object())
    return resolve(here["additionalProperties"]);
  return none;
}

std::string Schema::allowed(const Json& part) const {
  const Json& s = resolve(part);
  std::string text;
  if (s.contains("const")) {
    text = s["const"].dump();
  } else if (s.contains("enum")) {
    std::vector<std::string> options;
    for (const Json& option : s["enum"]) options.push_back(option.dump());
    text = fmt::format("{}", fmt::join(options, ", "));
  } else if (s.contains("anyOf")) {
    std::vector<std::string> options;
    for (const Json& option : s["anyOf"]) options.push_back(allowed(option));
    text = fmt::format("{}", fmt::join(options, " or "));
  } else if (s.contains("type")) {
    const std::string type = s["type"];
    if (type == "number" || type == "integer") {
      text = number_range(s);
    } else if (type == "array") {
      const std::size_t least = s.value("minItems", 0), most = s.value("maxItems", 0);
      text = "an array";
      if (most > 0)
        text += least == most ? fmt::format(" of {}", most) : fmt::format(" of {} to {}", least, most);
      else if (least > 0) text += fmt::format(" of at least {}", least);
      if (s.contains("items")) text += ", each " + allowed(s["items"]);
    } else {
      text = (type == "object" ? "an " : "a ") + type;
      if (s.contains("minProperties")) text += " that is not empty";
    }
  }
  if (s.contains("description")) text += fmt::format(" ({})", s["description"].get<std::string>());
  return text;
}

// Throws InputError that explains why the value does not match the part.
void Schema::explain(const Node& node, const Json& part) const {
  const Json& value = node.value();
  if (value.is_object() && part.contains("properties")) {
    const auto known = keys_of(part["properties"]);
    for (const auto& [key, child] : value.items())
      if (!part["properties"].contains(key) && part.value("additionalProperties", Json(true)) == false) {
        const std::string place = elsewhere_ ? elsewhere_(key) : "";
        node[key].fail(
            fmt::format("unknown key{}; allowed: {}",
                        place.empty() ? did_you_mean(key, known) : fmt::format(" (did you mean {}?)", place),
                        fmt::join(known, ", ")));
      }
    if (part.contains("required"))
      for (const std::string key : part["required"])
        if (!value.contains(key))
          node[key].fail(fmt::format("is missing; allowed: {}", allowed(resolve(part["properties"][key]))));
  }
  std::string hint;
  if (value.is_string() && part.contains("enum"))
    hint = did_you_mean(value, part["enum"].get<std::vector<std::string>>());
  if (value.is_number_float() && part.value("type", "") == "integer" &&
      double(value) == std::floor(double(value)) && std::abs(double(value)) < 1e15)
    hint = fmt::format("; write {}", value.get<long>());
  if (value.is_array() && part.value("uniqueItems", false))
    for (auto element = value.begin(); element != value.end(); ++element)
      if (std::find(value.begin(), element, *element) != element)
        hint = fmt::format(": {} appears twice", shown(*element));
  node.fail(fmt::format("{} is not allowed{}; allowed: {}", shown(value), hint, allowed(part)));
}

// Throws InputError for a name that is too long: valijson matches the pattern of a name by std::regex, which
// needs stack for each character, so that a long name would end the program.
void Schema::require_short_name(const Node& name) const {
  const JsonPointer limit("/properties/name/maxLength");
  if (!root_.contains(limit) || !name.exists() || !name.value().is_string()) return;
  const std::size_t most = root_.at(limit), length = name.value().get_ref<const std::string&>().size();
  if (length > most)
    name.fail(fmt::format("{} has {} characters; allowed: at most {}", shown(name.value()), length, most));
}

void Schema::check(const Document& document) const {
  Node node(document, "");
  require_short_name(node["name"]);
  const Mismatches found = mismatches(root_, document.json());
  if (found.empty()) return;
  // The deepest mismatch is the cause; the mismatches above it follow from it.
  const auto& deepest = *std::ranges::max_element(found, {}, &std::vector<std::string>::size);
  const Json* part = &resolve(root_);
  for (std::size_t i = 1; i < deepest.size(); ++i) {
    const std::string token = token_of(deepest[i]);
    part = &member(*part, token);
    node = node.value().is_array() ? node[std::stoul(token)] : node[token];
  }
  explain(node, *part);
}

bool Schema::matches(const Json& part, const Json& value) const { return mismatches(part, value).empty(); }

}  // namespace bristle::json
