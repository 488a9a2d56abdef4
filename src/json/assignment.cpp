#include "json/assignment.hpp"

#include "util/error.hpp"
#include "util/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cctype>
#include <cstring>
#include <nlohmann/json.hpp>

namespace bristle::json {
namespace {

// Returns the element of an array for a token of a JSON pointer; "-" appends one. Throws InputError.
Json& element(Json& array, const std::string& token, const std::string& change) {
  if (token == "-") return array.emplace_back();
  const bool number =
      !token.empty() && token.size() < 10 && token.find_first_not_of("0123456789") == token.npos;
  if (!number || std::stoul(token) >= array.size())
    throw InputError(
        fmt::format("{}: \"{}\" is not an element of the array {}; allowed: 0 to {}, or - to append", change,
                    token, shown(array), std::ptrdiff_t(array.size()) - 1));
  return array[std::stoul(token)];
}

void remove_key(Json& object, const std::string& key, const std::string& change) {
  std::vector<std::string> keys;
  for (const auto& [name, value] : object.items()) keys.push_back(name);
  if (!object.contains(key))
    throw InputError(fmt::format("{}: there is no key {} to remove{}; here: {}", change, key,
                                 did_you_mean(key, keys), fmt::join(keys, ", ")));
  object.erase(key);
}

}  // namespace

std::vector<std::string> tokens_of(JsonPointer pointer) {
  std::vector<std::string> tokens;
  for (; !pointer.empty(); pointer.pop_back()) tokens.insert(tokens.begin(), pointer.back());
  return tokens;
}

Assignment parse_assignment(const std::string& argument) {
  const auto equals = argument.find('=');
  const auto fail = [&](const std::string& why) {
    throw InputError(fmt::format("--set {}: {}; write --set /model/k_r=20", argument, why));
  };
  if (equals == std::string::npos) fail("'=' is missing");
  const std::string text = argument.substr(equals + 1);
  if (equals > 0 && argument.front() != '/') fail("a place in an experiment begins with /");
  if (std::count(argument.begin(), argument.begin() + long(equals), '/') > kMaxJsonDepth)
    fail(fmt::format("the JSON pointer is more than {} levels deep", kMaxJsonDepth));
  Json value;
  try {
    const bool json_intended =
        std::isdigit(static_cast<unsigned char>(text[0])) || std::strchr("-[{\"", text[0]);
    value = Json::accept(text) || (json_intended && !text.empty()) ? parse_json(text) : Json(text);
    value.dump();  // throws for text that is not UTF-8
  } catch (const InputError& e) {
    if (const auto letters = text.find_first_not_of("0123456789.eE+-");
        letters != text.npos && std::isalpha(static_cast<unsigned char>(text[letters])))
      fail(fmt::format("'{}' is neither a number (the unit is part of the key) nor text in quotes",
                       text.substr(0, 60)));
    fail(fmt::format("'{}': {}", text.substr(0, 60), e.what()));
  } catch (const Json::exception& e) {
    fail(json_error(e.what()));
  }
  try {
    const JsonPointer pointer(argument.substr(0, equals));
    if (pointer.empty()) fail("the JSON pointer is empty");
    if (argument.starts_with("/tiers"))
      fail("would have no effect, because the tier has been applied; set the value itself");
    return {"--set " + argument, tokens_of(pointer), std::make_shared<const Json>(std::move(value))};
  } catch (const Json::exception& e) {
    fail(json_error(e.what()));
  }
  return {"", {}, nullptr};  // not reached: fail() throws
}

void apply(Json& document, const Assignment& change) {
  const std::vector<std::string>& tokens = change.tokens;
  Json* at = &document;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    const std::string& token = tokens[i];
    if (at->is_array()) {
      at = &element(*at, token, change.name);
    } else if (at->is_object() || at->is_null()) {
      if (i + 1 == tokens.size() && change.value->is_null()) {
        remove_key(*at, token, change.name);
        return;
      }
      at = &(*at)[token];
    } else {
      throw InputError(fmt::format("{}: \"{}\" does not exist, because what should contain it is {}",
                                   change.name, token, shown(*at)));
    }
  }
  if (change.value->is_object() && at->is_object()) at->merge_patch(*change.value);
  else *at = *change.value;
}

bool Assignment::sets(const JsonPointer& pointer) const {
  const std::vector<std::string> asked = tokens_of(pointer);
  const std::size_t common = std::min(tokens.size(), asked.size());
  if (!std::equal(tokens.begin(), tokens.begin() + long(common), asked.begin())) return false;
  JsonPointer rest;
  for (std::size_t i = common; i < asked.size(); ++i) rest.push_back(asked[i]);
  return value->contains(rest);
}

Json* Assignment::find(Json& copy, const JsonPointer& pointer) const {
  const std::vector<std::string> asked = tokens_of(pointer);
  if (tokens.size() > asked.size() || !std::equal(tokens.begin(), tokens.end(), asked.begin()))
    return nullptr;
  JsonPointer rest;
  for (std::size_t i = tokens.size(); i < asked.size(); ++i) rest.push_back(asked[i]);
  return copy.contains(rest) ? &copy[rest] : nullptr;
}

}  // namespace bristle::json
