#include "assumptions/assumptions.hpp"
#include "claims/checks.hpp"
#include "util/error.hpp"
#include "scratch.hpp"

#include "catch.hpp"
#include <boost/algorithm/string/replace.hpp>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

namespace bristle::assumptions_test {
using namespace testing;

namespace {

const std::string kExperiments = BRISTLE_EXPERIMENTS;

// Two experiments of a few passages each. The alternatives change one or both.
struct SmallStudy {
  SmallStudy() {
    std::filesystem::create_directories(s.path("experiments/assumptions"));
    std::filesystem::copy_file(kExperiments + "/paper.json", s.path("experiments/paper.json"));
    const std::string list =
        R"("orientation": {"sampling": "list", "theta_0_deg": [20, 70]}, "load": {"R_n": null, "z_0": 0.5})";
    s.write("experiments/a.json", R"({"extends": "paper.json", "name": "a", "figure": "1", )" + list + R"(,
      "sweep": {"mu_c": {"values": [0.5, 1]}}, "model": {"friction": "coulomb"},
      "checks": [{"claim": "1a", "statement": "R_x grows with mu_c", "predicate": "end_ratio", "variable": "R_x",
                  "along": "mu_c", "is": "at_least", "threshold": 1.1}]})");
    s.write("experiments/b.json", R"({"extends": "paper.json", "name": "b", "figure": "2", )" + list + R"(,
      "sweep": {"k_r": {"values": [5, 10]}},
      "checks": [{"claim": "2a", "statement": "R_x is positive", "predicate": "level", "variable": "R_x", "along": "k_r",
                  "is": "at_least", "threshold": 0}]})");
    declare("one.json",
            R"({"schema": "bristle-assumption/1", "choice": "mu", "question": "which", "alternatives": [
      {"name": "rising", "description": "only a", "experiments": {"a": {"patch": {"sweep": {"mu_c": {"values": [0.6, 1]}}}}}},
      {"name": "impossible", "description": "only a", "experiments": {"a": {"set": {"/checks/0/threshold": 1000}}}},
      {"name": "slow", "description": "both", "patch": {"model": {"V_s": 0.02}}}]})");
    options.experiments = s.path("experiments");
    options.output = s.path("out/matrix.json");
    options.tier = "full";
    options.threads = 1;
    options.quiet = true;
  }
  void declare(const std::string& name, const std::string& text) {
    options.files.push_back(s.write("experiments/assumptions/" + name, text));
  }

  Scratch s;
  AssumptionsOptions options;
};

std::string error_of(SmallStudy& small) {
  try {
    run_assumptions(small.options);
  } catch (const InputError& e) {
    return e.what();
  }
  return "(no error)";
}

}  // namespace

TEST_CASE("assumptions: every alternative of the project leaves its experiments and their checks valid") {
  AssumptionsOptions options;
  options.experiments = kExperiments;
  for (const auto& entry : std::filesystem::directory_iterator(kExperiments + "/assumptions"))
    options.files.push_back(entry.path().string());
  REQUIRE(!options.files.empty());
  CHECK_NOTHROW(validate_assumptions(options));
}

TEST_CASE("every check is evaluated under every alternative") {
  SmallStudy small;
  small.declare("pairs.json",
                R"({"schema": "bristle-assumption/1", "choice": "pairs", "question": "both", "pairs": [
    {"members": ["slow", "impossible"], "description": "together"}]})");
  const Matrix m = run_assumptions(small.options);
  REQUIRE(m.alternatives.size() == 5);
  CHECK(m.alternatives.back().name == "slow + impossible");
  REQUIRE(m.rows.size() == 2);
  for (const Matrix::Row& row : m.rows) REQUIRE(row.cells.size() == 5);

  const auto& a = m.rows[0].cells;
  CHECK(a[0].result.verdict == Verdict::supported);
  CHECK(a[1].result.measured.value != a[0].result.measured.value);
  CHECK(a[2].result.measured.value == a[0].result.measured.value);
  CHECK(a[2].result.verdict == Verdict::refuted);
  CHECK(a[2].affected);
  CHECK(a[3].result.measured.value != a[0].result.measured.value);
  CHECK(a[4].result.measured.value == a[3].result.measured.value);
  CHECK(a[4].result.verdict == Verdict::refuted);

  const auto& b = m.rows[1].cells;
  CHECK_FALSE(b[1].affected);
  CHECK_FALSE(b[2].affected);
  CHECK(b[3].affected);
  CHECK(b[1].result.measured.value == b[0].result.measured.value);
  CHECK(std::string(conclusion(m, m.rows[0])) == "assumption-dependent");
  CHECK(std::string(conclusion(m, m.rows[1])) == "robust");

  const Json json = matrix_json(m);
  CHECK(json["cells"].size() == 2);
  CHECK(json["cells"][1]["under"].size() == 5);
  CHECK(json["conclusions"][0]["other"] == Json({"impossible", "slow + impossible"}));
  CHECK(json["checks"][0]["band"].is_null());
  CHECK(json["inputs_sha256"] == inputs_sha256(small.options));
  CHECK(json["payload_sha256"] == matrix_payload_sha256(Json::parse(json_lines(json))));
}

