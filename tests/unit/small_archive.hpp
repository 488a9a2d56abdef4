#pragma once

#include "archive/build.hpp"
#include "archive/citation.hpp"
#include "archive/verify.hpp"
#include "util/error.hpp"
#include "util/sha.hpp"
#include "small_result.hpp"

#include "catch.hpp"
#include <boost/algorithm/string/replace.hpp>
#include <cstdlib>

// An archive of one small result in a repository of its own, and functions to repack it.
namespace bristle::testing {

struct Release {
  Scratch s;
  ArchiveOptions options;

  // more: writes further files into the repository.
  explicit Release(const std::function<void(const Scratch&)>& more = {}) {
    const std::string root = std::string(BRISTLE_EXPERIMENTS) + "/../";
    for (const char* name : {"LICENSE", "LICENSE-DATA", "experiments/paper.json"})
      s.write(name, bytes_of(root + name));
    s.write("CITATION.cff",
            boost::replace_all_copy(bytes_of(root + "CITATION.cff"), "  - name: The bristle developers",
                                    "  - family-names: Somebody\n    given-names: Somebody\n"
                                    "    affiliation: Somebody\n    orcid: "
                                    "https://orcid.org/0000-0001-2345-6789"));
    s.write("experiments/small.json",
            R"({"extends": "paper.json", "name": "small", "title": "Small", "figure": "9",
      "load": {"R_n": null, "z_0": 0.5}, "orientation": {"sampling": "list", "theta_0_deg": [10, 100]},
      "sweep": {"k_r": {"values": [5, 20]}, "k_theta": {"values": [0.3, 1, 3]}}, "checks": [{"claim": "x",
      "statement": "falls", "predicate": "end_ratio", "variable": "R_x_norm", "along": "k_r", "is": "at_most",
      "threshold": 0.99}]})");
    s.write("reference/small.json", "{}");
    s.write("docs/model.md", "# The model\n");
    s.write(".gitignore", "/results/\n/figures/\n*.tar\n");
    if (more) more(s);
    git("init -q .");
    commit();
    options.source = s.path("");
    options.results = s.path("results");
    options.figures = s.path("figures");
    options.report = s.path("report/index.html");
    options.output = s.path("archive.tar");
    options.version = parse_citation(bytes_of(s.path("CITATION.cff")))["version"];
    options.commit = head();
    compute();
  }

  void git(const std::string& arguments) const {
    REQUIRE(std::system(("git -C " + s.path("") + " " + arguments).c_str()) == 0);
  }
  void commit() const {
    git("add .");
    git("-c user.name=n -c user.email=e commit -q -m m");
  }
  std::string head() const { return bytes_of(s.path(".git/refs/heads/") + branch()).substr(0, 40); }
  std::string branch() const {
    const std::string ref = bytes_of(s.path(".git/HEAD"));
    return ref.substr(16, ref.size() - 17);
  }

  // Writes the result, with invented numbers and the commit `by` as provenance, and its figures.
  void compute(const std::string& by = "", const std::string& tier = "full",
               const std::string& name = "small") const {
    const Experiment experiment = load_experiment(s.path("experiments/" + name + ".json"), {{}, tier});
    std::filesystem::create_directories(s.path("results"));
    ResultWriter writer(experiment, result(name));
    for (std::size_t i = 0; i < experiment.sweep.size(); ++i)
      writer.write(i, record_of(layout_of(experiment.sweep), small_point(i), {}));
    writer.close({{"commit", by.empty() ? head() : by},
                  {"version", options.version},
                  {"started", "2026-01-02T03:04:05Z"},
                  {"finished", "2026-01-02T03:04:06Z"},
                  {"command_line", "bristle run experiments/" + name + ".json"}});
    writer.publish();
    const auto checks = evaluate_checks(ResultReader(result(name)));
    write_checks(result(name), checks);
    for (const char* ending : {".pdf", ".png"})
      s.write("figures/" + name + ending,
              ending + (" payload_sha256 " + ResultReader(result(name)).text("payload_sha256")));
  }
  // Writes a report on the results, as far as an archive looks at it.
  void write_report(const std::vector<std::string>& names) const {
    Json made_from = {{"page_sha256", sha256_of("<html>")}, {"payload_sha256", Json::object()}};
    for (const std::string& name : names)
      made_from["payload_sha256"][name] = ResultReader(result(name)).text("payload_sha256");
    s.write("report/index.html", "<html>");
    s.write("report/sources.json", made_from.dump());
  }
  std::string result(const std::string& name = "small") const { return s.path("results/" + name + ".h5"); }
  std::string build() const { return bytes_of(build_archive(options).path); }
};

inline std::string refusal(const Release& release) {
  try {
    build_archive(release.options);
  } catch (const InputError& e) {
    CHECK_FALSE(std::filesystem::exists(release.options.output));
    return e.what();
  }
  return "(not refused)";
}

inline Verification verify_bytes(const Scratch& s, const std::string& bytes) {
  s.write("verified.tar", bytes);
  return verify_archive(s.path("verified.tar"));
}

// An archive that is built once. Tests use copies.
inline const std::string& sound() {
  static const std::string bytes = Release().build();
  return bytes;
}

// The archive with a changed payload and matching manifests, as made by someone who intends to deceive.
inline std::string repacked(const std::string& archive, const std::function<void(Files&)>& change) {
  Files files = read_tar(archive), payload;
  const std::string folder = strip_folder(files), draft = bag_info(files, "Draft");
  BagInfo info;
  for (const char* label : {"Source-Organization", "External-Description", "Bagging-Date",
                            "Bag-Software-Agent", "Source-Date-Epoch"})
    info.push_back({label, bag_info(files, label)});
  if (!draft.empty()) info.push_back({"Draft", draft});
  for (const auto& [name, bytes] : files)
    if (name.compare(0, 5, "data/") == 0) payload[name.substr(5)] = bytes;
  change(payload);
  return write_tar(in_folder(folder, make_bag(payload, info)),
                   std::stol(bag_info(files, "Source-Date-Epoch")));
}

}  // namespace bristle::testing
