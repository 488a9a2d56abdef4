#include "experiment/experiment.hpp"
#include "bristle/ensemble/normal_quantile.hpp"
#include "sampling/rounded.hpp"
#include "bristle/model/friction/laws.hpp"
#include "run/analysis.hpp"
#include "run/task.hpp"
#include "results/csv.hpp"
#include "results/reader.hpp"
#include "util/error.hpp"
#include "bristle/ensemble/sobol.hpp"
#include "scratch.hpp"

#include "catch.hpp"
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>

namespace bristle::sample_test {
using namespace testing;

namespace {

// An experiment with this sweep in a folder with these tables.
struct Folder {
  Folder() {
    std::filesystem::copy_file(std::string(BRISTLE_EXPERIMENTS) + "/paper.json", s.path("paper.json"));
  }
  Experiment load(const std::string& sweep, const std::string& more = "") const {
    // A gap, unless the sample has loads.
    const char* load =
        sweep.find("R_n") == sweep.npos ? R"({"R_n": null, "path": null, "z_0": 0.7})" : R"({"R_n": null})";
    return load_experiment(
        s.write("e.json", fmt::format(R"({{"extends": "paper.json", "name": "e", "load": {},
              "orientation": {{"sampling": "list", "theta_0_deg": [20, 80]}}, "sweep": {}{}}})",
                                      load, sweep, more)),
        {});
  }
  std::string error(const std::string& sweep) const {
    return input_error(s, [&] { load(sweep); });
  }
  Scratch s;
};

std::string sobol(const std::string& over, int points = 8, int seed = 1) {
  return fmt::format(R"({{"sample": {{"sobol": {}, "seed": {}, "over": {{{}}}}}}})", points, seed, over);
}

const std::vector<double>& column(const Experiment& e, std::string_view name) {
  return std::ranges::find(e.sweep.axes.front().columns, name, &Axis::name)->values;
}

}  // namespace

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
  const Folder f;
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
  const Folder f;
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
  const Folder f;
  const std::string over = R"("k_r": {"log": [3, 100]}, "mu_c": {"normal": [0.3, 0.05]})";
  const Experiment few = f.load(sobol(over, 8)), more = f.load(sobol(over, 100));
  for (std::size_t i = 0; i < few.sweep.size(); ++i) CHECK(few.sweep.key(i) == more.sweep.key(i));
  CHECK(column(few, "k_r") != column(f.load(sobol(over, 8, 2)), "k_r"));
}

TEST_CASE("a row of a table is the same point as the same values on axes") {
  const Folder f;
  f.s.write("t.csv",
            "\xef\xbb\xbf# a remark\n\"k_r\", mu_c "
            ",friction,phi_0_deg\r\n\r\n5,0.2,coulomb,80\n2e1,0.3,nss,75.5\n");
  const Experiment e = f.load(R"({"sample": {"table": "t.csv"}, "bending": {"values": ["polar", "rod"]}})");
  REQUIRE(e.sweep.shape() == std::vector<std::size_t>{2, 2});
  const Experiment axes =
      f.load(R"({"friction": {"values": ["nss"]}, "k_r": {"values": [20]}, "mu_c": {"values": [0.3]},
      "phi_0_deg": {"values": [75.5]}, "bending": {"values": ["polar", "rod"]}})");
  CHECK(e.sweep.key(2) == axes.sweep.key(0));
  CHECK(e.sweep.key(3) == axes.sweep.key(1));
  CHECK(e.sweep.place(3) == "sample = 1, bending = rod");
  f.s.write("one.csv", "k_r,mu_c\n5,0.2\n");
  CHECK(f.load(R"({"sample": {"table": "one.csv"}})")
            .warnings.empty());  // one value shows no effect, and is no mistake
  // The document has all that the points need: the file may change or be lost.
  std::filesystem::remove(f.s.path("t.csv"));
  const Experiment stored = stored_experiment(*e.document, "full", "stored");
  for (std::size_t i = 0; i < e.sweep.size(); ++i) CHECK(stored.sweep.key(i) == e.sweep.key(i));
}

