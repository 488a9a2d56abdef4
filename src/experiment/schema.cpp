#include "experiment/schema.hpp"

#include "experiment/design.hpp"
#include "experiment/si_units.hpp"
#include "util/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <cmath>
#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

namespace bristle::experiment {

const char* experiment_schema_text();  // experiment.schema.json

namespace {

using Plain = nlohmann::json;  // the type that valijson's adapter requires

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
  for (const SiQuantity& q : si_quantities()) {
    const std::string units = std::string(q.units) == "1" ? "dimensionless" : q.units;
    const std::string remark = q.remark ? fmt::format("; {}", q.remark) : "";
    out[q.name] = number_schema(q.limits, fmt::format("{}, {}{}", q.description, units, remark));
  }
  return out;
}

Json assemble() {
  Json schema = Json::parse(experiment_schema_text());
  const auto set_words = [&](const char* pointer, Words words) {
    schema[JsonPointer(pointer)]["enum"] = words;
  };
  set_words("/properties/load/properties/path", words<LoadPath>());
  set_words("/properties/orientation/properties/distribution", words<Distribution>());
  set_words("/properties/orientation/properties/sampling", words<Sampling>());
  set_words("/properties/integrator/properties/engine", words<Engine>());
  set_words("/definitions/objective/properties/of", words<Statistic>());
  schema["definitions"]["model"]["properties"] = model_properties();
  schema["definitions"]["si"]["properties"] = si_properties();
  return schema;
}

const Json& resolve(const Json& schema) {
  if (!schema.contains("$ref")) return schema;
  return experiment_schema().at(JsonPointer(schema["$ref"].get<std::string>().substr(1)));
}

// The subschema of one member or array element, or null.
const Json& subschema(const Json& schema, const std::string& token) {
  static const Json none;
  const Json& here = resolve(schema);
  if (here.contains("properties") && here["properties"].contains(token))
    return resolve(here["properties"][token]);
  if (here.contains("anyOf"))
    for (const Json& option : here["anyOf"])
      if (const Json& found = subschema(option, token); !found.is_null()) return found;
  const bool is_index = token.find_first_not_of("0123456789") == token.npos;
  if (here.contains("items") && is_index) return resolve(here["items"]);
  if (here.contains("additionalProperties") && here["additionalProperties"].is_object())
    return resolve(here["additionalProperties"]);
  return none;
}

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

// What a subschema allows: "a number greater than 0 (radial stiffness, dimensionless)".
std::string allowed_by_schema(const Json& schema) {
  const Json& s = resolve(schema);
  std::string text;
  if (s.contains("const")) {
    text = s["const"].dump();
  } else if (s.contains("enum")) {
    std::vector<std::string> options;
    for (const Json& option : s["enum"]) options.push_back(option.dump());
    text = fmt::format("{}", fmt::join(options, ", "));
  } else if (s.contains("anyOf")) {
    std::vector<std::string> options;
    for (const Json& option : s["anyOf"]) options.push_back(allowed_by_schema(option));
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
      if (s.contains("items")) text += ", each " + allowed_by_schema(s["items"]);
    } else {
      text = (type == "object" ? "an " : "a ") + type;
      if (s.contains("minProperties")) text += " that is not empty";
    }
  }
  if (s.contains("description")) text += fmt::format(" ({})", s["description"].get<std::string>());
  return text;
}

