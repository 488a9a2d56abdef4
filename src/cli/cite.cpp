#include "cli/commands.hpp"

#include "archive/citation.hpp"
#include "results/journal.hpp"
#include "results/reader.hpp"
#include "run/provenance.hpp"
#include "util/error.hpp"
#include "util/text.hpp"

#include <boost/algorithm/string/case_conv.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <optional>

namespace bristle::cli {

const char* citation_file();  // CITATION.cff

namespace {

std::string people(const Json& authors) {
  std::vector<std::string> names;
  for (const Json& one : authors)
    names.push_back(one.contains("name") ? fmt::format("{{{}}}", one["name"].get<std::string>())
                                         : fmt::format("{}, {}", one["family-names"].get<std::string>(),
                                                       one["given-names"].get<std::string>()));
  return fmt::format("{}", fmt::join(names, " and "));
}

// Prints a BibTeX entry with the fields that are not empty, in their order.
void print_entry(const char* kind, const std::string& key,
                 const std::vector<std::pair<const char*, std::string>>& fields) {
  fmt::print("@{}{{{}", kind, key);
  for (const auto& [name, value] : fields)
    if (!value.empty()) fmt::print(",\n  {} = {{{}}}", name, value);
  fmt::print("\n}}\n");
}

std::string field(const Json& source, const char* key) {
  if (!source.contains(key)) return "";
  return source[key].is_string() ? source[key].get<std::string>() : source[key].dump();
}

// Prints the entry of the program, or of the data of `make archive`.
void print_release(const char* kind, const std::string& key, const Json& citation) {
  print_entry(kind, key,
              {{"author", people(citation["authors"])},
               {"title", "{" + field(citation, "title") + "}"},
               {"version", run::kVersion},
               {"year", field(citation, "date-released").substr(0, 4)},
               {"doi", field(citation, "doi")},
               {"url", field(citation, "repository-code")},
               {"note", fmt::format("commit {}", run::kCommit)}});
}

}  // namespace

int cite_command(const std::string& result) {
  std::optional<results::ResultReader> file;  // read before anything is printed
  if (!result.empty()) file.emplace(result).require_intact();
  const Json software = archive::parse_citation(citation_file());
  const std::string version = run::kVersion;
  print_release("software", "bristle-" + version, software);
  if (const Json data = archive::dataset_citation(software, run::kCommit); data.contains("doi"))
    print_release("misc", "bristle-data-" + version, data);
  for (const Json& reference : software.value("references", Json::array()))
    print_entry(
        "article",
        boost::to_lower_copy(field(reference["authors"][0], "family-names")) + field(reference, "year"),
        {{"author", people(reference["authors"])},
         {"title", "{" + field(reference, "title") + "}"},
         {"journal", field(reference, "journal")},
         {"year", field(reference, "year")},
         {"volume", field(reference, "volume")},
         {"number", field(reference, "issue")},
         {"pages", field(reference, "start") + "--" + field(reference, "end")},
         {"doi", field(reference, "doi")}});
  for (const Json& reference : software.value("references", Json::array()))
    if (!reference.contains("volume") || !reference.contains("doi"))
      write_message(
          "The volume and the DOI of the paper are not among the sources of this program: take them from its "
          "title page.\n");
  if (!file) return kSuccess;
  const auto provenance = file->provenance();
  for (const char* key : {"commit", "finished"})
    if (!provenance.contains(key))
      throw InputError(
          fmt::format("{}: /provenance lacks {}; only results of `bristle run` can be cited", result, key));
  print_entry(
      "misc", "bristle-" + file->text("name"),
      {{"title", "{Result of bristle: " + file->text("title") + "}"},
       {"year", provenance.at("finished").substr(0, 4)},
       {"note", fmt::format("computed by commit {}; SHA-256 of the numbers {}; `bristle info` prints both",
                            provenance.at("commit"), file->text("payload_sha256"))}});
  if (results::is_dirty(provenance.at("commit")))
    write_message(
        fmt::format("{}: was computed by a program with uncommitted changes, or of an unknown commit: nobody "
                    "else can compute it again\n",
                    result));
  return kSuccess;
}

}  // namespace bristle::cli
