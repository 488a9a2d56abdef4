#include "sample_folder.hpp"
#include "sampling/rounded.hpp"

#include "catch.hpp"
#include <fmt/format.h>
#include <filesystem>

namespace bristle::sample_table_test {
using namespace testing;

TEST_CASE("a row of a table is the same point as the same values on axes") {
  const SampleFolder f;
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
  const SampleFolder f;
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
  const SampleFolder f;
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
  const SampleFolder f;
  const std::vector<double> expected = {5, 10};
  for (const char* text :
       {"k_r,mu_c\r5,1\r10,2\r", "k_r,mu_c\r\n5,1\r\n10,2\r\n", ",k_r,mu_c\n0,5,1\n1,10,2\n",
        "\"\",k_r,mu_c\na,5,1\n,10,2\n", "Unnamed: 0,k_r,mu_c\n0,5,1\n1,10,2\n"}) {
    f.s.write("t.csv", text);
    CHECK(column(f.load(R"({"sample": {"table": "t.csv"}})"), "k_r") == expected);
  }
}

TEST_CASE("rows of a table and values of a distribution that have another type are explained") {
  const SampleFolder f;
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
  const SampleFolder f;
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

}  // namespace bristle::sample_table_test