// Throws InputError that explains why the value does not match the schema.
[[noreturn]] void explain(const Document& d, const JsonPointer& at, const Json& schema) {
  const Json& value = d.json().at(at);
  if (value.is_object() && schema.contains("properties")) {
    const auto known = keys_of(schema["properties"]);
    for (const auto& [key, child] : value.items())
      if (!schema["properties"].contains(key) && schema.value("additionalProperties", Json(true)) == false)
        d.fail((at / key).to_string(),
               fmt::format("unknown key{}; allowed: {}", did_you_mean(key, known), fmt::join(known, ", ")));
    if (schema.contains("required"))
      for (const std::string key : schema["required"])
        if (!value.contains(key))
          d.fail((at / key).to_string(), fmt::format("is missing; allowed: {}",
                                                     allowed_by_schema(resolve(schema["properties"][key]))));
  }
  std::string hint;
  if (value.is_string() && schema.contains("enum"))
    hint = did_you_mean(value, schema["enum"].get<std::vector<std::string>>());
  if (value.is_number_float() && schema.value("type", "") == "integer" && is_whole(value))
    hint = fmt::format("; write {}", value.get<long>());
  if (value.is_array() && schema.value("uniqueItems", false))
    for (auto one = value.begin(); one != value.end(); ++one)
      if (std::find(value.begin(), one, *one) != one) hint = fmt::format(": {} appears twice", shown(*one));
  d.fail(at.to_string(),
         fmt::format("{} is not allowed{}; allowed: {}", shown(value), hint, allowed_by_schema(schema)));
}

// valijson's context is "<root>", "[model]", "[k_r]".
JsonPointer pointer_from(const std::vector<std::string>& context) {
  JsonPointer pointer;
  for (std::size_t i = 1; i < context.size(); ++i) pointer /= context[i].substr(1, context[i].size() - 2);
  return pointer;
}

// valijson matches the name's pattern by std::regex, which needs stack for each character: a long name would
// end the program.
void require_short_name(const Document& d) {
  const std::size_t most = experiment_schema()["properties"]["name"]["maxLength"];
  if (!d.json().contains("name") || !d.json()["name"].is_string()) return;
  if (const std::size_t length = d.json()["name"].get_ref<const std::string&>().size(); length > most)
    d.fail("/name",
           fmt::format("{} has {} characters; allowed: at most {}", shown(d.json()["name"]), length, most));
}

bool matches(const Plain& schema_document, const Json& value,
             std::vector<std::vector<std::string>>* contexts) {
  valijson::Schema schema;
  valijson::SchemaParser parser;
  const valijson::adapters::NlohmannJsonAdapter schema_adapter(schema_document);
  parser.populateSchema(schema_adapter, schema);
  const Plain plain = value;
  const valijson::adapters::NlohmannJsonAdapter target(plain);
  valijson::ValidationResults results;
  const bool fine = valijson::Validator().validate(schema, target, &results);
  valijson::ValidationResults::Error error;
  while (contexts && results.popError(error)) contexts->push_back(error.context);
  return fine;
}

}  // namespace

const Json& experiment_schema() {
  static const Json schema = assemble();
  return schema;
}

const Json& parameter_schema(const std::string& name) {
  for (const char* place : {"/definitions/model/properties", "/properties/load/properties",
                            "/properties/orientation/properties", "/definitions/si/properties"})
    if (const Json& properties = experiment_schema()[JsonPointer(place)]; properties.contains(name))
      return properties[name];
  throw std::logic_error("no schema for " + name);
}

void check_schema(const Document& document, const Json& root) {
  require_short_name(document);
  std::vector<std::vector<std::string>> contexts;
  if (matches(Plain(root), document.json(), &contexts)) return;
  // The deepest mismatch is the cause; those above it follow from it.
  const auto deepest = std::max_element(contexts.begin(), contexts.end(),
                                        [](const auto& a, const auto& b) { return a.size() < b.size(); });
  const JsonPointer at = pointer_from(*deepest);
  const Json* schema = &resolve(root);
  for (std::size_t i = 1; i < deepest->size(); ++i)
    schema = &subschema(*schema, (*deepest)[i].substr(1, (*deepest)[i].size() - 2));
  explain(document, at, *schema);
}

void check_parameter(const Document& document, const JsonPointer& at, const std::string& parameter,
                     double value) {
  const Json& schema = parameter_schema(parameter);
  if (!matches(Plain(schema), is_whole(value) ? Json(long(value)) : Json(value), nullptr))
    document.fail(at.to_string(), fmt::format("{} is out of range for {}; allowed: {}", value, parameter,
                                              allowed_by_schema(schema)));
}

}  // namespace bristle::experiment
