#include "results/csv.hpp"
#include "results/reader.hpp"
#include "run/analysis.hpp"
#include "run/task.hpp"
#include "sample_folder.hpp"
#include "util/error.hpp"

#include "catch.hpp"
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace bristle::sample_analysis_test {
using namespace testing;

TEST_CASE("the result of a sample: its quantities are variables over it, first in the exported table") {
  const SampleFolder f;
  const Experiment e = f.load(R"({"sample": {"table": {"columns": ["k_r", "friction", "R_n"],
      "rows": [[20, "nss", 1], [5, "coulomb", 2]]}}, "k_phi": {"values": [2, 3]}})");
  run_experiment(e, {.output = f.s.path("e.h5"), .threads = 1, .quiet = true});
  const ResultReader result(f.s.path("e.h5"));
  CHECK(result.damage().empty());
  CHECK(result.variable("k_r").values == std::vector<double>{20, 5});
  CHECK(result.variable("k_r").dimensions == std::vector<std::string>{"sample"});
  CHECK(result.variable("friction").about.words.at(1) == "coulomb");
  CHECK(result.variable("R_x").dimensions == std::vector<std::string>{"sample", "k_phi"});
  CHECK(result.text("coordinates") == "k_r friction R_n_target");
  const Dataset table = table_of(result, "");
  const auto& columns = table.arrays();
  std::vector<std::string> names;
  for (std::size_t i = 0; i < 5; ++i) names.push_back(columns[i].about.name);
  CHECK(names == std::vector<std::string>{"sample", "k_r", "friction", "R_n_target", "k_phi"});
  for (const std::size_t row : {0, 1, 2, 3}) CHECK(columns[2].cell(row) == (row < 2 ? "nss" : "coulomb"));
}

TEST_CASE("Sobol indices and quantiles are stored with the result of a sample", "[threads]") {
  const SampleFolder f;
  const Experiment e = f.load(R"({"bending": {"values": ["polar", "rod"]}, "sample": {"sobol": 16, "seed": 1,
                 "over": {"k_r": {"log": [5, 50]}, "zeta_phi": {"uniform": [0.1, 0.1001]}}}})",
                              R"(, "analysis": {"sobol_indices": ["R_x", "R_n"], "quantiles": ["R_x"]})");
  REQUIRE(e.sweep.size() == 2 * 16 * 4);
  run_experiment(e, {.output = f.s.path("e.h5"), .threads = 2, .quiet = true});
  const ResultReader result(f.s.path("e.h5"));
  CHECK(result.damage().empty());
  const Array& total = result.variable("indices/ST");
  CHECK(total.dimensions == std::vector<std::string>{"bending", "output", "input"});
  CHECK(result.variable("indices/S1_err").shape == std::vector<std::size_t>{2, 2, 2});
  CHECK(total.values[0] > 0.9);  // k_r
  CHECK(total.values[1] < 0.01);
  const Array& quantiles = result.variable("quantiles/quantile");
  CHECK(quantiles.shape == std::vector<std::size_t>{2, 1, 5});
  CHECK(std::is_sorted(quantiles.values.begin(), quantiles.values.begin() + 5));
  CHECK(result.variable("quantiles/points").values.front() == 32);
  const Dataset table = table_of(result, "indices");
  const auto& columns = table.arrays();
  CHECK(columns[1].about.name == "output");
  CHECK(columns[1].cell(2) == "R_n");
  CHECK(columns[2].cell(1) == "zeta_phi");
  // Another analysis of the same points computes no point again.
  const Experiment more =
      f.load(e.document->at("sweep").dump(), R"(, "analysis": {"sobol_indices": ["R_x"]})");
  for (std::size_t i = 0; i < e.sweep.size(); ++i) CHECK(more.sweep.key(i) == e.sweep.key(i));
}

