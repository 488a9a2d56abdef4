#include "archive/gather.hpp"

#include "archive/citation.hpp"
#include "archive/readme.hpp"
#include "util/git.hpp"
#include "archive/result_facts.hpp"
#include "experiment/experiment.hpp"
#include "util/error.hpp"
#include "results/journal.hpp"
#include "util/sha.hpp"
#include "results/writer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace bristle {
namespace fs = std::filesystem;
namespace {

std::string read_file(const std::string& path, const std::string& remedy) {
  std::ifstream in(path, std::ios::binary);
  if (!in || fs::is_directory(path)) throw InputError(fmt::format("{}: cannot be read; {}", path, remedy));
  return {std::istreambuf_iterator<char>(in), {}};
}

// A line of `git status`, "?? name".
std::string without_blanks(const std::string& line) { return line.substr(line.find_first_not_of(' ')); }

class Gatherer {
 public:
  explicit Gatherer(const ArchiveOptions& options) : options_(options), repository_(options.source) {}

  Gathered run() {
    check_program();
    Contents& contents = out_.contents;
    contents.commit = repository_.commit();
    contents.citation = dataset_citation(software_, contents.commit);
    for (const char* folder : {"experiments", "reference", "docs", "LICENSE"})
      for (const std::string& name : repository_.files(folder))
        contents.payload[name] = read_file(in_source(name), "git status shows why");
    add_results();
    contents.source = fmt::format("source/bristle-{}.tar", contents.commit);
    contents.payload[contents.source] = repository_.source(fmt::format("bristle-{}/", contents.commit));
    std::vector<std::string> doubts;
    for (const auto& [what, places] : doubts_)
      doubts.push_back(fmt::format("{} {}", fmt::join(places, ", "), what));
    contents.draft = fmt::format("{}", fmt::join(doubts, "; "));
    contents.payload["CITATION.cff"] = citation_text(contents.citation);
    contents.payload["README.md"] = archive_readme(contents);
    contents.payload[kCrateFile] = crate_text(contents);
    out_.time = repository_.time();
    return std::move(out_);
  }

 private:
  std::string in_source(const std::string& name) const { return (fs::path(options_.source) / name).string(); }

  // What keeps an archive from being traced to its origin: refused, or on record in a draft.
  void doubt(const std::string& place, const std::string& what, const std::string& remedy) {
    if (!options_.allow_dirty)
      throw InputError(
          fmt::format("{} {}; {} (--allow-dirty archives it all the same, as a draft)", place, what, remedy));
    doubts_[what].push_back(place);
  }

  void check_program() {
    const std::string file = in_source("CITATION.cff");
    try {
      software_ = parse_citation(read_file(file, "an archive needs it"));
    } catch (const BadArchive& e) {
      throw InputError(fmt::format("{}: {}", file, e.what()));
    }
    for (const char* key : {"title", "version", "date-released", "license", "authors"})
      if (!software_.contains(key))
        throw InputError(fmt::format("{}: {} is missing; an archive needs it", file, key));
    out_.version = software_["version"];
    if (out_.version != options_.version)
      throw InputError(
          fmt::format("{}: version {}, but this program is {}; `make build` builds the one that is there",
                      file, out_.version, options_.version));
    if (const std::string changes = repository_.changes(); !changes.empty())
      doubt(fmt::format("the work tree ({})", without_blanks(changes.substr(0, changes.find('\n')))),
            "differs from its commit", "commit or stash first, `git status` shows all");
    else if (options_.commit != repository_.commit())
      doubt(fmt::format("this program, of commit {},", options_.commit),
            "was not built from the source archived", "`make build` builds that");
  }

  void add_results() {
    std::vector<Experiment> experiments;
    for (const std::string& name : repository_.files("experiments"))
      if (fs::path(name).parent_path() == "experiments" && fs::path(name).extension() == ".json")
        if (Experiment e = load_experiment(in_source(name), {}); !e.figure.empty())
          experiments.push_back(std::move(e));
    const auto exists = [&](const Experiment& e) { return fs::exists(result_path(e)); };
    if (std::none_of(experiments.begin(), experiments.end(), exists))
      throw InputError(
          fmt::format("{}: there are no results of the figures' experiments; `make figures` computes them",
                      options_.results));
    for (const Experiment& experiment : experiments) add_result(experiment);
    check_findings();
  }

  std::string result_path(const Experiment& e) const {
    return (fs::path(options_.results) / (e.name + ".h5")).string();
  }

