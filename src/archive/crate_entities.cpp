#include "archive/crate.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace bristle::archive {
namespace {

// Text, or a number as text.
std::string text_of(const Json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

// Adds issue, volume and journal, as far as they are known, each part of the next, and returns the first.
Json add_journal(const Json& article, const std::string& of, std::vector<Json>& entities) {
  Json part;
  const auto add = [&](const char* key, const char* type, const char* property) {
    if (!article.contains(key)) return;
    Json entity = {
        {"@id", fmt::format("#{}-of-{}", key, of)}, {"@type", type}, {property, text_of(article[key])}};
    if (!part.is_null()) entity["isPartOf"] = part;
    part = id(entity["@id"]);
    entities.push_back(std::move(entity));
  };
  add("journal", "Periodical", "name");
  add("volume", "PublicationVolume", "volumeNumber");
  add("issue", "PublicationIssue", "issueNumber");
  return part;
}

}  // namespace

Json id(const std::string& name) { return {{"@id", name}}; }

Json ids(const std::vector<std::string>& names) {
  Json out = Json::array();
  for (const std::string& name : names) out.push_back(id(name));
  return out;
}

std::string doi_address(const Json& doi) { return "https://doi.org/" + doi.get<std::string>(); }

std::string person_id(const Json& person, const std::string& role, std::size_t index) {
  return person.value("orcid", fmt::format("#{}-{}", role, index + 1));
}

Json add_people(const Json& people, const std::string& role, std::vector<Json>& entities) {
  Json out = Json::array();
  for (std::size_t i = 0; i < people.size(); ++i) {
    const Json& from = people[i];
    out.push_back(id(person_id(from, role, i)));
    const std::string given = from.value("given-names", ""), family = from.value("family-names", "");
    Json entity = {{"@id", out.back()["@id"]}, {"@type", from.contains("name") ? "Organization" : "Person"}};
    entity["name"] =
        from.value("name", given.empty() || family.empty() ? given + family : given + " " + family);
    if (from.contains("affiliation")) {
      entity["affiliation"] = id(fmt::format("#affiliation-of-{}-{}", role, i + 1));
      entities.push_back(
          {{"@id", entity["affiliation"]["@id"]}, {"@type", "Organization"}, {"name", from["affiliation"]}});
    }
    entities.push_back(std::move(entity));
  }
  return out;
}

Json add_article(const Json& article, std::vector<Json>& entities) {
  const std::string first = text_of(article["authors"].at(0).value("family-names", ""));
  const std::string name = fmt::format("{}-{}", first, text_of(article.value("year", Json(""))));
  Json entity = {{"@id", article.contains("doi") ? doi_address(article["doi"]) : "#" + name},
                 {"@type", "ScholarlyArticle"},
                 {"name", article["title"]},
                 {"author", add_people(article["authors"], name + "-author", entities)}};
  for (const auto& [key, property] :
       {std::pair("year", "datePublished"), std::pair("start", "pageStart"), std::pair("end", "pageEnd")})
    if (article.contains(key)) entity[property] = text_of(article[key]);
  if (const Json journal = add_journal(article, name, entities); !journal.is_null())
    entity["isPartOf"] = journal;
  entities.push_back(entity);
  return id(entity["@id"]);
}

}  // namespace bristle::archive
