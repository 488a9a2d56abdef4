#include "archive/citation.hpp"
#include "archive/tar.hpp"
#include "compare/reference.hpp"
#include "cli/commands.hpp"
#include "results/journal.hpp"
#include "util/error.hpp"
#include "util/process.hpp"
#include "bristle/sanitizer.hpp"
#include "catch.hpp"
#include "small_result.hpp"

#include <random>

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

TEST_CASE("every reader refuses a file with cycles, links or sizes that have no end") {
  const Scratch s;
  const auto refused = [&](const std::function<void(hid_t file)>& change) {
    const std::string path = small_result(s, "r.h5");
    change(h5::open_file(path, true));
    CHECK_FALSE(up_to_date(path, small_experiment(s)));
    CHECK_THROWS_AS(ResultReader(path), InputError);
    CHECK_THROWS_WITH(ResultReader(path), Contains("r.h5: damaged, or not written by bristle: "));
    CHECK_THROWS_AS(info_command({path}), InputError);
  };
  refused([](hid_t file) {
    h5::check(H5Lcreate_hard(file, "/", file, "loop", H5P_DEFAULT, H5P_DEFAULT), "linking");
  });
  refused([](hid_t file) {
    h5::check(H5Lcreate_external("/etc/passwd", "/x", file, "elsewhere", H5P_DEFAULT, H5P_DEFAULT),
              "linking");
  });
  const auto large = [](hid_t file, bool deflated) {
    const hsize_t size = hsize_t(1) << 40, chunk = 1024;
    const h5::Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose, "space");
    const h5::Handle how(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "properties");
    if (deflated) h5::check(H5Pset_chunk(how, 1, &chunk), "chunks");
    if (deflated) h5::check(H5Pset_deflate(how, 9), "deflate");
    const h5::Handle data(H5Dcreate2(file, "large", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, how, H5P_DEFAULT),
                          H5Dclose, "dataset");
  };
  refused([&](hid_t file) { large(file, false); });
  refused([&](hid_t file) { large(file, true); });
}

TEST_CASE("randomly damaged results are refused or read, within the limits of time and memory") {
  const Scratch s;
  const std::string bytes = bytes_of(small_result(s, "r.h5"));
  std::mt19937 random(11);
  for (int i = 0; i < 40; ++i) {
    std::string changed = bytes;
    for (int k = 0; k < 4; ++k) changed[random() % changed.size()] ^= char(1 << random() % 8);
    const std::string path = s.write("changed.h5", changed);
    try {
      evaluate_checks(ResultReader(path));
    } catch (const InputError&) {
    } catch (const RunError&) {
    }
  }
}

TEST_CASE("work in a child process ends at its limits of time and memory") {
  const auto endless = []() -> std::string {
    for (volatile bool on = true; on;) continue;
    return "";
  };
  CHECK_THROWS_WITH(run_isolated(endless, {1, 1 << 20}), Contains("takes more than 1 s"));
  const auto large = [] { return std::to_string(std::vector<char>(std::size_t(1) << 31, 'x').size()); };
  if (!kSanitized) CHECK_THROWS_AS(run_isolated(large, {10, 1 << 20}), MalformedError);
  CHECK(run_isolated([] { return std::string("done"); }, {1, 1 << 26}) == "done");
}

TEST_CASE("what is damaged is said before any verdict: numbers, experiment, /checks") {
  const Scratch s;
  const auto damage = [&](const std::function<void(const std::string& path)>& change) {
    const std::string path = small_result(s, "r.h5");
    CHECK_NOTHROW(ResultReader(path).require_intact());
    change(path);
    CHECK_FALSE(up_to_date(path, small_experiment(s)));
    const ResultReader result(path);
    CHECK_THROWS_AS(result.require_intact(), InputError);
    CHECK_THROWS_WITH(result.require_intact(), Contains("r.h5: damaged: ") && Contains("bristle run"));
    CHECK(info_command({path}) == 1);
    return result.damage().front();
  };
  for (const double wrong : {7.0, kNone})
    CHECK(damage([&](const std::string& path) {
            put(path, "R_x", {0, 1}, wrong);
          }) == "payload_sha256 DOES NOT MATCH the numbers");
  CHECK(damage([](const std::string& path) { set_attribute(path, "experiment", std::string("{}")); }) ==
        "experiment_sha256 DOES NOT MATCH the experiment");
  CHECK_THAT(damage([](const std::string& path) { make_list(path, "experiment", 2, true); }),
             Contains("experiment is not a single value"));
  CHECK_THAT(damage([](const std::string& path) { add_dataset(path, "checks", {1}); }),
             Contains("/checks cannot be read"));
}

TEST_CASE("malformed: an attribute that is an array instead of one value") {
  const Scratch s;
  const std::string path = small_result(s, "r.h5");
  make_list(path, "numerics_version", 1000, false);
  make_list(path, "title", 1000, true);
  const ResultReader result(path);
  for (const char* name : {"numerics_version", "title"}) CHECK(result.has_text(name));
  CHECK_THROWS_WITH(result.integer("numerics_version"), Contains("numerics_version is not a single value"));
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
    CHECK_THROWS_AS(read_record(ResultReader(path), e.sweep, 5), RunError);
  }
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
  PointRecord record = record_of(layout_of(e.sweep), small_point(0), {});
  CHECK(is_consistent(record));
  double& at_status = record.values[record.layout->number("status")];
  for (const double status : {-1.0, 0.5, 99.0, 1e300, kNone}) {
    at_status = status;
    CHECK_FALSE(is_consistent(record));
  }
  at_status = 0;
  record.tables.emplace_back();
  CHECK_FALSE(is_consistent(record));
  record.tables.clear();
  record.values.push_back(0);
  CHECK_FALSE(is_consistent(record));
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
