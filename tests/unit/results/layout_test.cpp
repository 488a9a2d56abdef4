#include "small_result.hpp"

#include "catch.hpp"

// Axes of choices contain words.
namespace bristle::layout_test {
using namespace testing;
using results::code_variable;

namespace {

Experiment with_choice(const Scratch& s) {
  s.write("paper.json", bytes_of(std::string(BRISTLE_EXPERIMENTS) + "/paper.json"));
  return load_experiment(s.write("laws.json", R"({"extends": "paper.json", "name": "laws",
        "sweep": {"friction": {"values": ["coulomb", "nss"]}, "k_r": {"values": [5, 20, 50]}},
        "checks": [{"claim": "x", "statement": "falls", "predicate": "end_ratio", "variable": "R_x_norm",
                    "along": "k_r", "where": {"friction": "nss"}, "is": "at_most", "threshold": 0.99}]})"),
                         {});
}

}  // namespace

TEST_CASE("the axis of a choice contains words, and readers get their codes") {
  const Scratch s;
  const ResultReader result(small_result(s, "laws.h5", with_choice(s)));
  result.require_intact();
  const h5::Handle file = h5::open_file(s.path("laws.h5"), false);
  CHECK(h5::is_text(h5::open_dataset(file, "friction")));
  CHECK_FALSE(h5::is_text(h5::open_dataset(file, code_variable("friction"))));
  CHECK(result.variable("friction").values == std::vector<double>{1, 0});
  const auto& laws = result.variable("friction").about.words;
  CHECK(std::vector(laws.begin(), laws.begin() + 2) == std::vector<std::string>{"nss", "coulomb"});
  CHECK(result.sweep_shape() == std::vector<std::size_t>{2, 3});
  CHECK(results::place(result, "R_x", 4) == "friction = nss, k_r = 20");
  const auto names = result.variables();
  CHECK(std::count(names.begin(), names.end(), "friction") == 1);
  CHECK(std::count(names.begin(), names.end(), code_variable("friction")) == 0);
}

TEST_CASE("a changed word on an axis does not match the digest") {
  const Scratch s;
  const std::string path = small_result(s, "laws.h5", with_choice(s));
  {
    const h5::Handle file = h5::open_file(path, true), words = h5::open_dataset(file, "friction");
    const h5::Handle type(H5Dget_type(words), H5Tclose, "");
    const char* texts[] = {"nss", "coulomb"};
    h5::write_part(words, type, {0}, {2}, texts);
  }
  const auto damage = ResultReader(path).damage();
  REQUIRE(damage.size() == 1);
  CHECK(damage[0] == "payload_sha256 DOES NOT MATCH the numbers");
}

}  // namespace bristle::layout_test
