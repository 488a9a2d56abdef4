#include "compare/comparison.hpp"
#include "results/datasets.hpp"
#include "results/texts.hpp"
#include "small_result.hpp"

#include "catch.hpp"
#include <hdf5_hl.h>

// Axes of choices: words in the layout of today, codes in that of version 1.
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

// Attaches another scale to the dimensions that have this one.
void exchange_scale(hid_t group, const char* name, hid_t was, hid_t now) {
  for (const std::string& child : h5::children(group)) {
    if (h5::is_group(group, child)) {
      exchange_scale(h5::open_group(group, child), name, was, now);
      continue;
    }
    const h5::Handle dataset = h5::open_dataset(group, child);
    for (unsigned d = 0; d < h5::shape_of(dataset).size(); ++d) {
      if (h5::is_scale(dataset) || h5::scale_name(dataset, d) != name) continue;
      REQUIRE(H5DSdetach_scale(dataset, was, d) >= 0);
      h5::attach_scale(dataset, now, d);
    }
  }
}

// Changes the file into one as programs wrote it before: the scale of the choice contains the codes.
void make_version_1(const std::string& path) {
  const h5::Handle file = h5::open_file(path, true);
  const std::string codes_name = code_variable("friction");
  {
    const h5::Handle words = h5::open_dataset(file, "friction"), codes = h5::open_dataset(file, codes_name);
    REQUIRE(H5DSdetach_scale(codes, words, 0) >= 0);
    h5::make_scale(codes, "friction");
    exchange_scale(file, "friction", words, codes);
  }
  h5::check(H5Ldelete(file, "friction", H5P_DEFAULT), "");
  h5::check(H5Lmove(file, codes_name.c_str(), file, "friction", H5P_DEFAULT, H5P_DEFAULT), "");
  h5::write_attribute(file, "schema_version", results::kOldResultSchema);
  h5::write_attribute(file, "payload_sha256", results::payload_sha256(file));
}

}  // namespace

TEST_CASE("the axis of a choice contains words, and readers get their codes") {
  const Scratch s;
  const ResultReader result(small_result(s, "laws.h5", with_choice(s)));
  result.require_intact();
  CHECK(results::is_text(h5::open_dataset(result.file(), "friction")));
  CHECK_FALSE(results::is_text(h5::open_dataset(result.file(), code_variable("friction"))));
  CHECK(result.variable("friction").values == std::vector<double>{1, 0});
  const auto laws = result.flag_meanings("friction");
  CHECK(std::vector(laws.begin(), laws.begin() + 2) == std::vector<std::string>{"nss", "coulomb"});
  CHECK(result.sweep_shape() == std::vector<std::size_t>{2, 3});
  CHECK(results::place(result, "R_x", 4) == "friction = nss, k_r = 20");
  const auto names = result.variables();
  CHECK(std::count(names.begin(), names.end(), "friction") == 1);
  CHECK(std::count(names.begin(), names.end(), code_variable("friction")) == 0);
}

TEST_CASE("results of layout version 1 are read like those of today, but are not up to date") {
  const Scratch s;
  const Experiment e = with_choice(s);
  const std::string now = small_result(s, "now.h5", e), old = small_result(s, "old.h5", e);
  make_version_1(old);
  const ResultReader a(now), b(old);
  b.require_intact();
  const Comparison diff = diff_results(a, b, {});
  INFO(comparison_text(diff));
  CHECK(diff.agree());
  CHECK(b.variable("friction").values == a.variable("friction").values);
  CHECK(evaluate_checks(b).at(0).measured.value == evaluate_checks(a).at(0).measured.value);
  CHECK(results::up_to_date(now, e));
  CHECK_FALSE(results::up_to_date(old, e));
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
