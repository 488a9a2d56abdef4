#include "archive/build.hpp"

#include "archive/citation.hpp"
#include "archive/contents.hpp"
#include "archive/result_facts.hpp"
#include "archive/verify.hpp"
#include "assumptions/assumptions.hpp"
#include "experiment/experiment.hpp"
#include "json/json.hpp"
#include "results/digest.hpp"
#include "results/journal.hpp"
#include "results/version.hpp"
#include "util/error.hpp"
#include "util/file.hpp"
#include "util/git.hpp"
#include "util/sha.hpp"
#include "util/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <filesystem>
#include <nlohmann/json.hpp>

namespace bristle::archive {
namespace fs = std::filesystem;
namespace {

// Collects the contents of the archive.
class Gatherer {
 public:
  explicit Gatherer(const ArchiveOptions& options)
      : options_(options),
        repository_(options.source, "--source " + options.source,
                    "an archive contains the source of its commit") {}

  // Refuses what run() would refuse whatever the missing results, figures and pages will be.
  void check_ahead() {
    check_program();
    for (const Experiment& experiment : archived_experiments())
      if (const std::string path = result_path(experiment); results::up_to_date(path, experiment))
        check_origin(path, Json(results::ResultReader(path).provenance()));
  }

  Contents run() {
    check_program();
    Files payload;
    for (const char* folder : {"experiments", "reference", "docs", "LICENSE", "LICENSE-DATA"})
      for (const std::string& name : repository_.files(folder)) payload[name] = read_file(in_source(name));
    const std::string commit = repository_.commit();
    payload[source_file(commit)] = repository_.source_archive(fmt::format("bristle-{}/", commit));
    const auto facts = add_results(payload);
    auto figures = facts;  // the page lists claims, which studies do not have
    std::erase_if(figures, [](const auto& one) { return one.second["figure"] == ""; });
    if (full()) {  // the page and the matrix are of the full tier
      check_page("docs/findings.md", payload, figures, "make findings");
      add_matrix("assumptions", payload);
    }
    add_report(payload, facts);
    std::vector<std::string> reasons;
    for (const auto& [what, places] : untraceable_)
      reasons.push_back(fmt::format("{} {}", fmt::join(places, ", "), what));
    try {
      return describe(std::move(payload), facts, commit, repository_.commit_time(),
                      fmt::format("{}", fmt::join(reasons, "; ")));
    } catch (const MalformedError& e) {
      throw InputError(e.what());
    }
  }

 private:
  bool full() const { return options_.tier == "full"; }
  // Returns the call of a target of the Makefile for the results of this tier.
  std::string make(const std::string& target) const {
    return fmt::format("make {}{}", target, full() ? "" : " TIER=" + options_.tier);
  }
  std::string in_source(const std::string& name) const { return (fs::path(options_.source) / name).string(); }

  // Throws InputError for contents that cannot be traced to their origin, or with allow_dirty records the
  // reason for the draft.
  void refuse_or_record(const std::string& place, const std::string& what, const std::string& remedy) {
    if (!options_.allow_dirty)
      throw InputError(fmt::format("{} {}; {} (--allow-dirty archives it as a draft)", place, what, remedy));
    untraceable_[what].push_back(place);
  }

  void check_program() {
    if (!repository_.is_top())
      throw InputError(fmt::format("--source {}: not the top folder of its repository", options_.source));
    const std::string file = in_source("CITATION.cff"), text = read_file(file);
    std::string version;
    try {
      version = dataset_citation(parse_citation(text), "")["version"];
    } catch (const MalformedError& e) {
      throw InputError(fmt::format("{}: {}", file, e.what()));
    }
    if (version != options_.version)
      throw InputError(fmt::format("{}: version {}, but this program is {}; build it again with `make build`",
                                   file, version, options_.version));
    if (const std::string changes = repository_.changes(); !changes.empty()) {
      const std::string first = changes.substr(0, changes.find('\n'));
      refuse_or_record(fmt::format("the work tree ({})", first.substr(first.find_first_not_of(' '))),
                       "differs from its commit", "commit or stash first; `git status` lists the changes");
    } else if (options_.commit != repository_.commit())
      refuse_or_record(fmt::format("this program, of commit {},", options_.commit),
                       "was not built from the archived source", "build it again with `make build`");
    if (!full()) untraceable_[fmt::format("are of the {} tier", options_.tier)].emplace_back("the results");
  }

  std::vector<Experiment> archived_experiments() const {
    std::vector<Experiment> experiments;
    for (const std::string& name : json_files("experiments"))
      if (Experiment e = experiment::load_experiment(name, {{}, options_.tier});
          !e.figure.empty() || is_study(e))
        experiments.push_back(std::move(e));
    return experiments;
  }

  // Adds results and figures; returns the facts of each result by its file.
  std::map<std::string, Json> add_results(Files& payload) {
    const std::vector<Experiment> experiments = archived_experiments();
    const auto exists = [&](const Experiment& e) { return fs::exists(result_path(e)); };
    if (std::none_of(experiments.begin(), experiments.end(), exists))
      throw InputError(fmt::format("{}: there are no results of the figures' experiments; `{}` computes them",
                                   options_.results, make("figures")));
    std::map<std::string, Json> facts;
    for (const Experiment& experiment : experiments)
      facts["results/" + experiment.name + ".h5"] = add_result(experiment, payload);
    return facts;
  }

