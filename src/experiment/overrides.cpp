#include "experiment/overrides.hpp"

#include "experiment/sample.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <nlohmann/json.hpp>

namespace bristle::experiment {
namespace {

// Returns the place of what varies the quantity: its axis, a column of the sample or a variable of the
// design; none if nothing does. A tolerance deviates from the nominal value of a block, which it does not
// replace.
std::optional<JsonPointer> varied_at(const json::Document& document, const std::string& quantity) {
  const Json& json = document.json();
  for (const char* block : {"/design/variables", "/sweep/sample/over", "/sweep"})
    if (const JsonPointer at = JsonPointer(block) / quantity; json.contains(at)) return at;
  const JsonPointer columns = JsonPointer("/sweep") / sweep::kSample / "table" / "columns";
  if (json.contains(columns) && json.at(columns).is_array())
    for (const Json& column : json.at(columns))
      if (column == quantity) return columns.parent_pointer();
  return {};
}

// Returns the value and another one of the quantity; nothing for a value that is neither a number nor a word.
std::vector<double> two_values(const sweep::Sweepable& quantity, const Json& value) {
  if (!quantity.options.empty()) return {0, 1};
  if (!value.is_number()) return {};
  const auto x = value.get<double>();
  return {x, x == 0 ? 1 : 1.1 * x};
}

}  // namespace

JsonPointer place_of(const json::Document& document, const std::string& quantity) {
  for (const std::string& name : {quantity, quantity + "_m"})
    if (const auto at = varied_at(document, name)) return *at;
  for (const char* block : {"/si", "/model", "/load", "/orientation"})
    for (const std::string& name : {quantity + "_m", quantity})
      if (const JsonPointer at = JsonPointer(block) / name; document.json().contains(at)) return at;
  if (const std::string prefix = sweep::kScatterPrefix; quantity.starts_with(prefix))
    return JsonPointer("/scatter") / quantity.substr(prefix.size());
  return JsonPointer("/model") / quantity;
}

void check_overrides(const json::Document& document) {
  for (const std::string name : {"model", "si", "load", "orientation", "scatter"}) {
    const JsonPointer block = JsonPointer() / name;
    if (!document.json().contains(block)) continue;
    for (const auto& [key, value] : document.json().at(block).items()) {
      const JsonPointer at = block / key;
      const auto varied = varied_at(document, (name == "scatter" ? sweep::kScatterPrefix : "") + key);
      // Beside a variable of a design the value is the start of the search.
      if (!varied || varied->parent_pointer() == JsonPointer("/design/variables") || !document.chosen(at) ||
          (!document.set_by_option(at) && document.chosen(*varied)))
        continue;
      const std::string why = fmt::format("has no effect, because {} varies {}", varied->to_string(), key);
      document.fail(at.to_string(),
                    document.set_by_option(at) && varied->parent_pointer() == JsonPointer("/sweep")
                        ? fmt::format("{}; --set {}=null beside it fixes {}", why, varied->to_string(), key)
                        : fmt::format("{}; set {} instead, or remove it by null", why, varied->to_string()));
    }
  }
}

std::vector<std::string> idle_changes(const json::Document& document, const sweep::Sweep& sweep) {
  std::vector<std::string> out;
  for (const char* name : {"model", "si", "load", "orientation"}) {
    const JsonPointer block = JsonPointer() / name;
    if (!document.json().contains(block)) continue;
    for (const auto& [key, value] : document.json().at(block).items()) {
      const JsonPointer at = block / key;
      const sweep::Sweepable* quantity = sweep::find_sweepable(key);
      if (!document.set_by_option(at) || !quantity || sweep.varies(key)) continue;
      const std::vector<double> values = two_values(*quantity, value);
      if (values.empty()) continue;
      const auto idle = axes_without_effect(sweep.with({key, values}));
      if (std::ranges::find(idle, key) != idle.end())
        out.push_back(
            fmt::format("{}: {}: has no effect with these choices of friction, load and orientation",
                        document.origin(at), at.to_string()));
    }
  }
  return out;
}

}  // namespace bristle::experiment
