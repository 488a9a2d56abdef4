#include "results/reader.hpp"
#include "archive/citation.hpp"
#include "assumptions/assumptions.hpp"
#include "small_archive.hpp"

#include "catch.hpp"
#include <set>

// What an archive contains beside results of figures: citation, licences, studies, matrices and the report.
namespace bristle::archive_contents_test {
using namespace testing;
using Catch::Contains;

namespace {

// A repository with a study, one file of assumptions and the scripts of the report.
void add_studies(const Scratch& s) {
  s.write("python/bristle/figures/study.py", "");
  s.write("python/bristle/report/__main__.py", "");
  s.write("experiments/study.json", R"({"extends": "small.json", "name": "study", "figure": ""})");
  s.write("experiments/assumptions/one.json", R"({"schema": "bristle-assumption/1", "choice": "V_s",
      "question": "how large", "alternatives": [{"name": "slow", "description": "twice",
                                                 "patch": {"model": {"V_s": 0.02}}}]})");
  s.write(".gitignore", "/results/\n/figures/\n/report/\n*.tar\n");
}

// The matrix of such a repository, as `bristle assumptions` of this commit writes it.
void write_matrix(const Release& release, const std::function<void(Json&)>& change = {}) {
  assumptions::AssumptionsOptions options;
  options.files = {release.s.path("experiments/assumptions/one.json")};
  options.experiments = release.s.path("experiments");
  options.output = release.s.path("results/assumptions.json");
  options.threads = 1;
  options.quiet = true;
  Json matrix = assumptions::matrix_json(assumptions::run_assumptions(options));
  matrix["program"]["commit"] = release.head();
  if (change) change(matrix);
  release.s.write("results/assumptions.json", matrix.dump());
}

std::string archived_study() {
  const Release r(add_studies);
  r.compute("", "full", "study");
  write_matrix(r);
  r.write_report({"small", "study"});
  return r.build();
}

// The entity of a crate with this identifier.
Json entity(const Json& crate, const std::string& id) {
  for (const Json& one : crate["@graph"])
    if (one["@id"] == id) return one;
  FAIL(id + " is not in the crate");
  return {};
}

// All identifiers to which the entities refer.
void add_references(const Json& value, std::set<std::string>& out) {
  if (value.is_object() && value.size() == 1 && value.contains("@id")) out.insert(value["@id"]);
  if (value.is_structured())
    for (const Json& one : value) add_references(one, out);
}

}  // namespace

TEST_CASE("an archive of another tier is a draft that says so") {
  Release r;
  r.options.tier = "smoke";
  CHECK_THAT(refusal(r), Contains("there are no results"));
  r.compute("", "smoke");
  std::filesystem::rename(r.result(), r.result("small-smoke"));
  CHECK(verify_bytes(r.s, r.build()).draft == "the results are of the smoke tier");
}

