#include "results/dataset.hpp"
#include "util/error.hpp"
#include "json/json.hpp"

#include "catch.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

namespace bristle::dataset_test {
using namespace results;
using Catch::Contains;

TEST_CASE("dataset: arrays lie over all dimensions, and have words for codes and texts") {
  Dataset data("table");
  data.add_dimension(coordinates("model", "model of the brush", {"polar", "rod"}));
  data.add_axis("k_r", 3);
  CHECK(data.shape() == std::vector<std::size_t>{2, 3});
  data.add({"R_x", "friction", "R_x", "Eq. (5)"},
           [](std::size_t i) { return i == 4 ? NAN : 0.5 * double(i); });
  data.add({"place", "where"}, [](std::size_t i) { return "at " + std::to_string(i); });
  const Array& R_x = data.array("R_x");
  CHECK(R_x.dimensions == std::vector<std::string>{"model", "k_r"});
  CHECK(R_x.cell(3) == "1.5");
  CHECK(R_x.cell(4) == "");
  CHECK(data.array("place").about.number == Number::text);
  CHECK(data.array("place").cell(5) == "at 5");
  CHECK(data.dimension("model").cell(1) == "rod");
  CHECK(data.dimension("model").text(7) == "7");
  CHECK_THROWS_WITH(data.array("R_n"), Contains("R_n"));
  CHECK_THROWS_WITH(data.add(row_numbers("row", "", 5)), Contains("5 values, not 6"));
}

TEST_CASE("JSON: rows of numbers are taken out of the document") {
  std::map<std::string, NumberRows> rows;
  const std::string text = R"({"name": "x", "list": [1, 2], "items": [{"a": [[7]]}],
    "deep": {"of a/b": [[1.5, null], [], [-2]], "empty": [], "wrong": [[1], ["one", [2]], [{"b": 3}]]}})";
  const Json json = parse_json(text, rows);
  CHECK(json == Json::parse(R"({"name": "x", "list": [1, 2], "items": [{"a": []}],
                                "deep": {"of a/b": [], "empty": [], "wrong": []}})"));
  REQUIRE(rows.size() == 3);
  const NumberRows& found = rows.at("/deep/of a~1b");
  CHECK(found.plain);
  CHECK(found.ends == std::vector<std::size_t>{2, 2, 3});
  REQUIRE(found.values.size() == 3);
  CHECK(found.values[0] == 1.5);
  CHECK(std::isnan(found.values[1]));
  CHECK(rows.at("/items/a").values == std::vector<double>{7});
  CHECK_FALSE(rows.at("/deep/wrong").plain);
  CHECK_THROWS_AS(parse_json(R"({"a": [[1]], "a": [[2]]})", rows), InputError);
  CHECK_THROWS_AS(parse_json(R"({"a": [[1e400]]})", rows), InputError);
  CHECK_THROWS_WITH(parse_json(std::string(100, '['), rows), Contains("levels deep"));
}

}  // namespace bristle::dataset_test
