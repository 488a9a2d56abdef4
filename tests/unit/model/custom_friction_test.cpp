// The friction law of an experiment's own: a table of values.
#include "design/block.hpp"
#include "experiment/experiment.hpp"
#include "bristle/model/friction/laws.hpp"
#include "results/reader.hpp"
#include "run/task.hpp"
#include "util/error.hpp"
#include "scratch.hpp"

#include "catch.hpp"
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

namespace bristle::custom_friction_test {
using namespace testing;
namespace {

// An experiment with these members, beside a copy of paper.json.
struct Files {
  Files() { s.write("paper.json", bytes_of(std::string(BRISTLE_EXPERIMENTS) + "/paper.json")); }
  Experiment load(const std::string& members) const {
    return load_experiment(s.write("e.json", R"({"extends": "paper.json", "name": "e", )" + members + "}"),
                           {});
  }
  Experiment with_law(const std::string& law, const std::string& further = "") const {
    return load(R"("model": {"friction": "custom"}, "friction_law": )" + law + further);
  }
  Scratch s;
};

double mu(const Experiment& e, double V_R) {
  return e.sweep.friction_law->at(V_R / e.sweep.friction_law->V_scale());
}
double slope(const Experiment& e, double V_R) {
  const double V_scale = e.sweep.friction_law->V_scale();
  return e.sweep.friction_law->slope(V_R / V_scale) / V_scale;
}

// The law with the values of mu at 800 speeds from 0 to V_end, most of them near 0.01.
std::string sampled(const std::function<double(double)>& mu, double V_end) {
  std::vector<double> V_R, values;
  for (int i = 0; i <= 800; ++i) {
    const double t = i / 800. * V_end / (V_end + 0.01);
    V_R.push_back(i < 800 ? 0.01 * t / (1 - t) : V_end);
    values.push_back(mu(V_R.back()));
  }
  return fmt::format(R"({{"V_R": [{}], "mu": [{}]}})", fmt::join(V_R, ", "), fmt::join(values, ", "));
}

}  // namespace

TEST_CASE("custom friction: the table has the values and the curve between them") {
  const Files files;
  const Experiment linear =
      files.with_law(R"({"V_R": [0, 0.1, 1, 4], "mu": [0, 1.2, 0.6, 0.5], "between": "linear"})");
  const Experiment smooth = files.with_law(R"({"V_R": [0, 0.1, 1, 4], "mu": [0, 1.2, 0.6, 0.5]})");
  for (const auto& [V_R, value] :
       std::vector<std::pair<double, double>>{{0, 0}, {0.1, 1.2}, {1, 0.6}, {4, 0.5}, {1e9, 0.5}}) {
    CAPTURE(V_R);
    CHECK(mu(linear, V_R) == Approx(value).margin(1.2e-4));
    CHECK(mu(smooth, V_R) == Approx(value).margin(1.2e-4));
  }
  CHECK(mu(linear, 0.55) == Approx(0.9).margin(1.2e-4));
  CHECK(mu(linear, 0.05) == Approx(0.6).margin(1.2e-4));
  CHECK(mu(smooth, 0.55) > 0.9005);  // pchip leaves its maximum without a corner
  double last = mu(smooth, 0.1);
  for (double V_R = 0.11; V_R < 4; V_R += 0.01) {
    CHECK(mu(smooth, V_R) < last + 1e-9);  // pchip is monotone between the values
    last = mu(smooth, V_R);
  }
  for (const Experiment& e : {linear, smooth})
    for (double V_R = 1e-3; V_R < 10; V_R *= 1.07) {
      const double h = 1e-7 * V_R;
      CHECK((mu(e, V_R + h) - mu(e, V_R - h)) / (2 * h) == Approx(slope(e, V_R)).margin(0.02));
    }
}

TEST_CASE("custom friction: pchip is the curve of SciPy and MATLAB, from the first speed to the last") {
  const Files files;
  struct Row {
    const char* law;
    double largest;  // mu
    std::vector<std::pair<double, double>>
        values;  // V_R and mu of scipy.interpolate.PchipInterpolator 1.10.1
  };
  const std::vector<Row> rows = {
      {R"({"V_R": [0, 0.1, 1, 4], "mu": [0, 1.2, 0.6, 0.5]})",
       1.2,
       {{0.03, 0.45422}, {0.07, 1.02438}, {0.55, 0.9085277}, {2.5, 0.5215743}, {3.7, 0.5007534}}},
      {R"({"V_R": [0, 0.01, 0.05, 0.1, 0.5, 2], "mu": [0, 0.4, 0.9, 1.1, 0.8, 0.75]})",
       1.1,
       {{0.003, 0.1398807}, {0.007, 0.3109884}, {0.03, 0.7254905}, {1.25, 0.7604658}, {1.85, 0.7503535}}},
      {R"({"V_R": [0, 1, 2, 3], "mu": [0, 0.1, 1, 3]})",
       3,  // flat at the first speed, steep at the last
       {{0.3, 0.01026}, {0.7, 0.05194}, {1.5, 0.4173276}, {2.5, 1.8364224}, {2.9, 2.7486224}}}};
  for (const auto& [law, largest, values] : rows)
    for (const auto& [V_R, expected] : values) {
      CAPTURE(law, V_R);
      CHECK(mu(files.with_law(law), V_R) == Approx(expected).margin(1.2e-4 * largest));
    }
}

TEST_CASE("custom friction: a law that still rises at the last speed has a corner there") {
  const Files files;
  const auto rising = [](double V_R) { return 0.1 * V_R + 0.3 * std::tanh(V_R / 0.01); };
  for (const double to : {1., 3., 9.}) {
    const Experiment line = files.with_law(sampled([](double V_R) { return V_R; }, to)),
                     viscous = files.with_law(sampled(rising, to));
    for (double V_R = 1e-3; V_R < 20; V_R *= 1.13) {
      CAPTURE(to, V_R);
      CHECK(mu(line, V_R) == Approx(std::min(V_R, to)).margin(1.5e-4 * to));
      CHECK(mu(viscous, V_R) == Approx(rising(std::min(V_R, to))).margin(1.5e-4 * rising(to)));
    }
    CHECK(mu(line, to) == Approx(to).epsilon(1e-9));
  }
}

TEST_CASE("custom friction: Eq. (7) as a table gives the friction of the Coulomb law, with both engines",
          "[threads]") {
  const Files files;
  const double A = 1.2, C = chi_C_peak_at_V_s(A), B = chi_B(A);
  const auto chi = [&](double V_R) {
    const double u = V_R / 0.01;
    return A * std::sin(B * std::atan(u - C * (u - std::atan(u))));
  };
  const std::string further =
      R"(, "load": {"R_n": 2}, "sweep": {"friction": {"values": ["coulomb", "custom"]},
    "k_r": {"values": [5, 30]}}, "integrator": {"engine": ")";
  for (const char* engine : {"fast", "reference"}) {
    CAPTURE(engine);
    const Experiment e = files.load(R"("friction_law": )" + sampled(chi, 10) + further + engine + "\"}");
    run::RunOptions options;
    options.output = files.s.path(std::string(engine) + ".h5");
    options.quiet = true;
    run::run_experiment(e, options);
    const results::ResultReader file(options.output);
    const std::vector<double>&R_x = file.variable("R_x").values, &error = file.variable("R_x_err").values;
    for (std::size_t i = 0; i < 2; ++i) {
      CAPTURE(i, R_x[i], R_x[i + 2]);
      CHECK(std::abs(R_x[i] - R_x[i + 2]) <
            2 * (error[i] + error[i + 2]) + 2e-4 * R_x[i]);  // 2e-4: the tables
      CHECK(R_x[i] > 0);
    }
  }
}

TEST_CASE("custom friction: with speeds in m/s the law is the same at every velocity, with both engines",
          "[threads]") {
  const Files files;
  const auto with = [&](const std::string& speeds, const std::string& rest) {
    return files.load(R"("model": {"friction": "custom", "bending": "rod"}, "friction_law": {)" + speeds +
                      R"(, "mu": [0, 1.2, 0.6, 0.5]}, "load": {"R_n": null, "z_0": 0.5},
                         "orientation": {"sampling": "list", "theta_0_deg": [70, 120]},
                         "si": {"m_kg": 1e-6, "r0_m": 0.01, "V0_m_per_s": )" +
                      rest);
  };
  const std::string in_m_per_s = R"("V_R_m_per_s": [0, 0.05, 0.5, 2])",
                    of_2 = R"("V_R": [0, 0.025, 0.25, 1])";
  for (const char* engine : {"fast", "reference"}) {
    CAPTURE(engine);
    const std::string with_engine = fmt::format(R"(}}, "integrator": {{"engine": "{}"}})", engine);
    const auto R_x_of = [&](const Experiment& e) {
      run::RunOptions options;
      options.output = files.s.path(e.name + engine + std::to_string(e.sweep.size()) + ".h5");
      options.quiet = true;
      run::run_experiment(e, options);
      return results::ResultReader(options.output).variable("R_x").values;
    };
    const std::vector<double> swept =
        R_x_of(with(in_m_per_s, "9" + with_engine + R"(, "sweep": {"V0_m_per_s": {"values": [0.5, 2]}})"));
    const std::vector<double> alone = R_x_of(with(of_2, "2" + with_engine));
    REQUIRE(swept.size() == 2);
    CHECK(swept[1] == Approx(alone[0]).epsilon(1e-3));
    CHECK(swept[0] != Approx(swept[1]).epsilon(0.05));
  }
}

TEST_CASE("custom friction: speeds in m/s are divided by V0, and other laws are other points") {
  const Files files;
  const auto mu = [](const Experiment& e, double V_R) {
    return modulation(e.sweep.point(0).setup.parameters, V_R);
  };
  const std::string si = R"(, "si": {"m_kg": 1e-6, "r0_m": 0.01, "V0_m_per_s": 0.5})";
  const Experiment in_si =
      files.with_law(R"({"V_R_m_per_s": [0, 0.05, 0.5, 2], "mu": [0, 1.2, 0.6, 0.5]})", si);
  const Experiment plain = files.with_law(R"({"V_R": [0, 0.1, 1, 4], "mu": [0, 1.2, 0.6, 0.5]})", si);
  const Experiment other = files.with_law(R"({"V_R": [0, 0.1, 1, 4], "mu": [0, 1.2, 0.6, 0.4]})", si);
  for (const double V_R : {0.01, 0.3, 2.0}) CHECK(mu(in_si, V_R) == Approx(mu(plain, V_R)).epsilon(2e-4));
  CHECK(plain.sweep.key(0) != other.sweep.key(0));
  CHECK(plain.sweep.key(0) == Experiment(plain).sweep.key(0));
}

TEST_CASE("custom friction: what is not a law is refused with the place and the remedy") {
  const Files files;
  const std::vector<std::pair<std::string, std::string>> rows = {
      {R"J({})J", "/friction_law: needs mu and one of V_R and V_R_m_per_s, or a table, but has none of them"},
      {R"J({"table": {"columns": ["V_R", "mu"], "rows": [[0, 0], [1, 1]]}, "mu": [0, 1]})J",
       "but has mu, table (a null removes a key"},
      {R"J({"V_R": [0, 1, 2], "mu": [0, 1]})J", "/friction_law/mu: has 2 values, and V_R has 3"},
      {R"J({"V_R": [0.1, 1], "mu": [0.5, 1]})J",
       "/friction_law/V_R: begins with V_R = 0.1, mu = 0.5; a bristle at rest"},
      {R"J({"V_R": [0, 1], "mu": [0.5, 1]})J", "/friction_law/mu: begins with V_R = 0, mu = 0.5"},
      {R"J({"V_R": [0, 1, 1], "mu": [0, 1, 1]})J",
       "/friction_law/V_R/2: the speeds must ascend, but 1 follows 1"},
      {R"J({"V_R": [0, 1, 2], "mu": [0, 1, 0]})J",
       "/friction_law/mu/2: 0 is not allowed; allowed: greater than 0"},
      {R"J({"V_R": [0, 1, 2], "mu": [0, 1, -1]})J",
       "/friction_law/mu/2: -1 is not allowed; allowed: a number at least 0"},
      {R"J({"V_R": [0, 1, 2], "mu": [0, 1, 1]})J", "/friction_law/between: pchip needs at least 4 values"},
      {R"J({"V_R": [0, 1e-6, 1e6], "mu": [0, 1, 1e6], "between": "linear"})J",
       "/friction_law/V_R: changes too steeply"},
      {R"J({"V_R": [0, 1e-320, 1], "mu": [0, 1, 1], "between": "linear"})J",
       "/friction_law/V_R: changes too steeply"},
      {R"J({"V_R_m_per_s": [0, 1], "mu": [0, 1], "between": "linear"})J",
       "/friction_law/V_R_m_per_s: needs the block /si"}};
  for (const auto& [law, message] : rows) {
    CAPTURE(law, message);
    CHECK_THROWS_WITH(files.with_law(law), Catch::Contains(message));
  }
  CHECK_THROWS_WITH(files.load(R"("model": {"friction": "custom"})"),
                    Catch::Contains("\"custom\" needs the block /friction_law"));
  CHECK_THROWS_WITH(files.load(R"J("friction_law": {"V_R": [0, 1], "mu": [0, 1], "between": "linear"})J"),
                    Catch::Contains("is the law of no point"));
  const std::string
      sobol =
          R"("sweep": {"sample": {"sobol": 2, "seed": 1, "over": {"friction": {"values": ["nss", "custom"]}}}})",
      table = R"("sweep": {"sample": {"table": {"columns": ["friction"], "rows": [["nss"], ["custom"]]}}})",
      law = R"J(, "friction_law": {"V_R": [0, 1], "mu": [0, 1], "between": "linear"})J";
  CHECK_THROWS_WITH(files.load(sobol),
                    Catch::Contains("/sweep/sample/over/friction: \"custom\" needs the block /friction_law"));
  CHECK_THROWS_WITH(files.load(table),
                    Catch::Contains("/sweep/sample/table: \"custom\" needs the block /friction_law"));
  CHECK(files.load(sobol + law).sweep.friction_law);
  CHECK(files.load(table + law).sweep.friction_law);
}

TEST_CASE("custom friction: a law from a file of comma-separated values equals the law from lists") {
  const Files files;
  files.s.write("law.csv", "# from a tribometer\nmu,V_R\n0,0\n1.1,0.002\n1.3,0.02\n0.9,0.2\n0.6,3\n");
  const Experiment lists =
      files.with_law(R"({"V_R": [0, 0.002, 0.02, 0.2, 3], "mu": [0, 1.1, 1.3, 0.9, 0.6]})");
  const Experiment table = files.with_law(R"({"table": "law.csv"})");
  for (const double V_R : {0.0, 0.001, 0.002, 0.01, 0.1, 1.0, 2.0, 5.0})
    CHECK(mu(table, V_R) == mu(lists, V_R));
  // The experiment contains the values, and no longer depends on the file.
  files.s.write("law.csv", "V_R,mu\n");
  const Experiment stored = stored_experiment(*table.document, "full", "result.h5");
  CHECK(mu(stored, 0.01) == mu(lists, 0.01));
  CHECK_THROWS_WITH(files.with_law(R"({"table": "law.csv"})"), Catch::Contains("law.csv: has no rows"));
}

TEST_CASE("custom friction: what is not a law in a file is refused with its line") {
  const Files files;
  const std::vector<std::pair<std::string, std::string>> rows = {
      {"V_R,F_f\n0,0\n1,1\n", "law.csv: line 1: the columns are V_R, F_f; a law has two"},
      {"V_R,mu,T\n0,0,20\n1,1,20\n", "law.csv: line 1: the columns are V_R, mu, T; a law has two"},
      {"V_R,V_R_m_per_s\n0,0\n", "law.csv: line 1: the columns are V_R, V_R_m_per_s; a law has two"},
      {"V_R,mu\n0,0\n0.5,0.3\n0.4,0.3\n", "law.csv: line 4: the speeds must ascend, but 0.4 follows 0.5"},
      {"V_R,mu\n0,0\n1,fast\n", "law.csv: line 3: mu = \"fast\" is not allowed; allowed: a number from 0"},
      {"V_R,mu\n0,0\n1,-0.2\n", "law.csv: line 3: mu = -0.2 is not allowed"},
      {"V_R,mu\n0,0\n1,0\n", "law.csv: line 3: 0 is not allowed; allowed: greater than 0 at a speed"},
      {"V_R,mu\n0.1,0.4\n1,1\n", "law.csv: line 2: begins with V_R = 0.1, mu = 0.4; a bristle at rest"},
      {"V_R,mu\n0,0\n1\n", "law.csv: line 3: has 1 cells"},
      {"V_R_m_per_s,mu\n0,0\n1,0.4\n", "law.csv: line 1: needs the block /si; use V_R"},
      {"V_R,mu\n0,0\n1,1\n", "/friction_law/between: pchip needs at least 4 values, and there are 2"},
      {"V_R,mu\n0,0\n1e-6,1\n1,1\n1e6,1e6\n", "law.csv: line 1: changes too steeply"}};
  for (const auto& [text, message] : rows) {
    CAPTURE(text, message);
    files.s.write("law.csv", text);
    CHECK_THROWS_WITH(files.with_law(R"({"table": "law.csv"})"), Catch::Contains(message));
  }
  CHECK_THROWS_WITH(files.with_law(R"({"table": "none.csv"})"), Catch::Contains("none.csv"));
}

}  // namespace bristle::custom_friction_test