TEST_CASE("the archive has the licence of the data, the DOI, the paper and its authors") {
  const Release r([](const Scratch& s) {
    std::string text =
        boost::replace_all_copy(bytes_of(s.path("CITATION.cff")), "license: MIT",
                                "license: MIT\ndoi: 10.5281/zenodo.99\nidentifiers:\n  - type: doi\n"
                                "    value: 10.5281/zenodo.12\n    description: the archive");
    s.write("CITATION.cff",
            boost::replace_all_copy(text, "    issue: 4", "    doi: 10.1000/p\n    volume: 7\n    issue: 4"));
  });
  Files files = read_tar(r.build());
  strip_folder(files);
  CHECK_THAT(files["data/README.md"],
             Contains("DOI: <https://doi.org/10.5281/zenodo.12>. Licence of the data: CC-BY-4.0") &&
                 Contains("of the program: MIT (file LICENSE)"));
  const Json citation = parse_citation(files["data/CITATION.cff"]);
  CHECK(citation["license"] == "CC-BY-4.0");
  CHECK(citation["doi"] == "10.5281/zenodo.12");
  CHECK(citation["references"][0]["license"] == "MIT");
  CHECK(citation["references"][0]["doi"] == "10.5281/zenodo.99");

  const Json crate = Json::parse(files["data/ro-crate-metadata.json"]), root = entity(crate, "./");
  CHECK(root["license"]["@id"] == "https://spdx.org/licenses/CC-BY-4.0");
  CHECK(root["identifier"] == "https://doi.org/10.5281/zenodo.12");
  CHECK_THAT(root["keywords"].get<std::string>(), Catch::StartsWith("friction, tribology"));
  CHECK(root["author"] == Json::parse(R"([{"@id": "https://orcid.org/0000-0001-2345-6789"}])"));
  CHECK(entity(crate, root["author"][0]["@id"])["name"] == "Somebody Somebody");
  CHECK(entity(crate, "source/bristle-" + r.head() + ".tar")["license"]["@id"] ==
        "https://spdx.org/licenses/MIT");
  const Json paper = entity(crate, root["citation"][0]["@id"]);
  CHECK(paper["@id"] == "https://doi.org/10.1000/p");
  CHECK(paper["@type"] == "ScholarlyArticle");
  CHECK(paper["pageStart"] == "3099");
  CHECK(entity(crate, paper["author"][2]["@id"])["name"] == "G. Carbone");
  const Json issue = entity(crate, paper["isPartOf"]["@id"]),
             volume = entity(crate, issue["isPartOf"]["@id"]);
  CHECK(issue["issueNumber"] == "4");
  CHECK(volume["volumeNumber"] == "7");
  CHECK(entity(crate, volume["isPartOf"]["@id"])["name"] == "Nonlinear Dynamics");
}

TEST_CASE("identifiers of the crate are unique, and references resolve") {
  Files files = read_tar(archived_study());
  strip_folder(files);
  const Json crate = Json::parse(files["data/ro-crate-metadata.json"]);
  std::set<std::string> defined, referred;
  for (const Json& one : crate["@graph"]) {
    CAPTURE(one["@id"].get<std::string>());
    CHECK(defined.insert(one["@id"]).second);
    add_references(one, referred);
  }
  referred.erase("https://w3id.org/ro/crate/1.1");
  for (const std::string& id : referred) {
    CAPTURE(id);
    CHECK(defined.contains(id));
  }
}

TEST_CASE("studies, matrices and the report are archived, and refused with the command that makes them") {
  Release r(add_studies);
  CHECK_THAT(refusal(r), Contains("results/study.h5: no such file") && Contains("`make study` computes it"));
  r.compute("", "full", "study");
  const std::string matrix = "results/assumptions.json";
  CHECK_THAT(refusal(r), Contains(matrix + ": no such file; `make assumptions` computes it"));
  const auto refused_with = [&](const std::function<void(Json&)>& change) {
    write_matrix(r, change);
    return refusal(r);
  };
  CHECK_THAT(refused_with([](Json& m) { m["schema"] = "bristle-assumptions/1"; }),
             Contains(matrix + ": not a matrix of the schema") && Contains("`make assumptions`"));
  CHECK_THAT(refused_with([](Json& m) { m.erase("inputs_sha256"); }),
             Contains(matrix + ": lacks inputs_sha256: it was written by an earlier version"));
  CHECK_THAT(refused_with([](Json& m) { m["cells"][0]["under"][0][1] = "refuted"; }),
             Contains(matrix + ": payload_sha256 DOES NOT MATCH the content"));
  CHECK_THAT(refused_with([](Json& m) {
               m.erase("cells");
               m["payload_sha256"] = "";
             }),
             Contains(matrix + ": not a matrix: "));
  CHECK_THAT(refused_with([](Json& m) { m["tier"] = 7; }),
             Contains(matrix + ": ") && Contains("must be string"));
  CHECK_THAT(refused_with([](Json& m) { m["numerics_version"] = 1; }),
             Contains(matrix + ": has numerics_version 1, but this program has"));
  CHECK_THAT(
      refused_with([](Json& m) { m["program"]["commit"] = "0123abc"; }),
      Contains("was computed by a program that is not in this commit's history; commit, then remove it"));
  r.s.write(matrix, "{");
  CHECK_THAT(refusal(r), Contains(matrix + ": not JSON"));
  std::filesystem::remove(r.s.path(matrix));
  write_matrix(r);
  CHECK_THAT(refusal(r), Contains("report/index.html: no such file; `make report` writes it"));
  r.write_report({"small"});
  CHECK_THAT(refusal(r), Contains("report/index.html: was not made from results/study.h5 as it is now") &&
                             Contains("`make report` writes it again"));
  r.write_report({"small", "study"});
  r.s.write("report/index.html", "<html> changed");
  CHECK_THAT(refusal(r), Contains("sources.json: is about another page than "));
  r.write_report({"small", "study"});
  r.s.write("report/brush.html", "a brush");

  const Verification v = verify_bytes(r.s, r.build());
  CHECK(v.problems == Problems{});
  CHECK(v.results.contains("data/results/study.h5"));
  Files files = read_tar(bytes_of(r.options.output));
  strip_folder(files);
  CHECK(files.contains("data/report/index.html"));
  CHECK(files["data/report/brush.html"] == "a brush");
  CHECK(files["data/results/assumptions.json"] == bytes_of(r.s.path(matrix)));

  const auto with_page = [&](const std::string& digest) {
    std::filesystem::remove(r.options.output);
    r.s.write("docs/assumptions.md", "Payload digest of the matrix: " + digest);
    r.commit();
    r.options.commit = r.head();
    return refusal(r);
  };
  CHECK_THAT(with_page("0123"), Contains("docs/assumptions.md does not describe ") &&
                                    Contains("assumptions.json; run `make assumptions` and commit the page"));
  const Json document = Json::parse(bytes_of(r.s.path(matrix)));
  CHECK(with_page(document["payload_sha256"].get<std::string>().substr(0, 16)) == "(not refused)");

  // The page on the claims names the figures' results, not those of studies.
  const auto with_findings = [&](const std::string& text) {
    std::filesystem::remove(r.options.output);
    r.s.write("docs/findings.md", text);
    r.commit();
    r.options.commit = r.head();
    return refusal(r);
  };
  CHECK_THAT(with_findings("0123"), Contains("docs/findings.md does not describe results/small.h5"));
  const std::string digest = results::ResultReader(r.s.path("results/small.h5")).text("payload_sha256");
  CHECK(with_findings(digest.substr(0, 16)) == "(not refused)");

  std::filesystem::remove(r.options.output);
  r.s.write("experiments/assumptions/one.json",
            boost::replace_all_copy(bytes_of(r.s.path("experiments/assumptions/one.json")), "0.02", "0.03"));
  r.commit();
  r.options.commit = r.head();
  CHECK_THAT(refusal(r),
             Contains(matrix + ": is out of date: experiments/ or experiments/assumptions/ have changed"));
}

TEST_CASE("a matrix that contradicts its digest or the results is found even if the manifests match") {
  static const std::string archive = archived_study();
  const auto changed = [](const std::function<void(Json&)>& change) {
    const Scratch s;
    const Problems found = verify_bytes(s, repacked(archive,
                                                    [&](Files& payload) {
                                                      Json matrix =
                                                          Json::parse(payload["results/assumptions.json"]);
                                                      change(matrix);
                                                      payload["results/assumptions.json"] = matrix.dump();
                                                    }))
                               .problems;
    return found.empty() ? "" : found.front();
  };
  CHECK_THAT(changed([](Json& m) { m["cells"][0]["under"][0][2] = 0.123; }),
             Contains("data/results/assumptions.json: payload_sha256 DOES NOT MATCH the content"));
  CHECK_THAT(changed([](Json& m) { m["numerics_version"] = 1; }),
             Contains("data/results/assumptions.json: has numerics_version 1, but results/small.h5 has"));
  CHECK_THAT(changed([](Json& m) { m = "x"; }), Contains("data/results/assumptions.json: not a matrix"));
}

}  // namespace bristle::archive_contents_test
