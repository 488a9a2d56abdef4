#include "archive/contents.hpp"

#include "archive/citation.hpp"
#include "archive/crate.hpp"
#include "archive/result_facts.hpp"
#include "util/error.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

namespace bristle::archive {
namespace {

const std::string& file_of(const Files& payload, const std::string& name) {
  const auto found = payload.find(name);
  if (found == payload.end()) throw MalformedError(fmt::format("data/{}: is missing", name));
  return found->second;
}

ArchivedResult archived_result(const Files& payload, const std::string& file, const Json& facts) {
  const std::string name = facts["name"];
  ArchivedResult result{file, experiment_chain(payload, fmt::format("experiments/{}.json", name)), {}, facts};
  for (const char* extension : {"pdf", "png"}) {
    result.figures.push_back(fmt::format("figures/{}.{}", name, extension));
    file_of(payload, result.figures.back());
  }
  for (const auto& [further, bytes] : payload)
    if (further.starts_with(fmt::format("figures/{}-", name))) result.figures.push_back(further);
  return result;
}

Json citation_of(const Contents& contents) {
  const std::string name = fmt::format("bristle-{}/CITATION.cff", contents.commit);
  try {
    return dataset_citation(parse_citation(file_in_tar(file_of(contents.payload, contents.source), name)),
                            contents.commit);
  } catch (const MalformedError& e) {
    throw MalformedError(fmt::format("data/{}: {}: {}", contents.source, name, e.what()));
  }
}

}  // namespace

std::string folder_of(const Contents& contents) {
  return "bristle-" + contents.citation["version"].get<std::string>();
}

Files bag_of(const Contents& contents) {
  const Json& citation = contents.citation;
  const Json& author = citation["authors"][0];
  BagInfo info = {{"Source-Organization", author.value("name", author.value("family-names", ""))},
                  {"External-Description", citation["title"]},
                  {"Bagging-Date", fmt::format("{:%Y-%m-%d}", fmt::gmtime(contents.time))},
                  {"Bag-Software-Agent", "bristle " + citation["version"].get<std::string>()},
                  {"Source-Date-Epoch", fmt::format("{}", long(contents.time))}};
  if (!contents.draft.empty()) info.push_back({"Draft", contents.draft});
  return make_bag(contents.payload, info);
}

std::string source_file(const std::string& commit) { return fmt::format("source/bristle-{}.tar", commit); }

std::vector<std::string> experiment_chain(const Files& payload, const std::string& file) {
  std::vector<std::string> files{file};
  try {
    while (true) {
      const Json json = parse_untrusted(file_of(payload, files.front()));
      if (!json.contains("extends")) return files;
      const auto parent =
          std::filesystem::path(files.front()).parent_path() / json["extends"].get<std::string>();
      const std::string name = parent.lexically_normal().string();
      if (std::count(files.begin(), files.end(), name))
        throw MalformedError(fmt::format("data/{}: \"extends\" has a cycle", name));
      files.insert(files.begin(), name);
    }
  } catch (const Json::exception& e) {
    throw MalformedError(fmt::format("data/{}: {}", files.front(), json_error(e.what())));
  }
}

Contents describe(Files payload, const std::map<std::string, Json>& facts, const std::string& commit,
                  std::time_t time, const std::string& draft) {
  Contents contents;
  contents.payload = std::move(payload);
  contents.commit = commit;
  contents.source = source_file(commit);
  contents.time = time;
  contents.draft = draft;
  contents.citation = citation_of(contents);
  for (const char* license : {"LICENSE", "LICENSE-DATA"}) file_of(contents.payload, license);
  for (const auto& [file, of_result] : facts)
    contents.results.push_back(archived_result(contents.payload, file, of_result));
  contents.payload["CITATION.cff"] = citation_text(contents.citation);
  contents.payload["README.md"] = archive_readme(contents);
  contents.payload[kCrateFile] = crate_text(contents);
  return contents;
}

}  // namespace bristle::archive
