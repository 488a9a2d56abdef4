#include "experiment/schema.hpp"

#include "sweep/si.hpp"

#include <fmt/format.h>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace bristle::experiment {

const char* experiment_schema_text();  // experiment.schema.json

namespace {

bool is_whole(double value) { return value == std::floor(value) && std::abs(value) < 1e15; }

Json number_schema(const Bounds& limits, const std::string& description) {
  Json out = {{"type", "number"}};
  const auto add = [&out](const char* keyword, double value) {
    if (!std::isfinite(value)) return;
    if (value == std::floor(value)) out[keyword] = long(value);
    else out[keyword] = value;
  };
  add(limits.above_least ? "exclusiveMinimum" : "minimum", limits.least);
  add(limits.below_most ? "exclusiveMaximum" : "maximum", limits.most);
  out["description"] = description;
  return out;
}

Json model_properties() {
  Json out = Json::object();
  for (const Choice& c : choices()) out[c.name] = {{"enum", c.words}, {"description", c.description}};
  for (const Parameter& p : kParameters) {
    Json number = number_schema(p.limits, fmt::format("{}, {}", p.description, p.scale));
    if (!p.word) {
      out[p.name] = number;
      continue;
    }
    const Json description = number["description"];
    number.erase("description");
    out[p.name] = {{"anyOf", {number, {{"const", p.word}}}}, {"description", description}};
  }
  return out;
}

Json si_properties() {
  Json out = Json::object();
  for (const sweep::SiQuantity& q : sweep::si_quantities()) {
    const std::string units = std::string(q.units) == "1" ? "dimensionless" : q.units;
    const std::string remark = q.remark ? fmt::format("; {}", q.remark) : "";
    out[q.name] = number_schema(q.limits, fmt::format("{}, {}{}", q.description, units, remark));
  }
  return out;
}

Json scatter_properties() {
  Json out = {{"bristles",
               {{"enum", {16, 32, 64, 128, 256, 512}},
                {"default", Scatter{}.bristles},
                {"description", "different bristles that stand for the brush"}}}};
  for (const ScatteredProperty& one : kScattered)
    out[one.name] = {{"$ref", "#/definitions/deviation"}, {"description", one.description}};
  return out;
}

// Returns the schemas of the widths of the scatter by their names in a sweep.
Json scatter_widths() {
  Json out = Json::object();
  for (const ScatteredProperty& one : kScattered)
    out[sweep::kScatterPrefix + std::string(one.name)] =
        number_schema({.least = 0, .most = 1, .below_most = true},
                      fmt::format("scatter of the {}, relative: standard deviation, or greatest deviation "
                                  "if the block scatter says uniform",
                                  one.description));
  return out;
}

Json assemble() {
  Json schema = parse_json(experiment_schema_text());
  const auto set_words = [&](const char* pointer, Words words) {
    schema[JsonPointer(pointer)]["enum"] = words;
  };
  set_words("/properties/load/properties/path", words<LoadPath>());
  set_words("/properties/orientation/properties/distribution", words<Distribution>());
  set_words("/properties/orientation/properties/sampling", words<Sampling>());
  set_words("/properties/integrator/properties/engine", words<Engine>());
  schema["definitions"]["model"]["properties"] = model_properties();
  schema["definitions"]["si"]["properties"] = si_properties();
  schema["properties"]["scatter"]["properties"] = scatter_properties();
  schema["definitions"]["scatter_widths"]["properties"] = scatter_widths();
  return schema;
}

// The schemas of what a sweep can vary, and the block of an experiment with its values.
constexpr std::pair<const char*, const char*> kHomes[] = {
    {"/definitions/model/properties", "/model"},
    {"/properties/load/properties", "/load"},
    {"/properties/orientation/properties", "/orientation"},
    {"/definitions/si/properties", "/si"},
    {"/definitions/scatter_widths/properties", "/scatter"}};

}  // namespace

const json::Schema& experiment_schema() {
  static const json::Schema schema(assemble(), place_in_words);
  return schema;
}

const Json& parameter_schema(const std::string& name) {
  for (const auto& [place, block] : kHomes)
    if (const Json& properties = experiment_schema().root()[JsonPointer(place)]; properties.contains(name))
      return properties[name];
  throw std::logic_error("no schema for " + name);
}

std::optional<JsonPointer> pointer_to(const std::string& name) {
  const std::string prefix = sweep::kScatterPrefix;
  for (const auto& [place, block] : kHomes)
    if (experiment_schema().root()[JsonPointer(place)].contains(name))
      return JsonPointer(block) / (name.starts_with(prefix) ? name.substr(prefix.size()) : name);
  return {};
}

std::string place_in_words(const std::string& name) {
  const auto at = pointer_to(name);
  if (!at) return "";
  const std::string text = at->to_string();
  return name.starts_with(sweep::kScatterPrefix) ? fmt::format("{0}/normal or {0}/uniform", text) : text;
}

void check_parameter(const json::Node& place, const std::string& parameter, double value) {
  const Json& part = parameter_schema(parameter);
  const json::Schema& schema = experiment_schema();
  if (!schema.matches(part, is_whole(value) ? Json(long(value)) : Json(value)))
    place.fail(fmt::format("{} is out of range for {}; allowed: {}", value, parameter, schema.allowed(part)));
}

}  // namespace bristle::experiment