  // Returns the files NAME.json under version control in a folder, but not in its subfolders.
  std::vector<std::string> json_files(const std::string& folder) const {
    std::vector<std::string> files;
    for (const std::string& name : repository_.files(folder))
      if (fs::path(name).parent_path() == folder && fs::path(name).extension() == ".json")
        files.push_back(in_source(name));
    return files;
  }

  // Returns true if the experiment is a study: no figure of the paper, but with a module that draws it.
  bool is_study(const Experiment& e) const {
    return !repository_.files(fmt::format("python/bristle/figures/{}.py", e.name)).empty();
  }

  std::string result_path(const Experiment& e) const {
    return (fs::path(options_.results) / (e.name + (full() ? "" : "-" + options_.tier) + ".h5")).string();
  }

  Json add_result(const Experiment& experiment, Files& payload) {
    const std::string path = result_path(experiment);
    if (!fs::exists(path))
      throw InputError(fmt::format("{}: no such file: the result of {} is missing; `{}` computes it", path,
                                   experiment.path, make(experiment.name)));
    const results::ResultReader result(path);
    result.require_intact();
    check_current(result, experiment);
    Json facts = result_facts(result);
    check_origin(path, facts["provenance"]);
    payload["results/" + experiment.name + ".h5"] = read_file(path);
    const std::string digest = facts["payload_sha256"];
    const std::string remedy = fmt::format("`{}` draws it", make(experiment.name));
    const auto add = [&](const std::string& name, const std::string& remedy) {
      add_figure(name, path, digest, remedy, payload);
    };
    for (const char* suffix : {".pdf", ".png"}) add(experiment.name + suffix, remedy);
    for (const auto& entry : fs::directory_iterator(options_.figures)) {  // further pages: NAME-*
      const std::string figure = entry.path().filename().string();
      if (figure.starts_with(experiment.name + "-") && (figure.ends_with(".pdf") || figure.ends_with(".png")))
        add(figure, "remove it, and " + remedy);
    }
    return facts;
  }

  // Adds the plot `name` of the file `result`, if the plot's metadata has this payload digest of the result.
  // Times of files are not compared, because a copy changes them. remedy: the command that draws the plot
  void add_figure(const std::string& name, const std::string& result, const std::string& digest,
                  const std::string& remedy, Files& payload) const {
    const std::string path = (fs::path(options_.figures) / name).string();
    if (!fs::exists(path)) throw InputError(fmt::format("{}: no such file; {}", path, remedy));
    const std::string& bytes = payload["figures/" + name] = read_file(path);
    if (bytes.find(digest) == std::string::npos)
      throw InputError(
          fmt::format("{}: was not made from {} as it is now, whose payload digest it lacks; {} again", path,
                      result, remedy));
  }

  void check_current(const results::ResultReader& result, const Experiment& experiment) const {
    const auto refuse = [&](const std::string& what) {
      throw InputError(
          fmt::format("{}: {}; `{}` computes it again", result.path(), what, make(experiment.name)));
    };
    if (result.text("tier") != options_.tier)
      refuse(fmt::format("is of the {} tier, not of the {} tier", result.text("tier"), options_.tier));
    if (const long made = result.integer("numerics_version"); made != results::kNumericsVersion)
      refuse(
          fmt::format("has numerics_version {}, but this program has {}", made, results::kNumericsVersion));
    if (result.text("inputs_sha256") != results::inputs_sha256(*experiment.document))
      refuse(fmt::format("is out of date: {} has changed since", experiment.path));
    if (results::without_trials(result.experiment()) != results::without_trials(*experiment.document))
      refuse(fmt::format("is out of date: title, notes or checks of {} have changed since", experiment.path));
  }

  void check_origin(const std::string& path, const Json& provenance) {
    for (const char* key : {"version", "commit", "started", "finished", "command_line"})
      if (provenance.value(key, "").empty())
        throw InputError(fmt::format(
            "{}: /provenance lacks {}; only results of `bristle run` can be archived", path, key));
    std::vector<std::string> commits = split_list(provenance.value("points_commits", ""));
    commits.insert(commits.begin(), provenance["commit"].get<std::string>());
    for (const std::string& commit : commits)
      if (!check_commit(
              path, commit,
              fmt::format("compute it again with `bristle run {0} --force -o {0}`", shell_quoted(path))))
        return;
  }

  // Returns true if the commit of the program that wrote the file belongs to the archived history; otherwise
  // calls refuse_or_record().
  bool check_commit(const std::string& path, const std::string& commit, const std::string& remedy) {
    const bool dirty = results::is_dirty(commit);
    if (!dirty && repository_.descends_from(commit)) return true;
    refuse_or_record(fmt::format("{} (commit {})", path, commit),
                     dirty ? "was computed by a program with uncommitted changes"
                           : "was computed by a program that is not in this commit's history",
                     "commit, then " + remedy);
    return false;
  }

