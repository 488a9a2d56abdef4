#include "assumptions/alternative.hpp"

#include "json/document.hpp"
#include "json/schema.hpp"
#include "util/error.hpp"
#include "util/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <nlohmann/json.hpp>

namespace bristle::assumptions {

const char* assumption_schema();  // the text of assumption.schema.json, embedded by the build

namespace {

std::vector<std::string> names_of(const std::vector<Alternative>& alternatives) {
  std::vector<std::string> names;
  for (const Alternative& a : alternatives) names.push_back(a.name);
  return names;
}

const Alternative& find(const std::vector<Alternative>& alternatives, const std::string& name,
                        const std::string& file) {
  const auto found = std::find_if(alternatives.begin(), alternatives.end(),
                                  [&](const Alternative& a) { return a.name == name; });
  if (found == alternatives.end())
    throw InputError(fmt::format("{}: /pairs: there is no alternative {}{}", file, name,
                                 did_you_mean(name, names_of(alternatives))));
  return *found;
}

Alternative combine(const std::vector<const Alternative*>& members, const std::string& description) {
  Alternative out;
  out.choice = "together";
  for (const Alternative* member : members) {
    out.members.push_back(member->name);
    out.declarations.insert(out.declarations.end(), member->declarations.begin(), member->declarations.end());
  }
  out.name = fmt::format("{}", fmt::join(out.members, " + "));
  out.description = description;
  return out;
}

void check_unique(const std::vector<Alternative>& alternatives) {
  std::vector<std::string> names = names_of(alternatives);
  std::sort(names.begin(), names.end());
  if (const auto duplicate = std::adjacent_find(names.begin(), names.end()); duplicate != names.end())
    throw InputError(fmt::format("two alternatives have the name {}; give each a unique name", *duplicate));
}

}  // namespace

Json Alternative::apply(const std::string& experiment, Json document) const {
  for (const auto& declaration : declarations) {
    const Json& one = *declaration;
    document.merge_patch(one.value("patch", Json::object()));
    const Json own = one.value("experiments", Json::object()).value(experiment, Json::object());
    document.merge_patch(own.value("patch", Json::object()));
    const Json replaced = own.value("set", Json::object());
    for (const auto& [pointer, value] : replaced.items()) {
      try {
        document.at(JsonPointer(pointer)) = value;
      } catch (const Json::exception&) {
        throw InputError(
            fmt::format("alternative {}: {} has no value at {}; \"set\" replaces existing values only", name,
                        experiment, pointer));
      }
    }
  }
  return document;
}

std::vector<Alternative> read_alternatives(const std::vector<std::string>& files) {
  std::vector<Alternative> out = {{"baseline", "", "every open choice as in docs/model.md", {}, {}}};
  std::vector<std::pair<std::string, Json>> documents;
  for (const std::string& file : files) {
    const json::Document document = json::Document::stored(read_json_file(file), file);
    json::Schema(parse_json(assumption_schema())).check(document);
    const Json& json = documents.emplace_back(file, document.json()).second;
    for (const Json& one : json.value("alternatives", Json::array()))
      out.push_back(
          {one["name"], json["choice"], one["description"], {}, {std::make_shared<const Json>(one)}});
  }
  const std::vector<Alternative> single = out;
  for (const auto& [file, json] : documents)
    for (const Json& pair : json.value("pairs", Json::array())) {
      std::vector<const Alternative*> members;
      for (const std::string name : pair["members"]) members.push_back(&find(single, name, file));
      out.push_back(combine(members, pair["description"]));
    }
  check_unique(out);
  return out;
}

}  // namespace bristle::assumptions
