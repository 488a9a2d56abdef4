#include "assumptions/alternative.hpp"

#include "json/document.hpp"
#include "json/schema.hpp"
#include "util/error.hpp"
#include "util/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <functional>
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

// Calls visit for each joint set of two or more alternatives to these choices, with at most one of each.
void joint_sets(const std::vector<Alternative>& all, const Json& choices, std::size_t first,
                std::vector<const Alternative*>& chosen,
                const std::function<void(const std::vector<const Alternative*>&)>& visit) {
  if (first == choices.size()) {
    if (chosen.size() >= 2) visit(chosen);
    return;
  }
  joint_sets(all, choices, first + 1, chosen, visit);
  for (const Alternative& one : all) {
    if (one.choice != choices[first].get<std::string>()) continue;
    chosen.push_back(&one);
    joint_sets(all, choices, first + 1, chosen, visit);
    chosen.pop_back();
  }
}

void require_choices(const std::vector<Alternative>& all, const Json& choices, const std::string& file) {
  for (const std::string name : choices)
    if (std::ranges::find(all, name, &Alternative::choice) == all.end())
      throw InputError(fmt::format("{}: /combinations: there is no choice {}", file, name));
}

Window read_window(const Json& json) {
  Window window{json["name"], {}, json["experiments"]};
  for (const auto& [axis, range] : json["where"].items())
    window.where.emplace_back(axis, range.get<std::array<double, 2>>());
  return window;
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

Declarations read_declarations(const std::vector<std::string>& files) {
  Declarations out{{"baseline", "", "every open choice as in docs/model.md", {}, {}}, {}, {}};
  std::vector<std::pair<std::string, Json>> documents;
  for (const std::string& file : files) {
    const json::Document document = json::Document::stored(read_json_file(file), file);
    json::Schema(Json::parse(assumption_schema())).check(document);
    const Json& json = documents.emplace_back(file, document.json()).second;
    if (json.contains("base"))
      out.baseline.declarations.push_back(std::make_shared<const Json>(json["base"]));
    for (const Json& window : json.value("windows", Json::array()))
      out.windows.push_back(read_window(window));
    for (const Json& one : json.value("alternatives", Json::array()))
      out.alternatives.push_back(
          {one["name"], json["choice"], one["description"], {}, {std::make_shared<const Json>(one)}});
  }
  const std::vector<Alternative> single = out.alternatives;
  for (const auto& [file, json] : documents) {
    for (const Json& pair : json.value("pairs", Json::array())) {
      std::vector<const Alternative*> members;
      for (const std::string name : pair["members"]) members.push_back(&find(single, name, file));
      out.alternatives.push_back(combine(members, pair["description"]));
    }
    const std::string question = json["question"];
    for (const Json& choices : json.value("combinations", Json::array())) {
      require_choices(single, choices, file);
      std::vector<const Alternative*> chosen;
      joint_sets(single, choices, 0, chosen, [&](const auto& members) {
        Alternative set = combine(members, question);
        if (std::ranges::find(out.alternatives, set.name, &Alternative::name) == out.alternatives.end())
          out.alternatives.push_back(std::move(set));  // an earlier list may have the same choices
      });
    }
  }
  check_unique(out.alternatives);
  if (out.windows.empty()) out.windows.emplace_back();
  for (Alternative& a : out.alternatives)
    a.declarations.insert(a.declarations.begin(), out.baseline.declarations.begin(),
                          out.baseline.declarations.end());
  return out;
}

}  // namespace bristle::assumptions
