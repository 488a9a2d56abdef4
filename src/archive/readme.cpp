#include "archive/contents.hpp"

#include "archive/crate.hpp"

#include <boost/algorithm/string/replace.hpp>
#include <fmt/format.h>
#include <algorithm>
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

std::string reading_title(const std::string& reading) {
  if (reading.empty()) return "verdict";
  if (reading == "polar") return "corrected";
  if (reading == "polar_as_printed") return "as printed";
  return reading;
}

std::string claims_table(const Contents& contents) {
  std::vector<std::string> readings;
  for (const ArchivedResult& result : contents.results)
    for (const Json& claim : result.facts["claims"])
      for (const auto& [reading, verdict] : claim["verdicts"].items())
        if (std::ranges::count(readings, reading) == 0) readings.push_back(reading);
  if (readings.empty()) return "The experiments have no checks.\n";
  std::string text = "| claim | first check |", line = "\n|---|---|";
  for (const std::string& reading : readings) {
    text += fmt::format(" {} |", reading_title(reading));
    line += "---|";
  }
  text += line + "\n";
  for (const ArchivedResult& result : contents.results)
    for (const Json& claim : result.facts["claims"]) {
      text += fmt::format("| {} | {} |", claim["claim"].get<std::string>(),
                          claim["statement"].get<std::string>());
      for (const std::string& reading : readings) {
        const std::string verdict = claim["verdicts"].value(reading, "");
        text += verdict == "refuted" ? " **refuted** |" : fmt::format(" {} |", verdict);
      }
      text += "\n";
    }
  return text;
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
  for (const auto& [key, value] : values) boost::replace_all(text, key, value);
  return text;
}

}  // namespace bristle::archive
