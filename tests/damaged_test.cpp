#include "archive/citation.hpp"
#include "archive/tar.hpp"
#include "checks/reference_file.hpp"
#include "cli/inspect.hpp"
#include "results/journal.hpp"
#include "util/error.hpp"
#include "parts.hpp"

// Malformed files cause an error that names the file, and never an access out of bounds.
namespace bristle::damaged_test {
using namespace testing;
using Catch::Contains;

namespace {

// Replaces an attribute by an array of count strings or numbers.
void make_list(const std::string& path, const std::string& name, hsize_t count, bool texts) {
  const h5::Handle file = h5::open_file(path, true);
  const h5::Handle type(H5Tcopy(texts ? H5T_C_S1 : H5T_NATIVE_LONG), H5Tclose, "type");
  if (texts) h5::check(H5Tset_size(type, 64), "size");
  const h5::Handle space(H5Screate_simple(1, &count, nullptr), H5Sclose, "space");
  h5::check(H5Adelete(file, name.c_str()), "removing");
  const h5::Handle attribute(H5Acreate2(file, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                             "creating");
  const std::vector<char> zeros(count * 64);
  h5::check(H5Awrite(attribute, type, zeros.data()), "writing");
}

void replace_dataset(const std::string& path, const std::string& name, const h5::Shape& shape) {
  remove_dataset(path, name);
  add_dataset(path, name, shape);
}

template <class Value>
void set_attribute(const std::string& path, const std::string& name, const Value& value) {
  h5::write_attribute(h5::open_file(path, true), name, value);
}

}  // namespace

TEST_CASE("malformed: an attribute that is an array instead of one value") {
  const Scratch s;
  const std::string path = small_result(s, "r.h5");
  make_list(path, "numerics_version", 1000, false);
  make_list(path, "title", 1000, true);
  const ResultReader result(path);
  for (const char* name : {"numerics_version", "title"}) CHECK(h5::has_attribute(result.file(), name));
  CHECK_THROWS_WITH(h5::read_number_attribute(result.file(), "numerics_version"),
                    Contains("numerics_version is not a single value"));
  CHECK_THROWS_AS(h5::read_integer_attribute(result.file(), "numerics_version"), RunError);
  CHECK_THROWS_WITH(result.text("title"), Contains("title is not a single value"));
}

TEST_CASE("the name of a dimension scale is a list instead of one text") {
  const Scratch s;
  const std::string path = small_result(s, "r.h5");
  {
    const h5::Handle file = h5::open_file(path, true), scale = h5::open_dataset(file, "k_r");
    const hsize_t count = 1000;
    const h5::Handle space(H5Screate_simple(1, &count, nullptr), H5Sclose, "space");
    h5::check(H5Adelete(scale, "NAME"), "removing");
    const h5::Handle name(H5Acreate2(scale, "NAME", H5T_NATIVE_LONG, space, H5P_DEFAULT, H5P_DEFAULT),
                          H5Aclose, "creating");
    const std::vector<long> zeros(count);
    h5::check(H5Awrite(name, H5T_NATIVE_LONG, zeros.data()), "writing");
  }
  CHECK_THROWS_WITH(ResultReader(path).variable("R_x"), Contains("NAME is not a single value"));
}

TEST_CASE("malformed: an attribute that is not text in UTF-8") {
  const Scratch s;
  const std::string path = small_result(s, "r.h5");
  set_attribute(path, "title", std::string("\xff"));
  CHECK_THROWS_WITH(ResultReader(path).text("title"), Contains("title is not text in UTF-8"));
}

TEST_CASE("malformed: a dataset with more or fewer dimensions than the sweep") {
  const Scratch s;
  const Experiment e = small_experiment(s);
  for (const h5::Shape& shape : {h5::Shape{}, h5::Shape{6}, h5::Shape{2, 3, 1}}) {
    const std::string path = small_result(s, "r.h5");
    replace_dataset(path, "R_x", shape);
    CHECK_THROWS_AS(read_record(ResultReader(path).file(), e, 5), RunError);
  }
}

TEST_CASE("malformed: a part with invalid or unsorted indices of points") {
  const Scratch s;
  const Experiment e = sharded(s);
  for (const double wrong : {-1.0, 0.5, 1e300, kNone, 4.0}) {
    const std::string path = write_part(s, e, {1, 2});  // 0, 2, 4
    remove_dataset(path, "part/points");
    add_dataset(path, "part/points", {3});
    const double points[] = {0, wrong, 4};
    for (hsize_t i = 0; i < 3; ++i) put(path, "part/points", {i}, points[i]);
    CHECK_THROWS_WITH(ResultReader(path, Expected::part).part_points(), Contains("part/points"));
  }
  const std::string path = write_part(s, e, {1, 2});
  replace_dataset(path, "part/points", {});
  CHECK_THROWS_AS(ResultReader(path, Expected::part).part_points(), RunError);
}

TEST_CASE("malformed: info of a part with indices beyond the sweep") {
  const Scratch s;
  const std::string path = write_part(s, sharded(s), {1, 2});
  put(path, "part/points", {2}, 1000);
  CHECK_THROWS_WITH(info_command(path), Contains("are inconsistent"));
}

TEST_CASE("malformed: a result with an invalid experiment or invalid checks") {
  const Scratch s;
  const std::string path = small_result(s, "r.h5");
  const Json document = ResultReader(path).experiment();
  for (const char* text : {"1", "[]", "null", "\"x\"", "{"}) {
    set_attribute(path, "experiment", text);
    CHECK_THROWS_AS(ResultReader(path).experiment(), InputError);
  }
  for (const char* checks : {"5", "[{}]", R"([{"claim": "x"}])", R"([[]])"}) {
    Json changed = document;
    changed["checks"] = Json::parse(checks);
    set_attribute(path, "experiment", changed.dump());
    CHECK_THROWS_AS(evaluate_checks(ResultReader(path)), InputError);
  }
}

TEST_CASE("malformed: a variable with fewer errors than values") {
  const Scratch s;
  const std::string path = small_result(s, "r.h5");
  replace_dataset(path, "R_x_norm_err", {1});
  CHECK_THROWS_WITH(evaluate_checks(ResultReader(path)), Contains("R_x_norm_err has 1 values, not 6"));
}

TEST_CASE("malformed: a journal line with an unknown status or table") {
  const Scratch s;
  const Experiment e = small_experiment(s);
  PointRecord record = record_of(e, small_point(0), {});
  CHECK(fits(record, e));
  for (const double status : {-1.0, 0.5, 99.0, 1e300, kNone}) {
    record.values["status"] = {status};
    CHECK_FALSE(fits(record, e));
  }
  record.values["status"] = {0};
  record.tables["no_such"] = {};
  CHECK_FALSE(fits(record, e));
}

TEST_CASE("malformed: a reference with excessive nesting or a duplicate key") {
  const Scratch s;
  const std::string deep = std::string(200000, '[') + std::string(200000, ']');
  CHECK_THROWS_AS(read_reference(s.write("r.json", R"({"schema": )" + deep + "}")), InputError);
  CHECK_THROWS_WITH(read_reference(s.write("r.json", R"({"schema": "a", "schema": "b"})")),
                    Contains("r.json") && Contains("twice"));
}

TEST_CASE("malformed: an experiment that extends an impossible file name") {
  const Scratch s;
  const std::string path = s.write("e.json", R"({"extends": ")" + std::string(5000, 'x') + R"("})");
  CHECK_THROWS_WITH(load_experiment(path, {}), Contains("/extends") && Contains("e.json"));
  CHECK_THROWS_AS(load_experiment(path, {}), InputError);
}

}  // namespace bristle::damaged_test
