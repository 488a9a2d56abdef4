#include "archive/readme.hpp"

#include "archive/crate_entities.hpp"
#include "util/text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace bristle::archive {

const char* readme_template();  // src/archive/README.md.in, embedded by the build

namespace {

std::string name_of(const ArchivedResult& result) { return result.facts["name"]; }

std::string results_table(const Contents& contents) {
  std::string text = "| result | what | points | figure |\n|---|---|---|---|\n";
  for (const ArchivedResult& result : contents.results)
    text += fmt::format("| [{}]({}) | {} | {} | [{}.pdf]({}) |\n", result.file, result.file,
                        result.facts["title"].get<std::string>(), result.facts["points"].get<long>(),
                        name_of(result), result.figures.front());
  return text;
}

std::string claims_table(const Contents& contents) {
  std::string rows;
  for (const ArchivedResult& result : contents.results)
    for (const Json& check : result.facts["checks"]) {
      const std::string verdict = check["verdict"];
      rows +=
          fmt::format("| {} | {} | {} |\n", check["claim"].get<std::string>(),
                      check["statement"].get<std::string>(), verdict == "refuted" ? "**refuted**" : verdict);
    }
  if (rows.empty()) return "The experiments have no checks.\n";
  return "| claim | statement | verdict |\n|---|---|---|\n" + rows;
}

std::string authors_of(const Json& citation) {
  std::string text;
  for (const Json& author : citation["authors"]) {
    if (!text.empty()) text += ", ";
    text += author.contains("name")
                ? author["name"].get<std::string>()
                : author.value("given-names", "") + " " + author.value("family-names", "");
  }
  return text;
}

}  // namespace

std::string archive_readme(const Contents& contents) {
  const Json& citation = contents.citation;
  const std::string example = name_of(contents.results.front());
  const std::pair<const char*, std::string> values[] = {
      {"{{title}}", citation["title"]},
      {"{{version}}", citation["version"]},
      {"{{date}}", citation["date-released"]},
      {"{{license}}", citation["license"]},
      {"{{program_license}}", citation["references"][0]["license"]},
      {"{{doi}}", citation.contains("doi") ? fmt::format(" DOI: <{}>.", doi_address(citation["doi"])) : ""},
      {"{{authors}}", authors_of(citation)},
      {"{{commit}}", contents.commit},
      {"{{source}}", contents.source},
      {"{{example}}", example},
      {"{{draft}}",
       contents.draft.empty() ? "" : fmt::format("**A draft, not to be cited:** {}.\n\n", contents.draft)},
      {"{{results}}", results_table(contents)},
      {"{{claims}}", claims_table(contents)},
  };
  std::string text = readme_template();
  for (const auto& [key, value] : values) text = replace_all(std::move(text), key, value);
  return text;
}

}  // namespace bristle::archive