  // Adds the matrix of verdicts under the alternatives of experiments/<name>/.
  void add_matrix(const std::string& name, Files& payload) {
    assumptions::AssumptionsOptions options;
    options.files = json_files("experiments/" + name);
    if (options.files.empty()) return;
    options.experiments = in_source("experiments");
    const std::string path = (fs::path(options_.results) / (name + ".json")).string();
    const auto refuse = [&](const std::string& what) {
      throw InputError(fmt::format("{}: {}; `make {}` computes it", path, what, name));
    };
    if (!fs::exists(path)) refuse("no such file");
    const std::string bytes = read_file(path, kMaxJsonBytes);
    Json facts;
    try {
      facts = checked_matrix_facts(bytes);
      options.tier = facts["tier"];
      options.only = facts["only"].get<std::vector<std::string>>();
    } catch (const MalformedError& e) {
      refuse(e.what());
    } catch (const Json::exception& e) {
      refuse(json_error(e.what()));
    }
    if (facts["numerics_version"] != results::kNumericsVersion)
      refuse(fmt::format("has numerics_version {}, but this program has {}", shown(facts["numerics_version"]),
                         results::kNumericsVersion));
    if (facts["inputs_sha256"] != assumptions::inputs_sha256(options))
      refuse(fmt::format("is out of date: experiments/ or experiments/{}/ have changed since", name));
    check_commit(path, facts["program"].value("commit", ""),
                 fmt::format("remove it and run `make {}`", name));
    payload[fmt::format("results/{}.json", name)] = bytes;
    check_page(fmt::format("docs/{}.md", name), payload, {{path, facts}}, fmt::format("make {}", name));
  }

  // Adds the page that bristle.report writes. The file sources.json beside it has the digests of the page and
  // of the results that it shows.
  void add_report(Files& payload, const std::map<std::string, Json>& facts) {
    if (repository_.files("python/bristle/report").empty()) return;
    const std::string sources = beside_report("sources.json"), brush = beside_report("brush.html");
    const std::string remedy = fmt::format("`{}` writes it", make("report"));
    for (const std::string& path : {options_.report, sources})
      if (!fs::exists(path)) throw InputError(fmt::format("{}: no such file; {}", path, remedy));
    const std::string& page = payload["report/index.html"] = read_file(options_.report);
    const Json made_from = read_json_file(sources);
    if (made_from.value("page_sha256", Json()) != sha256_of(page))
      throw InputError(
          fmt::format("{}: is about another page than {}; {} again", sources, options_.report, remedy));
    for (const auto& [file, of_file] : facts)
      if (made_from.value(JsonPointer("/payload_sha256") / fs::path(file).stem().string(), Json()) !=
          of_file["payload_sha256"])
        throw InputError(
            fmt::format("{}: was not made from {} as it is now; {} again", options_.report, file, remedy));
    if (fs::exists(brush)) payload["report/brush.html"] = read_file(brush);  // to which the report links
  }

  std::string beside_report(const char* name) const {
    return fs::path(options_.report).replace_filename(name).string();
  }

  // Checks that a page of docs/ states the payload digests of the files that it describes; otherwise calls
  // refuse_or_record().
  void check_page(const std::string& name, const Files& payload, const std::map<std::string, Json>& facts,
                  const std::string& command) {
    const auto page = payload.find(name);
    if (page == payload.end()) return;
    for (const auto& [file, of_file] : facts)
      if (page->second.find(of_file["payload_sha256"].get<std::string>().substr(0, 16)) == std::string::npos)
        return refuse_or_record(name, fmt::format("does not describe {}", file),
                                fmt::format("run `{}` and commit the page", command));
  }

  const ArchiveOptions& options_;
  Repository repository_;
  std::map<std::string, std::vector<std::string>> untraceable_;  // places by reason
};

}  // namespace

void check_before_archive(const ArchiveOptions& options) { Gatherer(options).check_ahead(); }

BuiltArchive build_archive(const ArchiveOptions& options) {
  const FileKind kind = {"an archive of bristle", "bristle-", {"/bag-info.txt"}};
  if (!options.output.empty()) require_replaceable(options.output, kind);
  const Contents contents = Gatherer(options).run();
  const std::string folder = folder_of(contents);
  BuiltArchive built;
  built.path = options.output;
  if (built.path.empty())
    built.path = fmt::format("dist/{}{}.tar", folder, options.tier == "full" ? "" : "-" + options.tier);
  built.draft = contents.draft;
  WholeFile out(built.path, kind);
  const std::string bytes = write_tar(in_folder(folder, bag_of(contents)), contents.time);
  out.write(bytes);
  out.close();
  const Verification verified = verify_archive(out.partial());
  if (!verified.problems.empty())
    throw RunError(fmt::format("verification of the new archive failed, nothing was written: {}",
                               verified.problems.front()));
  out.publish();
  built.files = verified.files;
  built.bytes = bytes.size();
  built.sha512 = sha512_of(bytes);
  return built;
}

}  // namespace bristle::archive
