#include "archive/crate.hpp"

#include "util/sha.hpp"
#include "util/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <filesystem>
#include <nlohmann/json.hpp>

namespace bristle::archive {
namespace {

constexpr const char* kProfile = "https://w3id.org/ro/wfrun/process/0.5";

// Returns a reference to an entity.
Json id(const std::string& name) { return {{"@id", name}}; }

Json ids(const std::vector<std::string>& names) {
  Json out = Json::array();
  for (const std::string& name : names) out.push_back(id(name));
  return out;
}

// Returns a text, or a number as text.
std::string text_of(const Json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

// Returns the ORCID, or else "#role-<index + 1>".
std::string person_id(const Json& person, const std::string& role, std::size_t index) {
  return person.value("orcid", fmt::format("#{}-{}", role, index + 1));
}

// Adds the entities of people of a citation and returns the references to them.
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

// Adds an article of a citation, with its authors and its journal, and returns the reference to it.
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

const Json& program_of(const Contents& contents) { return contents.citation["references"][0]; }

Json license_id(const Json& license) { return id("https://spdx.org/licenses/" + license.get<std::string>()); }

Json agent(const Contents& contents) { return id(person_id(contents.citation["authors"][0], "author", 0)); }

std::string encoding_of(const std::string& name) {
  const std::map<std::string, std::string> known = {
      {".h5", "application/x-hdf5"}, {".json", "application/json"}, {".pdf", "application/pdf"},
      {".png", "image/png"},         {".md", "text/markdown"},      {".tar", "application/x-tar"},
      {".cff", "application/yaml"},  {".svg", "image/svg+xml"},     {".html", "text/html"}};
  const auto found = known.find(std::filesystem::path(name).extension().string());
  return found == known.end() ? "text/plain" : found->second;
}

std::string description_of(const std::string& name, const Contents& contents) {
  for (const ArchivedResult& result : contents.results) {
    const std::string title = result.facts["title"];
    if (name == result.file) return "Result: " + title;
    if (name == result.experiments.back()) return "Experiment: " + title;
    for (const std::string& figure : result.figures)
      if (name == figure) return "Plot: " + title;
  }
  if (name == contents.source) return "The program's source at commit " + contents.commit;
  if (name == "CITATION.cff") return "How to cite this archive";
  if (name == "LICENSE") return "The licence of the program";
  if (name == "LICENSE-DATA") return "The licence of everything else";
  if (name == "README.md") return "Contents of this archive and how to use it";
  if (name == "report/brush.html") return "The friction of a brush, computed in a browser";
  const std::string folder = name.substr(0, name.rfind('/'));
  if (folder == "results") return "The verdicts on the paper's claims under other assumptions";
  if (folder == "report") return "All figures, claims, limits and sources on one page";
  if (folder == "experiments/assumptions") return "Alternatives to what the experiments assume";
  if (folder == "experiments") return "Experiment that others extend";
  if (folder == "reference") return "Numbers with which every commit of the program is compared";
  return "Documentation";
}

Json file_entity(const std::string& name, const std::string& bytes, const Contents& contents) {
  Json out = {{"@id", name},
              {"@type", "File"},
              {"name", std::filesystem::path(name).filename().string()},
              {"description", description_of(name, contents)},
              {"encodingFormat", encoding_of(name)},
              {"contentSize", fmt::format("{}", bytes.size())},
              {"sha512", sha512_of(bytes)}};
  if (name == contents.source) out["license"] = license_id(program_of(contents)["license"]);
  return out;
}

std::string provenance(const ArchivedResult& result, const char* key) {
  return result.facts["provenance"].value(key, "unknown");
}

// Returns the commit of the program that wrote the result, then the commits of programs that computed some of
// its points earlier.
std::vector<std::string> commits_of(const ArchivedResult& result) {
  std::vector<std::string> commits{provenance(result, "commit")};
  for (const std::string& commit : split_list(result.facts["provenance"].value("points_commits", "")))
    if (commit != commits.front()) commits.push_back(commit);
  return commits;
}

std::string program_id(const std::string& commit) { return "#bristle-" + commit; }

// Returns the entity of a program. Only the version of the program that wrote the result is known; for a
// program that computed only some points, the commit takes its place.
Json program(const std::string& commit, const ArchivedResult& result, const Contents& contents) {
  const bool wrote = commit == provenance(result, "commit");
  return {
      {"@id", program_id(commit)}, {"@type", "SoftwareApplication"},
      {"name", "bristle"},         {"softwareVersion", wrote ? provenance(result, "version") : commit},
      {"identifier", commit},      {"url", program_of(contents).value("repository-code", contents.source)}};
}

Json programs(const ArchivedResult& result) {
  std::vector<std::string> names;
  for (const std::string& commit : commits_of(result)) names.push_back(program_id(commit));
  return ids(names);
}

Json run_action(const ArchivedResult& result, const Contents& contents) {
  return {{"@id", fmt::format("#run-{}", result.facts["name"].get<std::string>())},
          {"@type", "CreateAction"},
          {"name", fmt::format("Computation of {}", result.facts["title"].get<std::string>())},
          {"description", provenance(result, "command_line")},
          {"startTime", provenance(result, "started")},
          {"endTime", provenance(result, "finished")},
          {"agent", agent(contents)},
          {"instrument", programs(result)},
          {"object", ids(result.experiments)},
          {"result", id(result.file)}};
}

std::string script_id(const ArchivedResult& result) {
  return fmt::format("#python/bristle/figures/{}.py", result.facts["name"].get<std::string>());
}

Json script(const ArchivedResult& result, const Contents& contents) {
  return {{"@id", script_id(result)},
          {"@type", "SoftwareApplication"},
          {"name", script_id(result).substr(1)},
          {"softwareVersion", contents.citation["version"]},
          {"identifier", contents.commit},
          {"url", contents.source}};
}

Json plot_action(const ArchivedResult& result, const Contents& contents) {
  return {{"@id", fmt::format("#plot-{}", result.facts["name"].get<std::string>())},
          {"@type", "CreateAction"},
          {"name", fmt::format("Plot of {}", result.facts["title"].get<std::string>())},
          {"agent", agent(contents)},
          {"instrument", id(script_id(result))},
          {"object", id(result.file)},
          {"result", ids(result.figures)}};
}

// Returns the root data entity, without its parts.
Json root(const Contents& contents) {
  const Json& citation = contents.citation;
  Json out = {{"@id", "./"},
              {"@type", "Dataset"},
              {"name", citation["title"]},
              {"description", citation["abstract"]},
              {"version", citation["version"]},
              {"datePublished", citation["date-released"]},
              {"license", license_id(citation["license"])},
              {"conformsTo", id(kProfile)},
              {"author", Json::array()},
              {"publisher", agent(contents)},
              {"citation", Json::array()},
              {"hasPart", Json::array()},
              {"mentions", Json::array()}};
  if (citation.contains("doi")) out["identifier"] = doi_address(citation["doi"]);
  if (citation.contains("keywords"))
    out["keywords"] =
        fmt::format("{}", fmt::join(citation["keywords"].get<std::vector<std::string>>(), ", "));
  if (!contents.draft.empty()) out["creativeWorkStatus"] = "Draft, not to be cited: " + contents.draft;
  return out;
}

// Returns the contextual entities except people: profile, licences, programs, scripts, and the runs of both.
std::vector<Json> contextual_entities(const Contents& contents) {
  std::vector<Json> out;
  out.push_back(
      {{"@id", kProfile}, {"@type", "CreativeWork"}, {"name", "Process Run Crate"}, {"version", "0.5"}});
  for (const auto& [license, file] :
       {std::pair<Json, std::string>(contents.citation["license"], "LICENSE-DATA"),
        std::pair<Json, std::string>(program_of(contents)["license"], "LICENSE")})
    out.push_back({{"@id", license_id(license)["@id"]},
                   {"@type", "CreativeWork"},
                   {"name", license},
                   {"description", fmt::format("The file {} has its text or address.", file)}});
  std::map<std::string, Json> instruments;
  for (const ArchivedResult& result : contents.results) {
    for (const std::string& commit : commits_of(result)) {
      const Json entity = program(commit, result, contents);
      if (commit == provenance(result, "commit")) instruments[program_id(commit)] = entity;
      else instruments.emplace(program_id(commit), entity);
    }
    instruments[script_id(result)] = script(result, contents);
  }
  for (const auto& [name, entity] : instruments) out.push_back(entity);
  for (const ArchivedResult& result : contents.results) {
    out.push_back(run_action(result, contents));
    out.push_back(plot_action(result, contents));
  }
  return out;
}

}  // namespace

std::string doi_address(const Json& doi) { return "https://doi.org/" + doi.get<std::string>(); }

std::string crate_text(const Contents& contents) {
  Json dataset = root(contents);
  std::vector<Json> others = contextual_entities(contents);
  dataset["author"] = add_people(contents.citation["authors"], "author", others);
  for (const Json& reference : contents.citation["references"])
    if (reference["type"] == "article") dataset["citation"].push_back(add_article(reference, others));
  for (const Json& entity : others)
    if (entity["@type"] == "CreateAction") dataset["mentions"].push_back(id(entity["@id"]));
  for (const auto& [name, bytes] : contents.payload) {
    dataset["hasPart"].push_back(id(name));
    others.push_back(file_entity(name, bytes, contents));
  }
  Json graph = Json::array();
  graph.push_back({{"@id", kCrateFile},
                   {"@type", "CreativeWork"},
                   {"conformsTo", id("https://w3id.org/ro/crate/1.1")},
                   {"about", id("./")}});
  graph.push_back(dataset);
  for (Json& entity : others) graph.push_back(std::move(entity));
  const Json crate = {
      {"@context",
       {"https://w3id.org/ro/crate/1.1/context", "https://w3id.org/ro/terms/workflow-run/context"}},
      {"@graph", graph}};
  return crate.dump(1) + "\n";
}

}  // namespace bristle::archive
