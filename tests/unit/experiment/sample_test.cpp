#include "bristle/ensemble/normal_quantile.hpp"
#include "bristle/ensemble/sobol.hpp"
#include "bristle/model/friction/laws.hpp"
#include "results/reader.hpp"
#include "run/task.hpp"
#include "sample_folder.hpp"

#include "catch.hpp"
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

namespace bristle::sample_test {
using namespace testing;

TEST_CASE("a scrambled Sobol sequence fills every interval once and begins with the shorter one") {
  constexpr std::size_t n = 256, dimensions = 20;
  for (const std::uint64_t seed : {0, 1, 20261125}) {
    const auto points = sobol_points(n, dimensions, seed);
    for (std::size_t d = 0; d < dimensions; ++d) {
      std::set<long> intervals;
      for (const auto& point : points) intervals.insert(std::lround(std::floor(point[d] * n)));
      CHECK(intervals.size() == n);
    }
    const auto more = sobol_points(2 * n, dimensions, seed);
    CHECK(std::equal(points.begin(), points.end(), more.begin()));
  }
  CHECK(sobol_points(n, 2, 1) != sobol_points(n, 2, 2));
  // The second point of two dimensions, as on every machine.
  CHECK(fmt::format("{:.12f} {:.12f}", sobol_points(2, 2, 1)[1][0], sobol_points(2, 2, 1)[1][1]) ==
        "0.315910409554 0.076436227071");
}

TEST_CASE("pairs of a scrambled Sobol sequence integrate better than random points") {
  // The integral of x y is 1/4; of N random points the error is 0.2/sqrt(N).
  constexpr std::size_t n = 1024;
  const auto points = sobol_points(n, 8, 3);
  for (std::size_t d = 1; d < 8; ++d) {
    double sum = 0;
    for (const auto& point : points) sum += point[0] * point[d];
    CHECK(std::abs(sum / n - 0.25) < 0.1 * 0.2 / std::sqrt(double(n)));
  }
}

TEST_CASE("distributions of a sample: ranges, moments and words") {
  const SampleFolder f;
  const Experiment e = f.load(sobol(R"("k_r": {"log": [3, 100]}, "tau_f": {"normal": [3e4, 3e3]},
      "phi_0_deg": {"uniform": [70, 85]}, "friction": {"values": ["nss", "coulomb"]},
      "k_phi": {"values": [1, 2, 4]})",
                                    1024));
  REQUIRE(e.sweep.size() == 1024);
  const auto mean = [](const std::vector<double>& v, auto of) {
    double sum = 0;
    for (const double x : v) sum += of(x);
    return sum / double(v.size());
  };
  const auto itself = [](double x) { return x; };
  CHECK(mean(column(e, "k_r"), [](double x) { return std::log(x); }) ==
        Approx((std::log(3) + std::log(100)) / 2).epsilon(1e-3));
  CHECK(*std::ranges::min_element(column(e, "k_r")) >= 3);
  CHECK(*std::ranges::max_element(column(e, "k_r")) <= 100);
  CHECK(mean(column(e, "tau_f"), itself) == Approx(3e4).epsilon(1e-3));
  CHECK(std::sqrt(mean(column(e, "tau_f"), [](double x) { return (x - 3e4) * (x - 3e4); })) ==
        Approx(3e3).epsilon(0.01));
  CHECK(mean(column(e, "phi_0_deg"), itself) == Approx(77.5).epsilon(1e-3));
  CHECK(mean(column(e, "friction"), itself) == 0.5);
  CHECK(mean(column(e, "k_phi"), itself) == Approx(7.0 / 3).epsilon(2e-3));
  // Seven digits, so that libraries of elementary functions cannot differ.
  for (const double value : column(e, "tau_f")) CHECK(std::stod(fmt::format("{:.7g}", value)) == value);
}

TEST_CASE("a normal distribution has its share below each value, in the tails as well") {
  const SampleFolder f;
  constexpr std::size_t n = 16384;
  const Experiment e = f.load(sobol(R"("tau_f": {"normal": [30000, 1000]})", n));
  const auto points = sobol_points(n, 1, 1);
  double farthest = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double z = (column(e, "tau_f")[i] - 3e4) / 1e3, share = points[i][0];
    farthest = std::max(farthest, std::abs(z));
    // The values have seven digits: the standardised ones are within 5e-6.
    const double density = std::exp(-z * z / 2) / std::sqrt(2 * M_PI);
    CHECK_FALSE(std::abs(std::erfc(-z / std::sqrt(2.0)) / 2 - share) > 6e-6 * density + 1e-12);
  }
  CHECK(farthest > 3.7);
}