TEST_CASE(
    "the digest of a matrix's inputs covers declarations, experiments, tier and choice, not order or names") {
  SmallStudy small;
  small.declare("two.json", R"({"schema": "bristle-assumption/1", "choice": "k", "question": "which",
    "alternatives": [{"name": "stiff", "description": "d", "patch": {"model": {"k_phi": 2}}}]})");
  const std::string before = inputs_sha256(small.options);
  AssumptionsOptions other = small.options;
  std::swap(other.files[0], other.files[1]);
  other.output = "elsewhere.json";
  CHECK(inputs_sha256(other) == before);
  other.only = {"a"};
  CHECK(inputs_sha256(other) != before);
  other = small.options;
  other.tier = "study";
  CHECK(inputs_sha256(other) != before);
  other = small.options;
  other.files.pop_back();
  CHECK(inputs_sha256(other) != before);
  small.s.write("experiments/b.json",
                boost::replace_all_copy(bytes_of(small.s.path("experiments/b.json")), "[5, 10]", "[5, 11]"));
  CHECK(inputs_sha256(small.options) != before);
}

TEST_CASE("a second call computes no result again") {
  SmallStudy small;
  run_assumptions(small.options);
  const std::string result = small.s.path("out/matrix/baseline/a.h5");
  const auto written = std::filesystem::last_write_time(result);
  const std::string other = small.s.path("out/matrix/rising/a.h5");
  REQUIRE(std::filesystem::exists(other));
  CHECK_FALSE(std::filesystem::exists(small.s.path("out/matrix/rising/b.h5")));
  const Matrix again = run_assumptions(small.options);
  CHECK(std::filesystem::last_write_time(result) == written);
  CHECK(again.rows[0].cells[2].result.verdict == Verdict::refuted);
}

TEST_CASE("mistakes in assumptions are reported before anything is computed") {
  struct Row {
    std::string text, message;
  };
  const std::string head = R"({"schema": "bristle-assumption/1", "choice": "x", "question": "q", )";
  const std::vector<Row> table = {
      {"[]", "expected a JSON object"},
      {head + R"("alternative": []})", "/alternative: unknown key (did you mean alternatives?)"},
      {head + R"("alternatives": [{"name": "n"}]})", "/alternatives/0/description: is missing"},
      {head + R"("alternatives": [{"name": "slow", "description": "d"}]})",
       "two alternatives have the name slow"},
      {head + R"("pairs": [{"members": ["slow", "risin"], "description": "d"}]})",
       "there is no alternative risin (did you mean rising?)"},
      {head +
           R"("alternatives": [{"name": "n", "description": "d", "patch": {"model": {"phi_0_deg": 100}}}]})",
       "a.json under n: /model/phi_0_deg: 100 is not allowed"},
      {head +
           R"("alternatives": [{"name": "n", "description": "d", "experiments": {"a": {"set": {"/checks/7/is": 1}}}}]})",
       "alternative n: a has no value at /checks/7/is"},
      {head + R"("alternatives": [{"name": "n", "description": "d", "experiments": {"aa": {}}}]})",
       "alternative n: /experiments: no experiment aa has claims to evaluate: checks, and either a figure or "
       "a tier \"study\" (did you mean a?)"},
      {head + R"("alternatives": [{"name": "idle", "description": "d", "patch": {"model": {"mu_c": 1}}}]})",
       "alternative \"idle\": changes no number of any experiment"},
  };
  for (const Row& row : table) {
    SmallStudy small;
    small.declare("wrong.json", row.text);
    CAPTURE(row.text);
    CHECK_THAT(error_of(small), Catch::Contains(row.message));
    CHECK_FALSE(std::filesystem::exists(small.s.path("out")));
  }
}

TEST_CASE("the declared assumptions are valid, and cover every open choice") {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(kExperiments + "/assumptions"))
    files.push_back(entry.path().string());
  const auto alternatives = read_alternatives(files);
  for (const char* choice :
       {"phi_0", "A", "C", "V_s", "lambda", "alpha", "initial state", "springs of bending", "k_theta",
        "pole rule", "damping", "swept ranges", "together"}) {
    CAPTURE(choice);
    CHECK(std::any_of(alternatives.begin(), alternatives.end(),
                      [&](const Alternative& a) { return a.choice == choice; }));
  }
  for (const char* name : {"fig3", "fig3a", "fig4", "fig8"})
    for (const Alternative& a : alternatives) {
      CAPTURE(name, a.name);
      const Experiment e = load_experiment(kExperiments + "/" + name + ".json", {{}, "study"});
      CHECK_NOTHROW(validate_checks(stored_experiment(a.apply(name, *e.document), "study", name)));
    }
}

}  // namespace bristle::assumptions_test