TEST_CASE("a tier takes rows of a table, and --set names another table") {
  const Folder f;
  f.s.write("t.csv", "k_r\n5\n10\n20\n");
  f.s.write("other.csv", "k_r\n7\n");
  f.load(R"({"sample": {"table": "t.csv"}})",
         R"(, "tiers": {"smoke": {"sweep": {"sample": {"take": [0, 2]}}}})");
  CHECK(column(load_experiment(f.s.path("e.json"), {{}, "smoke"}), "k_r") == std::vector<double>{5, 20});
  CHECK(
      column(load_experiment(f.s.path("e.json"), {{"/sweep/sample/table=" + f.s.path("other.csv")}, "full"}),
             "k_r") == std::vector<double>{7});
}

TEST_CASE("a table that is replaced or removed is not read") {
  const Folder f;
  f.s.write("t.csv", "k_r\n5\n10\n");
  const std::string with_table = R"({"sample": {"table": ")", missing = with_table + R"(none.csv"}})";
  const auto k_r = [&](const DocumentOptions& options) {
    return column(load_experiment(f.s.path("e.json"), options), "k_r");
  };
  const std::string named = f.s.path("t.csv");
  CHECK(f.error(missing) == "none.csv: cannot be read: no such file");
  CHECK(k_r({{"/sweep/sample/table=" + named}, "full"}) == std::vector<double>{5, 10});
  CHECK(k_r({{"/sweep/sample={\"table\":\"" + named + "\"}"}, "full"}) == std::vector<double>{5, 10});
  CHECK(k_r({{"/sweep/sample/table=null", "/sweep/sample/table=" + named}, "full"}) ==
        std::vector<double>{5, 10});
  CHECK(k_r({{"/sweep/sample/table=" + named, "/sweep/sample/table/rows/1/0=7"}, "full"}) ==
        std::vector<double>{5, 7});
  CHECK(load_experiment(f.s.path("e.json"), {{"/sweep/sample=null"}, "full"}).sweep.size() == 1);

  // By a tier, and by an experiment that extends another one.
  f.error(missing.substr(0, missing.size()) + R"(, "tiers": {"smoke": {"sweep": )" + with_table +
          R"(t.csv"}}}})");
  CHECK(k_r({{}, "smoke"}) == std::vector<double>{5, 10});
  f.error(with_table + R"(t.csv"}}, "tiers": {"smoke": {"sweep": )" + missing + "}}");
  CHECK(k_r({{}, "full"}) == std::vector<double>{5, 10});
  f.error(missing);
  const auto child = [&](const std::string& sweep) {
    return load_experiment(
        f.s.write("child.json", fmt::format(R"({{"extends": "e.json", "sweep": {}}})", sweep)), {});
  };
  CHECK(column(child(with_table + R"(t.csv"}})"), "k_r") == std::vector<double>{5, 10});
  CHECK(child(R"({"sample": null})").sweep.size() == 1);
  f.load(with_table + R"(t.csv"}})");
  CHECK(column(child(R"({"sample": {"table": {"rows": [[3]]}}})"), "k_r") == std::vector<double>{3});
}

TEST_CASE("tables of other programs: line ends, and an index without a name") {
  const Folder f;
  const std::vector<double> expected = {5, 10};
  for (const char* text :
       {"k_r,mu_c\r5,1\r10,2\r", "k_r,mu_c\r\n5,1\r\n10,2\r\n", ",k_r,mu_c\n0,5,1\n1,10,2\n",
        "\"\",k_r,mu_c\na,5,1\n,10,2\n", "Unnamed: 0,k_r,mu_c\n0,5,1\n1,10,2\n"}) {
    f.s.write("t.csv", text);
    CHECK(column(f.load(R"({"sample": {"table": "t.csv"}})"), "k_r") == expected);
  }
}

