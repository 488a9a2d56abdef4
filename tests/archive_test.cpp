#include "archive/crate.hpp"
#include "archive/rerun.hpp"
#include "util/error.hpp"
#include "small_archive.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <sys/stat.h>

using namespace bristle;
using namespace bristle::testing;
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

// Changes the crate as JSON and says what verification finds.
std::string crate_problem(const std::function<void(Json& crate, Json& root)>& change) {
  return first_problem_after([&](Files& payload) {
    Json crate = Json::parse(payload[kCrateFile]);
    change(crate, crate["@graph"][1]);
    payload[kCrateFile] = crate.dump(1) + "\n";
  });
}

Json& entity(Json& crate, const std::string& id) {
  for (Json& e : crate["@graph"])
    if (e["@id"] == id) return e;
  throw std::runtime_error("no entity " + id);
}

std::string citation_problem(const std::string& from, const std::string& to) {
  return first_problem_after([&](Files& payload) {
    std::string& text = payload["CITATION.cff"];
    const auto at = text.find(from);
    REQUIRE(at != std::string::npos);
    text.replace(at, from.size(), to);
  });
}

std::string refusal(const Release& release) {
  try {
    build_archive(release.options);
  } catch (const InputError& e) {
    CHECK_FALSE(std::filesystem::exists(release.options.output));
    return e.what();
  }
  return "";
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

TEST_CASE("what is archived: results, experiments, references, figures, source, documents, metadata") {
  const Scratch s;
  Files files = read_tar(s.write("a.tar", sound()));
  CHECK_THAT(strip_folder(files), Catch::StartsWith("bristle-"));
  for (const char* name :
       {"bagit.txt", "bag-info.txt", "manifest-sha512.txt", "tagmanifest-sha512.txt", "data/results/small.h5",
        "data/experiments/small.json", "data/experiments/paper.json", "data/reference/small.json",
        "data/figures/small.pdf", "data/figures/small.png", "data/docs/model.md", "data/README.md",
        "data/LICENSE", "data/CITATION.cff", "data/ro-crate-metadata.json"}) {
    CAPTURE(name);
    CHECK(files.count(name) == 1);
  }
  CHECK(files.size() == 16);  // and the source
  CHECK(files["data/README.md"].find("{{") == std::string::npos);
  CHECK_THAT(files["data/README.md"],
             Contains("| x | falls | **refuted** |") || Contains("| x | falls | supported |"));
  const Json crate = Json::parse(files["data/ro-crate-metadata.json"]);
  CHECK(crate["@graph"][0]["about"]["@id"] == "./");
}

TEST_CASE("a repacked archive is the same to the byte") {
  CHECK(repacked(sound(), [](Files&) {}).size() == sound().size());
  CHECK(problems_after([](Files&) {}) == Problems{});
}

TEST_CASE("metadata: what RO-Crate, Process Run Crate and the program's own provenance ask for") {
  for (const char* key :
       {"name", "description", "datePublished", "version", "license", "author", "publisher"}) {
    CAPTURE(key);
    CHECK_THAT(crate_problem([&](Json&, Json& root) { root.erase(key); }),
               Contains(std::string(": ./: ") + key + " is missing"));
  }
  CHECK_THAT(
      crate_problem([](Json& crate, Json&) { crate["@context"] = "https://w3id.org/ro/crate/1.2/context"; }),
      Contains("@context: is not that of RO-Crate 1.1"));
  CHECK_THAT(crate_problem([](Json& crate, Json&) { entity(crate, kCrateFile).erase("conformsTo"); }),
             Contains("conformsTo is not https://w3id.org/ro/crate/1.1"));
  CHECK_THAT(crate_problem([](Json&, Json& root) { root["version"] = "9.9.9"; }),
             Contains("version is \"9.9.9\", in CITATION.cff"));
  CHECK_THAT(crate_problem([](Json& crate, Json&) { entity(crate, "#run-small").erase("instrument"); }),
             Contains("instrument is missing"));
  CHECK_THAT(crate_problem(
                 [](Json& crate, Json&) { entity(crate, "#run-small")["endTime"] = "2020-01-01T00:00:00Z"; }),
             Contains("#run-small: says \"2020-01-01T00:00:00Z\", the /provenance of results/small.h5"));
  CHECK_THAT(crate_problem([](Json& crate, Json&) { entity(crate, "LICENSE")["sha512"] = "00"; }),
             Contains("LICENSE: sha512 is not the file's"));
  CHECK_THAT(crate_problem([](Json&, Json& root) { root["hasPart"].erase(0); }),
             Contains("hasPart lacks CITATION.cff"));
  CHECK_THAT(crate_problem([](Json& crate, Json&) {
               crate["@graph"].push_back({{"@id", "results/none.h5"}, {"@type", "File"}});
             }),
             Contains("results/none.h5: is described, but there is no such file"));
  CHECK_THAT(crate_problem([](Json& crate, Json&) { crate["@graph"].push_back("nonsense"); }),
             Contains("has no @id"));
  CHECK_THAT(crate_problem([](Json& crate, Json&) { crate["@graph"] = 7; }), Contains("is not a list"));
}

TEST_CASE("metadata that is no JSON, nested without end or contradicts itself is refused, not followed") {
  const auto with = [](const std::string& text) {
    return first_problem_after([&](Files& payload) { payload[kCrateFile] = text; });
  };
  CHECK_THAT(with("{"), Contains("ro-crate-metadata.json: not JSON"));
  CHECK_THAT(with(std::string(100000, '[')), Contains("nested"));
  CHECK_THAT(with(R"({"@graph": [], "@graph": []})"), Contains("appears twice"));
  CHECK_THAT(with("[]"), Contains("ro-crate-metadata.json: not a JSON object"));
}

TEST_CASE("a citation is one of a dataset in CFF 1.2.0") {
  CHECK_THAT(citation_problem("type: \"dataset\"", "type: \"software\""),
             Contains("type: \"software\" is not dataset"));
  CHECK_THAT(citation_problem("cff-version: \"1.2.0\"", "cff-version: \"1.3.0\""), Contains("is not 1.2.0"));
  CHECK_THAT(citation_problem("license:", "licence:"),
             Contains("licence: is no key") || Contains("license: is missing"));
  CHECK_THAT(citation_problem("date-released: \"20", "date-released: \"3 of 20"), Contains("is not a date"));
  CHECK_THAT(citation_problem("authors:\n  - name", "authors:\n  - nom"), Contains("authors: is not a list"));
  CHECK_THAT(citation_problem("message:", "message: ["), Contains("CITATION.cff: not YAML"));
  CHECK_THAT(citation_problem("keywords:", "keywords: &a [*a]\nmore:"), Contains("CITATION.cff"));
}

TEST_CASE("a result that does not fit its digests is found behind manifests that fit") {
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
             Contains("data/results/small.h5: its numbers have the digest"));
  CHECK_THAT(changed([](const std::string& path) {
               h5::write_attribute(h5::open_file(path, true), "experiment", "{}");
             }),
             Contains("does not match the attribute experiment_sha256"));
  CHECK_THAT(changed([](const std::string& path) {
               h5::write_attribute(h5::open_file(path, true), "tier", "smoke");
             }),
             Contains("tier \"smoke\""));
  CHECK_THAT(changed([](const std::string& path) { std::ofstream(path) << "no HDF5"; }),
             Contains("not an HDF5 file"));
}