  void add_result(const Experiment& experiment) {
    const std::string path = result_path(experiment);
    if (!fs::exists(path))
      throw InputError(fmt::format("{}: no such file: the result of {} is missing; `make {}` computes it",
                                   path, experiment.path, experiment.name));
    const ResultReader result(path);
    check_current(result, experiment);
    ArchivedResult archived{
        "results/" + experiment.name + ".h5", chain(experiment.path), {}, result_facts(result)};
    check_origin(path, archived.facts["provenance"]);
    out_.contents.payload[archived.file] = read_file(path, "");
    for (const char* suffix : {".pdf", ".png"}) add_figure(path, experiment.name + suffix, archived);
    out_.contents.results.push_back(std::move(archived));
  }

  void check_current(const ResultReader& result, const Experiment& experiment) const {
    const auto refuse = [&](const std::string& what) {
      throw InputError(
          fmt::format("{}: {}; `make {}` computes it anew", result.path(), what, experiment.name));
    };
    if (result.text("tier") != "full")
      refuse(fmt::format("is of the {} tier, not the full one", result.text("tier")));
    if (const double made = h5::read_number_attribute(result.file(), "numerics_version");
        made != kNumericsVersion)
      refuse(fmt::format("is of numerics_version {}, this program is of {}", made, kNumericsVersion));
    if (result.text("inputs_sha256") != inputs_sha256(experiment.document))
      refuse(fmt::format("is out of date: {} has changed since", experiment.path));
    if (result.experiment() != experiment.document)
      refuse(fmt::format("is out of date: title, notes or checks of {} have changed since", experiment.path));
    if (payload_sha256(result.file()) != result.text("payload_sha256"))
      refuse("is damaged: its numbers are not those of payload_sha256");
  }

  void check_origin(const std::string& path, const Json& provenance) {
    for (const char* key : {"version", "commit", "started", "finished", "command_line"})
      if (provenance.value(key, "").empty())
        throw InputError(
            fmt::format("{}: /provenance lacks {}; only what `bristle run` wrote is archived", path, key));
    const std::string by = provenance.value("points_commits", provenance["commit"]);
    std::istringstream commits(fmt::format("{} {}", provenance["commit"].get<std::string>(), by));
    for (std::string commit; commits >> commit;) {
      if (commit.back() == ',') commit.pop_back();
      const std::string place = fmt::format("{} (commit {})", path, commit);
      const std::string remedy = "commit, then compute it anew by `bristle run --force`";
      if (is_dirty(commit)) return doubt(place, "was computed by a program with uncommitted changes", remedy);
      if (!repository_.follows(commit))
        return doubt(place, "was computed by a program that is not in this commit's history", remedy);
    }
  }

  void add_figure(const std::string& result, const std::string& name, ArchivedResult& archived) {
    const std::string path = (fs::path(options_.figures) / name).string();
    if (!fs::exists(path)) throw InputError(fmt::format("{}: no such file; `make figures` draws it", path));
    if (fs::last_write_time(path) < fs::last_write_time(result))
      throw InputError(fmt::format("{}: is older than {}; `make figures` draws it anew", path, result));
    archived.figures.push_back("figures/" + name);
    out_.contents.payload[archived.figures.back()] = read_file(path, "");
  }

  // The experiment's files, those that it extends first.
  std::vector<std::string> chain(const std::string& path) const {
    std::vector<std::string> files;
    const Json json = read_json_file(path);
    if (json.contains("extends"))
      files = chain(
          (fs::path(path).parent_path() / json["extends"].get<std::string>()).lexically_normal().string());
    files.push_back(fs::path(path).lexically_relative(options_.source).lexically_normal().string());
    return files;
  }

  // docs/findings.md names the payload that each of its sections is of.
  void check_findings() {
    const auto page = out_.contents.payload.find("docs/findings.md");
    if (page == out_.contents.payload.end()) return;
    for (const ArchivedResult& result : out_.contents.results)
      if (page->second.find(result.facts["payload_sha256"].get<std::string>().substr(0, 16)) ==
          std::string::npos)
        return doubt("docs/findings.md", fmt::format("is of another result than {}", result.file),
                     "run `make findings` and commit the page");
  }

  const ArchiveOptions& options_;
  Repository repository_;
  Json software_;
  std::map<std::string, std::vector<std::string>> doubts_;  // by what is in doubt
  Gathered out_;
};

}  // namespace

Gathered gather(const ArchiveOptions& options) { return Gatherer(options).run(); }

}  // namespace bristle
