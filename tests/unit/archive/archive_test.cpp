#include "archive/citation.hpp"
#include "archive/crate.hpp"
#include "archive/rerun.hpp"
#include "util/error.hpp"
#include "small_archive.hpp"

#include "catch.hpp"
#include <fmt/format.h>
#include <sys/stat.h>

namespace bristle::archive_test {
using namespace testing;
using Catch::Contains;

namespace {

Problems problems_after(const std::function<void(Files&)>& change) {
  const Scratch s;
  return verify_bytes(s, repacked(sound(), change)).problems;
}

std::string first_problem_after(const std::function<void(Files&)>& change) {
  const Problems problems = problems_after(change);
  return problems.empty() ? "" : problems.front();
}

}  // namespace

TEST_CASE("an archive verifies, and equal inputs give equal bytes") {
  const Release release;
  const std::string first = release.build();
  std::filesystem::remove(release.options.output);
  umask(077);
  setenv("TZ", "Asia/Tokyo", 1);
  CHECK(release.build() == first);
  unsetenv("TZ");
  umask(022);
  const Verification v = verify_bytes(release.s, first);
  CHECK(v.problems == Problems{});
  CHECK(v.commit == release.head());
  CHECK(v.results.count("data/results/small.h5") == 1);
  CHECK(v.draft == "");
}

TEST_CASE("an archive contains results, experiments, references, figures, source, documents and metadata") {
  Files files = read_tar(sound());
  CHECK_THAT(strip_folder(files), Catch::StartsWith("bristle-"));
  for (const char* name :
       {"bagit.txt", "bag-info.txt", "manifest-sha512.txt", "tagmanifest-sha512.txt", "data/results/small.h5",
        "data/experiments/small.json", "data/experiments/paper.json", "data/reference/small.json",
        "data/figures/small.pdf", "data/figures/small.png", "data/docs/model.md", "data/README.md",
        "data/LICENSE", "data/LICENSE-DATA", "data/CITATION.cff", "data/ro-crate-metadata.json"}) {
    CAPTURE(name);
    CHECK(files.count(name) == 1);
  }
  CHECK(files.size() == 17);  // including the source
  CHECK(files["data/README.md"].find("{{") == std::string::npos);
  CHECK_THAT(files["data/README.md"],
             Contains("| claim | first check | verdict |") &&
                 (Contains("| x | falls | **refuted** |") || Contains("| x | falls | supported |")));
  const Json crate = Json::parse(files["data/ro-crate-metadata.json"]);
  CHECK(crate["@graph"][0]["about"]["@id"] == "./");
}

TEST_CASE("a repacked archive is the same byte for byte") {
  CHECK(repacked(sound(), [](Files&) {}).size() == sound().size());
  CHECK(problems_after([](Files&) {}) == Problems{});
}

TEST_CASE("README, citation and crate must equal those generated from the other files") {
  for (const char* name : {"README.md", "CITATION.cff", kCrateFile}) {
    CAPTURE(name);
    CHECK_THAT(first_problem_after([&](Files& payload) { payload[name] += "x"; }),
               Contains(std::string("data/") + name + ": line ") &&
                   Contains("is \"x\", but according to the other files of the archive it should be the end "
                            "of the file"));
    CHECK_THAT(first_problem_after([&](Files& payload) { payload.erase(name); }),
               Contains(std::string("data/") + name + ": is missing"));
    CHECK_FALSE(first_problem_after([&](Files& payload) { payload[name] = "[[[["; }).empty());
  }
  CHECK_THAT(first_problem_after([](Files& payload) {
               std::string& text = payload["README.md"];
               text.replace(text.find("| x | falls |"), 5, "| y |");
             }),
             Contains("README.md: line") && Contains("| y | falls"));
  CHECK_THAT(first_problem_after([](Files& payload) { payload["experiments/small.json"] += " "; }),
             Contains("ro-crate-metadata.json: line"));
}

TEST_CASE("a payload from which the metadata cannot be generated is refused") {
  const auto without = [](const std::string& name) {
    return first_problem_after([&](Files& payload) { payload.erase(name); });
  };
  CHECK_THAT(without("experiments/small.json"), Contains("data/experiments/small.json: is missing"));
  CHECK_THAT(without("experiments/paper.json"), Contains("data/experiments/paper.json: is missing"));
  CHECK_THAT(without("figures/small.png"), Contains("data/figures/small.png: is missing"));
  CHECK_THAT(without("results/small.h5"), Contains("data/results: there are no results"));
  const auto with_experiment = [](const std::string& text) {
    return first_problem_after([&](Files& payload) { payload["experiments/small.json"] = text; });
  };
  CHECK_THAT(with_experiment("{"), Contains("not JSON"));
  CHECK_THAT(with_experiment(std::string(100000, '[')), Contains("nested"));
  CHECK_THAT(with_experiment(R"({"extends": 7})"), Contains("data/experiments/small.json: "));
  CHECK_THAT(with_experiment(R"({"extends": "small.json"})"), Contains("has a cycle"));
  const auto with_source = [](const std::function<void(Files&, const std::string& name)>& change) {
    return first_problem_after(
        [&](Files& payload) { change(payload, payload.lower_bound("source/")->first); });
  };
  CHECK_THAT(with_source([](Files& payload, const std::string& name) { payload.erase(name); }),
             Contains("data/source: the source of the commit is missing"));
  CHECK_THAT(with_source([](Files& payload, const std::string& name) { payload[name] = "x"; }),
             Contains("was not created by `git archive` from this commit"));
  CHECK_THAT(with_source([](Files& payload, const std::string&) { payload["source/other"] = "x"; }),
             Contains("data/source/other: is not the source of the commit of the archive"));
  CHECK_THAT(with_source([](Files& payload, const std::string& name) {
               std::string& bytes = payload[name];
               bytes.replace(bytes.find("cff-version:"), 4, "[[[[");
             }),
             Contains("CITATION.cff: not YAML"));
}

TEST_CASE("an incomplete or malformed citation is refused") {
  CHECK_THROWS_WITH(dataset_citation(parse_citation("title: x"), "c"), Contains("version is missing"));
  for (const char* identifiers : {"x", "[x]", "[{type: [doi]}]", "[{type: doi}]", "{type: doi}"}) {
    CAPTURE(identifiers);
    const std::string rest = "title: x\nversion: x\ndate-released: x\nlicense: x\nauthors: []\n";
    CHECK_THROWS_AS(dataset_citation(parse_citation(rest + "identifiers: " + identifiers), "c"),
                    MalformedError);
  }
  CHECK_THROWS_WITH(parse_citation("a: ["), Contains("not YAML"));
  CHECK_THROWS_WITH(parse_citation("a: 1\na: 2"), Contains("the key a appears twice"));
  CHECK_THROWS_WITH(parse_citation("a: \xff"), Contains("UTF-8"));
  CHECK_THROWS_WITH(parse_citation("a: &a [*a]"), Contains("YAML") || Contains("nested"));
}

TEST_CASE("a result that contradicts its digests is found even if the manifests match") {
  const auto changed = [](const std::function<void(const std::string& path)>& change) {
    return first_problem_after([&](Files& payload) {
      const Scratch s;
      const std::string path = s.write("small.h5", payload["results/small.h5"]);
      change(path);
      payload["results/small.h5"] = bytes_of(path);
    });
  };
  CHECK_THAT(changed([](const std::string& path) {
               put(path, "R_x_norm", {1, 1}, 0.123);
             }),
             Contains("data/results/small.h5: payload_sha256 DOES NOT MATCH the numbers"));
  CHECK_THAT(changed([](const std::string& path) {
               h5::write_attribute(h5::open_file(path, true), "experiment", "{}");
             }),
             Contains("experiment_sha256 DOES NOT MATCH the experiment"));
  CHECK_THAT(changed([](const std::string& path) {
               h5::write_attribute(h5::open_file(path, true), "tier", "smoke");
             }),
             Contains("tier \"smoke\""));
  CHECK_THAT(changed([](const std::string& path) { std::ofstream(path) << "no HDF5"; }),
             Contains("not an HDF5 file"));
}

TEST_CASE("rerun: the seed determines the points, and differences are reported") {
  const Scratch s;
  const Verification v = verify_bytes(s, sound());
  const auto points = [&](std::uint64_t seed, std::size_t count) {
    std::vector<std::string> places;
    rerun(v, count, seed, [&](const Rerun& r) {
      CHECK(r.file == "data/results/small.h5");
      CHECK_FALSE(r.different.empty());  // the numbers of the small result are invented
      places.push_back(r.place);
    });
    return places;
  };
  CHECK(points(1, 3) == points(1, 3));
  CHECK(points(1, 4) != points(2, 4));
  auto all = points(1, 100);
  CHECK(all.size() == 6);
  std::sort(all.begin(), all.end());
  CHECK(std::unique(all.begin(), all.end()) == all.end());
  CHECK(all.front() == "k_r = 20, k_theta = 0.3");

  Verification other = v;
  other.results.begin()->second.facts["numerics_version"] = kNumericsVersion + 1;
  CHECK_THROWS_WITH(rerun(other, 1, 1, [](const Rerun&) {}),
                    Contains(fmt::format("numerics_version {}, but this program has {}", kNumericsVersion + 1,
                                         kNumericsVersion)));
}

TEST_CASE("results that are incomplete or out of date are not archived, with file and remedy") {
  const Release r;
  SECTION("no results") {
    std::filesystem::remove(r.result());
    CHECK_THAT(refusal(r), Contains("there are no results") && Contains("make figures"));
  }
  SECTION("a figure is missing, or was drawn from another result, whenever that was") {
    std::filesystem::remove(r.s.path("figures/small.png"));
    CHECK_THAT(refusal(r), Contains("figures/small.png: no such file; `make small`"));
    r.compute();
    std::filesystem::last_write_time(r.s.path("figures/small.pdf"),
                                     std::filesystem::last_write_time(r.result()) - std::chrono::seconds(9));
    r.build();
    std::filesystem::remove(r.options.output);
    r.s.write("figures/small.pdf", "payload_sha256 of another result");
    CHECK_THAT(refusal(r),
               Contains("small.pdf: was not made from") && Contains("`make small` draws it again"));
  }
  SECTION("the smoke tier") {
    r.compute("", "smoke");
    CHECK_THAT(refusal(r), Contains("is of the smoke tier") && Contains("`make small`"));
  }
  SECTION("the experiment has changed since") {
    std::string text = bytes_of(r.s.path("experiments/small.json"));
    r.s.write("experiments/small.json", text.replace(text.find("[10, 100]"), 9, "[10, 101]"));
    r.commit();
    const_cast<Release&>(r).options.commit = r.head();
    CHECK_THAT(refusal(r),
               Contains("small.h5: is out of date: ") && Contains("small.json has changed since"));
  }
  SECTION("another numerics_version") {
    h5::write_attribute(h5::open_file(r.result(), true), "numerics_version", 1L);
    CHECK_THAT(refusal(r), Contains("has numerics_version 1, but this program has"));
  }
  SECTION("numbers that are not those of the digest") {
    put(r.result(), "R_x", {0, 0}, 1);
    CHECK_THAT(refusal(r), Contains("damaged: payload_sha256 DOES NOT MATCH"));
  }
  SECTION("another version than the program's") {
    const_cast<Release&>(r).options.version = "9.9.9";
    CHECK_THAT(refusal(r), Contains("but this program is 9.9.9"));
  }
  SECTION("no repository") {
    std::filesystem::remove_all(r.s.path(".git"));
    CHECK_THAT(refusal(r), Contains("not in a git work tree"));
  }
  SECTION("a repository that GIT_DIR names, and not that of the source") {
    const Release other;
    std::filesystem::remove_all(r.s.path(".git"));
    setenv("GIT_DIR", other.s.path(".git").c_str(), 1);
    const std::string message = refusal(r);
    unsetenv("GIT_DIR");
    CHECK_THAT(message, Contains("not in a git work tree"));
  }
}

TEST_CASE("results without a reproducible commit are refused, or archived as a draft with the reason") {
  Release r;
  std::string reason;
  SECTION("a work tree with changes") {
    r.s.write("docs/new.md", "");
    reason = "the work tree (?? docs/new.md) differs from its commit";
  }
  SECTION("a program with uncommitted changes") {
    r.compute(r.head() + "-dirty");
    reason = "was computed by a program with uncommitted changes";
  }
  SECTION("a commit of another history") {
    r.compute("0123abc");
    reason = "was computed by a program that is not in this commit's history";
  }
  SECTION("a program of another commit") {
    r.options.commit = "0123abc";
    reason = "this program, of commit 0123abc, was not built from the archived source";
  }
  CHECK_THAT(refusal(r), Contains(reason) && Contains("--allow-dirty"));
  r.options.allow_dirty = true;
  const Verification v = verify_bytes(r.s, r.build());
  CHECK(v.problems == Problems{});
  CHECK_THAT(v.draft, Contains(reason));
}

TEST_CASE("an archive of an earlier program is refused with the program to use") {
  CHECK_THAT(first_problem_after([](Files& payload) { payload.erase("LICENSE-DATA"); }),
             Contains("data/LICENSE-DATA: is missing") && Contains("use the program in data/source"));
}

TEST_CASE("an output that cannot be written is refused, and no temporary file remains") {
  Release r;
  r.options.output = "/proc/nowhere/a.tar";
  CHECK_THROWS_WITH(build_archive(r.options), Contains("/proc/nowhere/a.tar: cannot be written"));
  r.options.output = r.s.path("docs");
  CHECK_THROWS_WITH(build_archive(r.options), Contains("is a folder"));
  CHECK_FALSE(std::filesystem::exists(r.s.path("docs.partial")));
}

}  // namespace bristle::archive_test
