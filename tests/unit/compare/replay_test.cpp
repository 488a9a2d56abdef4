#include "claims/check.hpp"
#include "compare/replay.hpp"
#include "shards.hpp"

#include "catch.hpp"

namespace bristle::replay_test {
using namespace testing;
using Catch::EndsWith;

namespace {

// Every point computed alone, from the document that a result stores, has the input of the point of the
// sweep.
void require_same_points(const Experiment& all) {
  const Experiment stored = experiment::stored_experiment(*all.document, all.tier, "stored");
  REQUIRE(stored.sweep.size() == all.sweep.size());
  for (std::size_t i = 0; i < all.sweep.size(); ++i) {
    const Json document = experiment::document_of_point(stored, i);
    const Experiment one = experiment::stored_experiment(document, all.tier, "one point");
    REQUIRE(one.sweep.size() == 1);
    CHECK(one.sweep.key(0) == all.sweep.key(i));
    CHECK(claims::read_checks(one).empty());
  }
}

Experiment of(const Scratch& s, const std::string& text, const json::DocumentOptions& options = {}) {
  s.write("paper.json", bytes_of(std::string(BRISTLE_EXPERIMENTS) + "/paper.json"));
  return load_experiment(s.write("e.json", R"({"extends": "paper.json", "name": "e",)" + text + "}"),
                         options);
}

}  // namespace

TEST_CASE("replay: a point alone has the input of the same point of any experiment") {
  const Scratch s;
  SECTION("axes with numbers and words, a tier with take, checks") {
    const std::string text =
        R"("sweep": {"friction": {"values": ["coulomb", "nss"]}, "R_n": {"logspace": [1, 3, 7]}},
      "load": {"R_n": null}, "tiers": {"smoke": {"sweep": {"R_n": {"take": [1, 4]}}}}, "locate_jumps": "R_n",
      "checks": [{"claim": "x", "statement": "falls", "predicate": "end_ratio", "variable": "R_x_norm",
                  "along": "R_n", "is": "at_most", "threshold": 0.99}])";
    require_same_points(of(s, text));
    require_same_points(of(s, text,
                           {{"/model/k_phi=2.5", R"(/load={"z_0":0.5})", "/sweep/R_n=null",
                             "/locate_jumps=null", "/checks=null"},
                            "smoke"}));
    require_same_points(of(s, text, {{}, "smoke"}));
  }
  SECTION("a sample by table, with words and a take") {
    s.write("rows.csv", "k_r,friction\n0.1e2,nss\n20.000000000000004,coulomb\n5,nss\n");
    require_same_points(
        of(s, R"("sweep": {"mu_c": {"values": [0.5, 1]}, "sample": {"table": "rows.csv", "take": [0, 2]}})"));
  }
  SECTION("a sample by sobol with indices, beside an axis") {
    require_same_points(of(s, R"("sweep": {"sample": {"sobol": 4, "seed": 7, "over": {"k_r": {"log": [5, 40]},
      "tau_f": {"normal": [3e4, 1e3]}, "bending": {"values": ["polar", "rod"]}}}, "k_theta": {"values": [0.5, 1]}},
      "model": {"section": "oval"}, "analysis": {"sobol_indices": ["R_x"], "quantiles": ["R_n"]})"));
  }
  SECTION("a design") {
    Json document =
        *of(s, R"("design": {"variables": {"k_r": [5, 40]}, "objective": {"minimise": "R_x"}, "budget": 8,
      "seed": 1}, "sweep": {"R_n": {"values": [1, 2]}}, "load": {"R_n": null})")
             .document;
    const Json sample = {{"table", {{"columns", {"k_r"}}, {"rows", {{6.5}, {7.25}}}}}};
    document["sweep"] = {{"sample", sample}, {"R_n", document["sweep"]["R_n"]}};
    require_same_points(experiment::stored_experiment(document, "full", "a design"));
  }
  SECTION("a lattice, and SI units with an own law") {
    require_same_points(of(s, R"("load": {"R_n": null, "path": null, "z_0": 0.5}, "record": ["slab_force"],
      "orientation": {"sampling": "lattice", "rtol": null, "rows": 100}, "sweep": {"seed": {"values": [1, 2]}})"));
    s.write("ski.json", bytes_of(std::string(BRISTLE_EXPERIMENTS) + "/ski.json"));
    require_same_points(load_experiment(s.path("ski.json"), {{}, "smoke"}));
  }
}

TEST_CASE("replay: the command names the result, quoted, and the point") {
  const Scratch s;
  const Experiment swept =
      of(s, R"("sweep": {"friction": {"values": ["nss", "coulomb"]}, "k_r": {"values": [5, 20]}})");
  ResultWriter writer(swept, s.path("a file.h5"));
  for (std::size_t i = 0; i < swept.sweep.size(); ++i)
    writer.write(i, record_of(layout_of(swept.sweep), PointResult{}, {}));
  writer.close({});
  writer.publish();
  const ReplayCommands commands(ResultReader(s.path("a file.h5")));
  CHECK_THAT(commands.of_point(2),
             EndsWith(" run '" + s.path("a file.h5") + "' -o results/replay.h5 --point 2"));
  const Json all = commands.of_all_points();
  REQUIRE(all.size() == 4);
  CHECK(all[3] == commands.of_point(3));
}

}  // namespace bristle::replay_test
