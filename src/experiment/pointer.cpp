#include "experiment/pointer.hpp"

#include "experiment/schema.hpp"
#include "util/error.hpp"
#include "util/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

namespace bristle::experiment {
namespace {

// Returns the pointers to each key: of the file, and of its blocks. The block "tiers" contains further
// blocks.
std::map<std::string, std::vector<std::string>> pointers_by_key() {
  const Json& root = experiment_schema().root();
  std::map<std::string, std::vector<std::string>> out;
  for (const auto& [block, schema] : root["properties"].items()) {
    out[block].push_back("/" + block);
    const std::string reference = schema.value("$ref", "");
    const Json& resolved = reference.empty() ? schema : root[JsonPointer(reference.substr(1))];
    if (block == "tiers" || !resolved.contains("properties")) continue;
    for (const auto& [key, value] : resolved["properties"].items())
      out[key].push_back(fmt::format("/{}/{}", block, key));
  }
  return out;
}

std::string with_pointer(const std::string& change) {
  static const std::map<std::string, std::vector<std::string>> known = pointers_by_key();
  const std::string key = change.substr(0, change.find('='));
  if (key.find('/') != key.npos || key == change || key.empty()) return change;  // read as a pointer
  const auto found = known.find(key);
  if (found == known.end()) {
    std::vector<std::string> keys;
    for (const auto& [name, pointers] : known) keys.push_back(name);
    const std::string place = place_in_words(key);
    throw InputError(
        fmt::format("--set {}: no block of an experiment has the key {}{}", printable(change), printable(key),
                    place.empty() ? did_you_mean(key, keys) : fmt::format(" (did you mean {}?)", place)));
  }
  if (found->second.size() > 1)
    throw InputError(fmt::format("--set {}: {} may be {}; write --set {}", printable(change), key,
                                 fmt::join(found->second, " or "),
                                 found->second.front() + change.substr(key.size())));
  return found->second.front() + change.substr(key.size());
}

}  // namespace

std::vector<std::string> with_pointers(const std::vector<std::string>& changes) {
  std::vector<std::string> out;
  for (const std::string& change : changes) out.push_back(with_pointer(change));
  return out;
}

}  // namespace bristle::experiment