TEST_CASE("a longer sample begins with the shorter one, and each seed has its own points") {
  const SampleFolder f;
  const std::string over = R"("k_r": {"log": [3, 100]}, "mu_c": {"normal": [0.3, 0.05]})";
  const Experiment few = f.load(sobol(over, 8)), more = f.load(sobol(over, 100));
  for (std::size_t i = 0; i < few.sweep.size(); ++i) CHECK(few.sweep.key(i) == more.sweep.key(i));
  CHECK(column(few, "k_r") != column(f.load(sobol(over, 8, 2)), "k_r"));
}

TEST_CASE("malformed samples: the message names place, value and remedy") {
  const SampleFolder f;
  f.s.write("empty.csv", "k_r,mu_c\n");
  f.s.write("cell.csv", "k_r,mu_c\n1,\n");
  f.s.write("short.csv", "k_r,mu_c\n1\n");
  f.s.write("word.csv", "k_r,friction\n1,columb\n");
  f.s.write("range.csv", "k_r\n1\n# measured\n-2\n");
  f.s.write("good.csv", "k_r\n1\n2\n");
  f.s.write("text.csv", "k_r\nfast\n");
  f.s.write("infinite.csv", "k_r\ninf\n");
  f.s.write("column.csv", "k_rr\n1\n");
  f.s.write("semicolons.csv", "k_r;mu_c\n0,5;1\n");
  f.s.write("twice.csv", "k_r,k_r\n1,2\n");
  f.s.write("trailing.csv", "# measured\nk_r,mu_c,\n1,1,\n");
  f.s.write("nameless.csv", "k_r,,mu_c\n1,,1\n");
  f.s.write("commas.csv", "k_r,mu_c\n1,5,0,5\n");
  f.s.write("comma.csv", "k_r,mu_c\n1,1\n2,\"0,5\"\n");
  const auto table = [](const std::string& name) { return R"({"sample": {"table": ")" + name + "\"}}"; };
  const std::string at = "e.json: /sweep/sample/",
                    laws = fmt::format("{}", fmt::join(texts(words<FrictionLaw>()), ", "));
  const std::vector<std::pair<std::string, std::string>> rows = {
      {table("none.csv"), "none.csv: cannot be read: no such file"},
      {table("empty.csv"),
       "empty.csv: has no rows; a table needs a line with the names of its columns, such as "
       "k_r,tau_f, and lines with their values"},
      {table("cell.csv"), "cell.csv: line 2: the cell of mu_c is empty; give it a value, or remove the row"},
      {table("semicolons.csv"),
       "semicolons.csv: line 1: the columns are not separated by commas; write commas between names, and "
       "numbers such as 0.5,3e4"},
      {table("short.csv"), "short.csv: line 2: has 1 cells, and the first line names 2 columns"},
      {table("word.csv"),
       "word.csv: line 2: \"columb\" is not known (did you mean coulomb?); allowed: " + laws},
      {table("range.csv"),
       "range.csv: line 4: -2 is out of range for k_r; allowed: a number greater than 0 "
       "(radial stiffness, dimensionless)"},
      {table("text.csv"), "text.csv: line 2: \"fast\" is not a number, which k_r needs"},
      {table("infinite.csv"), "infinite.csv: line 2: \"inf\" is not a number, which k_r needs"},
      {table("trailing.csv"),
       "trailing.csv: line 2: column 3 has no name: remove the comma at the end of this line, and of the "
       "others"},
      {table("nameless.csv"),
       "nameless.csv: line 1: column 2 has no name: give it one, or remove its comma from every line"},
      {table("commas.csv"),
       "commas.csv: line 2: has 4 cells, and the first line names 2 columns; write numbers with a point, "
       "such "
       "as 0.5"},
      {table("comma.csv"),
       "comma.csv: line 3: \"0,5\" has a comma; write numbers with a point, such as 0.5, and without quotes"},
      {table("twice.csv"), "twice.csv: line 1: k_r appears twice"},
      {R"({"sample": {}})", "e.json: /sweep/sample: needs exactly one of table and sobol; neither is given"},
      {R"({"sample": {"sobol": 8, "over": {"k_r": {"log": [1, 2]}}}})",
       at + "seed: is missing; a sample by sobol needs it"},
      {R"({"sample": {"sobol": 8, "seed": 1}})", at + "over: is missing; a sample by sobol needs it"},
      {R"({"sample": {"table": "good.csv", "seed": 1}})", at + "seed: is allowed with sobol only"},
      {sobol(R"("k_r": {"log": [0, 2]})"),
       at + "over/k_r/log: a logarithmic distribution cannot begin at 0; allowed: greater than 0"},
      {sobol(R"("k_r": {"uniform": [3, 2]})"), at + "over/k_r/uniform: 3 is not below 2; swap them"},
      {sobol(R"("k_r": {"normal": [3, 0]})"),
       at + "over/k_r/normal: the standard deviation 0 is not positive"},
      {sobol(R"("friction": {"uniform": [0, 1]})"),
       at + "over/friction/uniform: friction is a choice; it needs \"values\", a list of words; allowed: " +
           laws},
      {sobol(R"("k_r": {"uniform": [1, 2], "log": [1, 2]})"),
       at + "over/k_r: {\"uniform\":[1,2],\"log\":[1,2]} gives 2 distributions; one is needed: uniform, log, "
            "normal or values"},
      {R"({"sample": {"table": {"columns": ["k_r", "mu_c"], "rows": [[1, 2], [1]]}}})",
       at + "table/rows/1: has 1 values, and the table has 2 columns"},
      {R"({"sample": {"table": "good.csv", "take": [1, 1]}})",
       at + "take: 1 is not allowed; allowed: ascending indices from 0 to 1"},
  };
  for (const auto& [sweep, message] : rows) CHECK(f.error(sweep) == message);
  CHECK(f.error(table("column.csv"))
            .starts_with("column.csv: line 1: k_rr cannot be swept (did you mean k_r?); allowed: k_r, "));
  CHECK(f.error(sobol(R"("k_r": {"normal": [3, 30]})")).starts_with(at + "over/k_r: -"));
}