TEST_CASE("indices and quantiles count the points that they use, and the ambiguous ones of these") {
  const SampleFolder f;
  // Points of the design a, b, a with the first coordinate of b, and with the second.
  const Experiment e = f.load(
      R"({"sample": {"sobol": 20, "seed": 1, "over": {"R_n": {"uniform": [0.5, 2.5]}, "k_r": {"log": [5, 50]}}}})",
      R"(, "analysis": {"sobol_indices": ["R_x"], "quantiles": ["R_x"]})");
  std::vector<double> statuses(80, double(PointStatus::ok)), values;
  const std::vector<sweep::Axis>& columns = e.sweep.axes.front().columns;
  for (std::size_t i = 0; i < 80; ++i) values.push_back(10 * columns[0].values[i] + columns[1].values[i]);
  for (const std::size_t i : {4, 5, 10, 15}) {
    statuses[i] = double(PointStatus::unreachable);
    values[i] = NAN;
  }
  for (const std::size_t i : {20, 22, 23}) statuses[i] = double(PointStatus::ambiguous);
  // These points have values, which count.
  statuses[24] = double(PointStatus::not_converged);
  statuses[25] = double(PointStatus::load_jump);
  const auto groups = run::analyse(e, {{"R_x", values}, {"status", statuses}});
  CHECK(groups[0].array("blocks").values == std::vector<double>{18, 18});
  CHECK(groups[0].array("S1_blocks").values == std::vector<double>{18, 18});
  CHECK(groups[0].array("ambiguous").values == std::vector<double>{3, 3});
  CHECK(groups[1].array("points").values == std::vector<double>(5, 38));
  CHECK(groups[1].array("ambiguous").values == std::vector<double>(5, 1));
  const std::string text = run::analysis_text(e, groups);
  CHECK_THAT(
      text,
      Catch::Contains("  from 18 of 20 pairs, as the others have points without a value") &&
          Catch::Contains("; 2 points have no value and are left out; ambiguous points among those used: 1"));
}

TEST_CASE("an index of too few points is missing, and the text says what to do", "[threads]") {
  const SampleFolder f;
  // The load is beyond what many of the bristles carry.
  const Experiment e = f.load(
      R"({"sample": {"sobol": 16, "seed": 1, "over": {"R_n": {"uniform": [0.5, 2.5]}, "k_r": {"log": [5, 50]}}}})",
      R"(, "analysis": {"sobol_indices": ["R_x"], "quantiles": ["R_x"]})");
  run_experiment(e, {.output = f.s.path("e.h5"), .threads = 2, .quiet = true});
  const ResultReader result(f.s.path("e.h5"));
  const std::vector<double>& values = result.variable("R_x").values;
  std::size_t present = 0;
  std::vector<double> pairs(2), triples(2);
  for (std::size_t block = 0; block < 16; ++block) {
    const auto has = [&](std::size_t i) { return std::isfinite(values[4 * block + i]); };
    present += std::size_t(has(0)) + std::size_t(has(1));
    for (std::size_t i = 0; i < 2; ++i) {
      pairs[i] += has(0) && has(2 + i);
      triples[i] += has(0) && has(1) && has(2 + i);
    }
  }
  REQUIRE(std::max(pairs[0], pairs[1]) < 16);
  CHECK(result.variable("indices/blocks").values == pairs);
  CHECK(result.variable("indices/S1_blocks").values == triples);
  for (const char* name : {"S1", "S1_err", "ST", "ST_err"})
    for (const double value : result.variable(std::string("indices/") + name).values)
      CHECK(std::isnan(value));
  CHECK(result.variable("quantiles/points").values.front() == double(present));
  const auto groups = run::analyse(e, {{"R_x", values}, {"status", std::vector<double>(values.size(), 0)}});
  CHECK_THAT(run::analysis_text(e, groups),
             Catch::Contains(" of 16 pairs; an index needs 16: raise sobol, or choose ranges in which more "
                             "points have a value") &&
                 Catch::Contains("too few of the points have a value: "));
  const auto none =
      run::analyse(e, {{"R_x", std::vector<double>(64, NAN)}, {"status", std::vector<double>(64, 0)}});
  CHECK_THAT(
      run::analysis_text(e, none),
      Catch::Contains("quantiles of R_x: none, as none of 32 points has a value") && !Catch::Contains("nan"));
}

TEST_CASE("an analysis needs a sample, and variables of the result") {
  const SampleFolder f;
  const auto message = [&](const std::string& sweep, const std::string& analysis) {
    try {
      validate_analysis(f.load(sweep, ", \"analysis\": " + analysis));
    } catch (const InputError& e) {
      return std::string(e.what()).substr(f.s.path("").size());
    }
    return std::string("(no error)");
  };
  CHECK(message(R"({"k_r": {"values": [1, 2]}})", R"({"quantiles": ["R_x"]})") ==
        "e.json: /analysis: needs a sample in the sweep (/sweep/sample)");
  CHECK(message(R"({"sample": {"table": {"columns": ["k_r"], "rows": [[1]]}}})",
                R"({"sobol_indices": ["R_x"]})") ==
        "e.json: /analysis/sobol_indices: needs a sample by sobol, of which the program makes the design for "
        "indices");
  CHECK(message(sobol(R"("k_r": {"log": [1, 2]})"), R"({"quantiles": ["R_xx"]})")
            .starts_with(
                "e.json: /analysis/quantiles: \"R_xx\" is not a variable of the result (did you mean R_x?)"));
}

}  // namespace bristle::sample_analysis_test