TEST_CASE("points computed again: those that the seed draws, the same bits or not") {
  const Scratch s;
  const Verification v = verify_bytes(s, sound());
  const auto points = [&](std::uint64_t seed, std::size_t count) {
    std::vector<std::string> places;
    rerun(v, count, seed, [&](const Rerun& r) {
      CHECK(r.file == "data/results/small.h5");
      CHECK_FALSE(r.different.empty());  // the small result's numbers are made up
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
                    Contains(fmt::format("numerics_version {}, but this program has {}",
                                         kNumericsVersion + 1, kNumericsVersion)));
}

TEST_CASE("what cannot be cited is not archived: each refusal names the file and the remedy") {
  const Release r;
  SECTION("no results") {
    std::filesystem::remove(r.result());
    CHECK_THAT(refusal(r), Contains("there are no results") && Contains("make figures"));
  }
  SECTION("a figure is missing, or older than its result") {
    std::filesystem::remove(r.s.path("figures/small.png"));
    CHECK_THAT(refusal(r), Contains("figures/small.png: no such file; `make figures`"));
    r.compute();
    std::filesystem::last_write_time(r.s.path("figures/small.pdf"),
                                     std::filesystem::last_write_time(r.result()) - std::chrono::seconds(9));
    CHECK_THAT(refusal(r), Contains("small.pdf: is older than"));
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
    CHECK_THAT(refusal(r), Contains("is damaged"));
  }
  SECTION("another version than the program's") {
    const_cast<Release&>(r).options.version = "9.9.9";
    CHECK_THAT(refusal(r), Contains("but this program is 9.9.9"));
  }
  SECTION("no repository") {
    std::filesystem::remove_all(r.s.path(".git"));
    CHECK_THAT(refusal(r), Contains("not a git repository"));
  }
}

TEST_CASE("what cannot be traced to a commit is refused, or a draft that says so") {
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

TEST_CASE("an output that cannot be written is refused, and nothing is left behind") {
  Release r;
  r.options.output = "/proc/nowhere/a.tar";
  CHECK_THROWS_WITH(build_archive(r.options), Contains("-o /proc/nowhere/a.tar: cannot be written"));
  r.options.output = r.s.path("docs");
  CHECK_THROWS_WITH(build_archive(r.options), Contains("is a folder"));
  CHECK_FALSE(std::filesystem::exists(r.s.path("docs.partial")));
}