TEST_CASE("a quantity cannot be given by the sample and by an axis or the load") {
  const SampleFolder f;
  CHECK(f.error(R"({"k_r": {"values": [1]}, "sample": {"table": {"columns": ["k_r"], "rows": [[1]]}}})") ==
        "e.json: /sweep/sample: k_r is varied by another axis, too; remove one of them");
  CHECK(f.error(R"({"sample": {"table": {"columns": ["z_0", "R_n"], "rows": [[0.5, 1]]}}})")
            .find("R_n and z_0 are both given") != std::string::npos);
}

TEST_CASE("two sets of SI quantities with equal dimensionless groups give equal bits: the model has no scale",
          "[threads]") {
  // The second row is the first in other units of length (2), mass (4) and speed (8); these powers of two are
  // exact, and so are the groups. The third row has a greater shaft: the comparison can fail.
  SampleFolder f;
  std::filesystem::copy_file(std::string(BRISTLE_EXPERIMENTS) + "/ski.json", f.s.path("ski.json"));
  constexpr double length = 2, mass = 4, speed = 8, energy = mass * speed * speed,
                   stress = energy / (length * length * length);
  const std::vector<std::pair<std::string, std::pair<double, double>>> first_and_unit = {
      {"m_kg", {1e-4, mass}},           {"r0_m", {0.017, length}},   {"R_m", {1.08e-3, length}},
      {"R_c_m", {1e-3, length}},        {"V0_m_per_s", {10, speed}}, {"V_s_m_per_s", {0.1, speed}},
      {"E_Pa", {1e8, stress}},          {"tau_f_Pa", {1e7, stress}}, {"beta_J", {0.01, energy}},
      {"R_n_N", {0.6, energy / length}}};
  nlohmann::json columns, rows = {{}, {}, {}};
  for (const auto& [name, value] : first_and_unit) {
    columns.push_back(name);
    rows[0].push_back(value.first);
    rows[1].push_back(value.first * value.second);
    rows[2].push_back(name == "R_m" ? 1.1e-3 : value.first);
  }
  const nlohmann::json changes = {{"extends", "ski.json"},
                                  {"name", "e"},
                                  {"tiers", nullptr},
                                  {"model", {{"contact", "wall"}}},
                                  {"orientation", {{"sampling", "list"}, {"theta_0_deg", {20, 80, 150}}}},
                                  {"sweep",
                                   {{"V0_m_per_s", nullptr},
                                    {"R_n_N", nullptr},
                                    {"sample", {{"table", {{"columns", columns}, {"rows", rows}}}}}}}};
  run_experiment(load_experiment(f.s.write("e.json", changes.dump()), {}),
                 {.output = f.s.path("e.h5"), .threads = 2, .quiet = true});
  const ResultReader result(f.s.path("e.h5"));
  const auto rows_of = [&](const std::string& name) {
    const std::vector<double>& v = result.variable(name).values;  // over friction and sample
    REQUIRE(v.size() == 6);
    return std::array<std::vector<double>, 3>{{{v[0], v[3]}, {v[1], v[4]}, {v[2], v[5]}}};
  };
  for (const char* name :
       {"R_x_norm", "R_x_norm_err", "z_0", "gamma_1", "gamma_2", "gamma_3", "N_c_ratio", "passages"}) {
    INFO(name);
    const auto [small, large, other] = rows_of(name);
    for (const double value : small) CHECK(std::isfinite(value));
    CHECK(small == large);
    if (name == std::string("R_x_norm")) CHECK(small != other);
  }
  const auto [small, large, other] = rows_of("z_0_in_m");
  for (std::size_t i = 0; i < small.size(); ++i) CHECK(length * small[i] == large[i]);
}

}  // namespace bristle::sample_test
