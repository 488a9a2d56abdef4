#include "archive/gather.hpp"

#include "archive/citation.hpp"
#include "archive/result_facts.hpp"
#include "experiment/experiment.hpp"
#include "results/digest.hpp"
#include "results/journal.hpp"
#include "results/version.hpp"
#include "util/error.hpp"
#include "util/file.hpp"
#include "util/git.hpp"
#include "util/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <filesystem>
#include <nlohmann/json.hpp>

namespace bristle {
namespace fs = std::filesystem;
namespace {

// A line of `git status`, "?? name".
std::string without_blanks(const std::string& line) { return line.substr(line.find_first_not_of(' ')); }

class Gatherer {
 public:
  explicit Gatherer(const ArchiveOptions& options) : options_(options), repository_(options.source, "--source " + options.source, "an archive contains the source of its commit") {}

  Gathered run() {
    check_program();
    Files payload;
    for (const char* folder : {"experiments", "reference", "docs", "LICENSE"})
      for (const std::string& name : repository_.files(folder)) payload[name] = read_file(in_source(name));
    const std::string commit = repository_.commit();
    payload[source_file(commit)] = repository_.source(fmt::format("bristle-{}/", commit));
    const auto facts = add_results(payload);
    check_findings(payload, facts);
    std::vector<std::string> doubts;
    for (const auto& [what, places] : doubts_)
      doubts.push_back(fmt::format("{} {}", fmt::join(places, ", "), what));
    try {
      return {describe(std::move(payload), facts, commit, fmt::format("{}", fmt::join(doubts, "; "))),
              version_, repository_.time()};
    } catch (const MalformedError& e) {
      throw InputError(e.what());
    }
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
    if (!repository_.is_top())
      throw InputError(fmt::format("--source {}: not the top folder of its repository", options_.source));
    const std::string file = in_source("CITATION.cff");
    try {
      version_ = dataset_citation(parse_citation(read_file(file)), "")["version"];
    } catch (const MalformedError& e) {
      throw InputError(fmt::format("{}: {}", file, e.what()));
    }
    if (version_ != options_.version)
      throw InputError(
          fmt::format("{}: version {}, but this program is {}; `make build` builds the one that is there",
                      file, version_, options_.version));
    if (const std::string changes = repository_.changes(); !changes.empty())
      doubt(fmt::format("the work tree ({})", without_blanks(changes.substr(0, changes.find('\n')))),
            "differs from its commit", "commit or stash first, `git status` shows all");
    else if (options_.commit != repository_.commit())
      doubt(fmt::format("this program, of commit {},", options_.commit),
            "was not built from the source archived", "`make build` builds that");
  }

  // Adds results and figures; returns the facts of each result by its file.
  std::map<std::string, Json> add_results(Files& payload) {
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
    std::map<std::string, Json> facts;
    for (const Experiment& experiment : experiments)
      facts["results/" + experiment.name + ".h5"] = add_result(experiment, payload);
    return facts;
  }

  std::string result_path(const Experiment& e) const {
    return (fs::path(options_.results) / (e.name + ".h5")).string();
  }

  Json add_result(const Experiment& experiment, Files& payload) {
    const std::string path = result_path(experiment);
    if (!fs::exists(path))
      throw InputError(fmt::format("{}: no such file: the result of {} is missing; `make {}` computes it",
                                   path, experiment.path, experiment.name));
    const ResultReader result(path);
    check_current(result, experiment);
    Json facts = result_facts(result);
    check_origin(path, facts["provenance"]);
    payload["results/" + experiment.name + ".h5"] = read_file(path);
    for (const char* suffix : {".pdf", ".png"}) add_figure(path, experiment.name + suffix, payload);
    return facts;
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
    if (result.text("inputs_sha256") != inputs_sha256(*experiment.document))
      refuse(fmt::format("is out of date: {} has changed since", experiment.path));
    if (result.experiment() != *experiment.document)
      refuse(fmt::format("is out of date: title, notes or checks of {} have changed since", experiment.path));
    if (payload_sha256(result.file()) != result.text("payload_sha256"))
      refuse("is damaged: its numbers are not those of payload_sha256");
  }

  void check_origin(const std::string& path, const Json& provenance) {
    for (const char* key : {"version", "commit", "started", "finished", "command_line"})
      if (provenance.value(key, "").empty())
        throw InputError(
            fmt::format("{}: /provenance lacks {}; only what `bristle run` wrote is archived", path, key));
    std::vector<std::string> commits = split_list(provenance.value("points_commits", ""));
    commits.insert(commits.begin(), provenance["commit"].get<std::string>());
    for (const std::string& commit : commits) {
      const std::string place = fmt::format("{} (commit {})", path, commit);
      const std::string remedy = "commit, then compute it anew by `bristle run --force`";
      if (is_dirty(commit)) return doubt(place, "was computed by a program with uncommitted changes", remedy);
      if (!repository_.follows(commit))
        return doubt(place, "was computed by a program that is not in this commit's history", remedy);
    }
  }

  void add_figure(const std::string& result, const std::string& name, Files& payload) {
    const std::string path = (fs::path(options_.figures) / name).string();
    if (!fs::exists(path)) throw InputError(fmt::format("{}: no such file; `make figures` draws it", path));
    if (fs::last_write_time(path) < fs::last_write_time(result))
      throw InputError(fmt::format("{}: is older than {}; `make figures` draws it anew", path, result));
    payload["figures/" + name] = read_file(path);
  }

  // docs/findings.md names the payload digest of the result that each of its sections describes.
  void check_findings(const Files& payload, const std::map<std::string, Json>& facts) {
    const auto page = payload.find("docs/findings.md");
    if (page == payload.end()) return;
    for (const auto& [file, of_result] : facts)
      if (page->second.find(of_result["payload_sha256"].get<std::string>().substr(0, 16)) == std::string::npos)
        return doubt("docs/findings.md", fmt::format("describes another result than {}", file),
                     "run `make findings` and commit the page");
  }

  const ArchiveOptions& options_;
  Repository repository_;
  std::string version_;
  std::map<std::string, std::vector<std::string>> doubts_;  // places by what is in doubt
};

}  // namespace

Gathered gather(const ArchiveOptions& options) { return Gatherer(options).run(); }

}  // namespace bristle