TEST_CASE("rows of a table and values of a distribution that have another type are explained") {
  const Folder f;
  const auto table = [&](const std::string& rows) {
    return f.error(R"({"sample": {"table": {"columns": ["k_r"], "rows": )" + rows + "}}}");
  };
  CHECK_THAT(table("[[1], true]"),
             Catch::Contains("/sweep/sample/table/rows/1: true is not allowed; allowed: an "
                             "array, each a number or a string"));
  CHECK_THAT(table("[[1], [null]]"),
             Catch::Contains("/sweep/sample/table/rows/1/0: null is not allowed; allowed: "
                             "a number or a string"));
  CHECK_THAT(table("7"),
             Catch::Contains("/sweep/sample/table/rows: 7 is not allowed; allowed: an array of at "
                             "least 1, each an array, each a number or a string"));
  CHECK_THAT(f.error(sobol(R"("k_r": {"values": true})")), Catch::Contains("allowed: an array"));
}

TEST_CASE("numbers at the edge of double: no text of a library") {
  const Folder f;
  const auto table = [&](const std::string& number) {
    f.s.write("t.csv", "k_r\n" + number + "\n");
    return f.error(R"({"sample": {"table": "t.csv"}})");
  };
  CHECK(table("1e400") == "t.csv: line 2: 1e400 is beyond the largest number, 1.8e308");
  CHECK(table("-1e400") == "t.csv: line 2: -1e400 is beyond the largest number, 1.8e308");
  CHECK(table("1e-400") ==
        "t.csv: line 2: 0 is out of range for k_r; allowed: a number greater than 0 (radial "
        "stiffness, dimensionless)");
  for (const char* over : {R"("k_r": {"uniform": [1e-320, 1e-310]})", R"("k_r": {"log": [1e-310, 1e-300]})",
                           R"("mu_c": {"uniform": [1e-320, 1e-310]})",
                           R"("tau_f": {"uniform": [1e307, 1.797693134862315e308]})"})
    CHECK_NOTHROW(f.load(sobol(over)));
  const std::string beyond = "or the width or ratio of their range, are beyond the largest number, 1.8e308";
  CHECK_THAT(f.error(sobol(R"("k_r": {"uniform": [-1e308, 1.7e308]})")), Catch::Contains(beyond));
  CHECK_THAT(f.error(sobol(R"("k_r": {"log": [1e-320, 1e300]})")), Catch::Contains(beyond));
  CHECK_THAT(f.error(R"({"k_r": {"logspace": [1e-300, 1e300, 5]}})"),
             Catch::Contains("beyond the largest number"));
  CHECK_THAT(f.error(R"({"k_r": {"linspace": [-1.7e308, 1.7e308, 5]}})"),
             Catch::Contains("beyond the largest number"));
  CHECK_THAT(f.error(R"({"k_r": {"values": [1, 1e400]}})"),
             Catch::Contains("e.json: 1e400 is beyond the largest number, 1.8e308"));
  CHECK(rounded(2.2250738585072014e-308) == 2.225074e-308);
  CHECK(rounded(1.7976931348623157e308) == 1.797693e308);
}

TEST_CASE("malformed samples: the message names place, value and remedy") {
  const Folder f;
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
  const Folder f;
  CHECK(f.error(R"({"k_r": {"values": [1]}, "sample": {"table": {"columns": ["k_r"], "rows": [[1]]}}})") ==
        "e.json: /sweep/sample: k_r is varied by another axis, too; remove one of them");
  CHECK(f.error(R"({"sample": {"table": {"columns": ["z_0", "R_n"], "rows": [[0.5, 1]]}}})")
            .find("more than one of R_n, z_0") != std::string::npos);
}

TEST_CASE(
    "two sets of SI quantities with equal dimensionless groups give equal bits: the model has no scale") {
  // The second row is the first in other units of length (2), mass (4) and speed (8); these powers of two are
  // exact, and so are the groups. The third row has a greater shaft: the comparison can fail.
  Folder f;
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

TEST_CASE("the result of a sample: its quantities are variables over it, first in the exported table") {
  const Folder f;
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

TEST_CASE("Sobol indices and quantiles are stored with the result of a sample") {
  const Folder f;
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
  const Folder f;
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

TEST_CASE("an index of too few points is missing, and the text says what to do") {
  const Folder f;
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
  const Folder f;
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

}  // namespace bristle::sample_test
