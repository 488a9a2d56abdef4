
#include "experiment/experiment.hpp"
#include "experiment/schema.hpp"
#include "sweep/sweepable.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace bristle::experiment {
namespace {

const Json kNull = {{"type", "null"}};

// Returns the schema with null allowed, too: in a merge patch it removes the key.
Json or_null(Json schema) {
  if (schema.contains("$ref")) return {{"anyOf", {schema, kNull}}};
  if (schema.contains("anyOf")) schema["anyOf"].push_back(kNull);
  else if (schema.contains("enum")) schema["enum"].push_back(nullptr);
  else if (schema.contains("const")) {
    schema["enum"] = Json::array({schema["const"], nullptr});
    schema.erase("const");
  } else {
    schema["type"] = Json::array({schema["type"], "null"});
  }
  return schema;
}

// Returns the schema of a merge patch: keys may be missing or null, in nested objects, too. Arrays are
// replaced whole.
Json patch(Json schema) {
  const auto required = schema.value("required", std::vector<std::string>());
  schema.erase("required");
  if (schema.contains("properties"))
    for (auto& [key, property] : schema["properties"].items()) {
      property = patch(property);
      if (std::ranges::count(required, key) == 0) property = or_null(property);
    }
  if (schema.contains("additionalProperties") && schema["additionalProperties"].is_object())
    schema["additionalProperties"] = or_null(patch(schema["additionalProperties"]));
  if (schema.contains("anyOf"))
    for (Json& option : schema["anyOf"]) option = patch(option);
  return schema;
}

// Returns the schema of an array of these words or numbers, which are all different, as the program requires.
Json list_of(const Json& items) {
  return {{"type", "array"}, {"minItems", 1}, {"uniqueItems", true}, {"items", items}};
}

Json range_of(const Json& value, const char* description) {
  const Json count = {{"type", "integer"}, {"minimum", 1}, {"maximum", long(kMaxPoints)}};
  return {{"type", "array"},
          {"minItems", 3},
          {"maxItems", 3},
          {"items", {value, value, count}},
          {"description", description}};
}

// Returns the keys of the axis of a number: its values are in the range of the parameter.
Json number_axis(Json value) {
  if (value.contains("anyOf")) value = value["anyOf"][0];  // C, which may also be a word
  value.erase("description");
  Json positive = value;
  if (positive.value("minimum", -1.0) <= 0) {
    positive.erase("minimum");
    positive["exclusiveMinimum"] = 0;
  }
  return {{"values", list_of(value)},
          {"linspace", range_of(value, "[from, to, count], in equal steps")},
          {"logspace", range_of(positive, "[from, to, count], in equal ratios")}};
}

// Returns the schema of a sweep: the axes that it may have, by their names.
Json sweep(const Json& take, const Json& sample) {
  Json axes = {{"sample", sample}}, names = Json::array();
  for (const sweep::Sweepable& s : sweep::sweepables()) names.push_back(s.name);
  // A table in the experiment itself, in place of the name of its file.
  axes[JsonPointer("/sample/properties/table/anyOf/1/properties/columns/items")] = {{"enum", names}};
  for (const sweep::Sweepable& s : sweep::sweepables()) {
    Json keys = s.options.empty() ? number_axis(parameter_schema(s.name))
                                  : Json{{"values", list_of({{"enum", s.options}})}};
    keys["take"] = take;
    axes[s.name] = {{"type", "object"},
                    {"additionalProperties", false},
                    {"properties", keys},
                    {"description", s.description}};
  }
  return {{"type", "object"}, {"additionalProperties", false}, {"properties", axes}};
}

void add_defaults(Json& model) {
  const Parameters defaults;
  for (const Parameter& p : kParameters)
    if (p.word) model[p.name]["default"] = p.word;
    else if (std::isfinite(defaults.*p.member)) model[p.name]["default"] = defaults.*p.member / p.unit;
  for (const Choice& c : choices()) model[c.name]["default"] = c.words[std::size_t(c.get(defaults))];
}

// Returns the schema with the definitions that it refers to in their places.
Json inlined(const Json& schema, const Json& definitions) {
  if (schema.contains("$ref")) {
    const std::string name = schema["$ref"].get<std::string>().substr(std::string("#/definitions/").size());
    return inlined(definitions.at(name), definitions);
  }
  Json out = schema;
  if (schema.is_structured())
    for (auto& [key, inner] : out.items()) inner = inlined(inner, definitions);
  return out;
}

}  // namespace

Json author_schema(const std::vector<std::string>& predicates) {
  const Json& parsed = experiment_schema().root();
  Json schema = inlined(parsed, parsed["definitions"]);
  schema[JsonPointer("/properties/checks/items/properties/predicate/enum")] = predicates;
  const std::vector<std::string> required = schema["required"];
  Json& keys = schema["properties"];
  add_defaults(keys["model"]["properties"]);
  keys["sweep"] = sweep(parsed["definitions"]["take"], keys["sweep"]["properties"]["sample"]);
  Json definitions = Json::object(), tier = Json::object(), file = Json::object();
  file["$schema"] = {{"type", "string"}, {"description", "this schema, for editors; the program ignores it"}};
  file["extends"] = {{"type", "string"},
                     {"description", "the file that this one changes, such as paper.json"}};
  for (const auto& [key, property] : keys.items()) {
    if (key == "tiers") continue;
    definitions[key] = patch(property);
    if (std::ranges::count(required, key) == 0) definitions[key] = or_null(definitions[key]);
    tier[key] = file[key] = {{"$ref", "#/definitions/" + key}};
  }
  definitions["tier"] = {{"type", {"object", "null"}}, {"additionalProperties", false}, {"properties", tier}};
  Json tiers = patch(keys["tiers"]);
  for (auto& [name, one] : tiers["properties"].items()) one = {{"$ref", "#/definitions/tier"}};
  file["tiers"] = or_null(tiers);
  return {{"$schema", parsed["$schema"]},
          {"title", "experiment of bristle"},
          {"type", "object"},
          {"additionalProperties", false},
          {"properties", file},
          {"definitions", definitions}};
}

}  // namespace bristle::experiment
