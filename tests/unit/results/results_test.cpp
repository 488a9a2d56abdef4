#include "claims/checks.hpp"
#include "results/hdf5.hpp"
#include "results/reader.hpp"
#include "results/variables.hpp"
#include "results/writer.hpp"
#include "util/error.hpp"
#include "records.hpp"
#include "scratch.hpp"

#include <nlohmann/json.hpp>
#include "catch.hpp"
#include <chrono>
#include <cmath>
#include <numeric>
#include <random>
#include <thread>

namespace bristle::results_test {
using namespace testing;

namespace {

// A quick experiment: four points, a few listed azimuths, every passage recorded.
Experiment quick(const Scratch& s, const std::string& more = "") {
  s.write("paper.json", bytes_of(std::string(BRISTLE_EXPERIMENTS) + "/paper.json"));
  return load_experiment(
      s.write("quick.json", R"({"extends": "paper.json", "name": "quick", "load": {"R_n": null, "z_0": 0.5},
        "orientation": {"sampling": "list", "theta_0_deg": [10, 100, 170]}, "record": ["observables", "bristles"],
        "sweep": {"k_r": {"values": [5, 20]}, "k_phi": {"values": [1.5, 3]}})" +
                                more + "}"),
      {});
}

void write_all(ResultWriter& writer, const Experiment& e, int threads) {
  const auto records = all_records(e, threads);
  for (std::size_t i = 0; i < records.size(); ++i) writer.write(i, records[i]);
}

std::string run_to(const Experiment& e, const std::string& path, int threads) {
  ResultWriter writer(e, path);
  write_all(writer, e, threads);
  writer.close({{"host", path}});
  writer.publish();
  return ResultReader(path).text("payload_sha256");
}

}  // namespace

TEST_CASE("the payload does not depend on the number of threads or the path of the file", "[threads]") {
  const Scratch s;
  const Experiment e = quick(s);
  const std::string one = run_to(e, s.path("one.h5"), 1);
  CHECK(one.size() == 64);
  CHECK(run_to(e, s.path("two.h5"), 2) == one);
  CHECK(run_to(e, s.path("four.h5"), 4) == one);
}

TEST_CASE("1 and 2 threads give the same digest with quadrature and load control", "[threads]") {
  const Scratch s;
  s.write("paper.json", bytes_of(std::string(BRISTLE_EXPERIMENTS) + "/paper.json"));
  const Experiment e = load_experiment(
      s.write("load.json", R"({"extends": "paper.json", "name": "load", "orientation": {"rtol": 0.05},
        "integrator": {"rtol": 1e-4, "atol": 1e-6}, "sweep": {"k_r": {"values": [5, 20, 80]}}})"),
      {});
  CHECK(run_to(e, s.path("one.h5"), 1) == run_to(e, s.path("two.h5"), 2));
}

TEST_CASE("a sweep ends when it is stopped while threads share the passages of one point", "[threads]") {
  const Scratch s;
  s.write("paper.json", bytes_of(std::string(BRISTLE_EXPERIMENTS) + "/paper.json"));
  const Experiment e = load_experiment(
      s.write("one.json", R"({"extends": "paper.json", "name": "one", "load": {"R_n": null, "z_0": 0.5},
        "orientation": {"sampling": "lattice", "seed": 0, "rows": 2000}})"),
      {});
  std::size_t computed = 0, points = 0;
  SchedulerObserver observer;
  observer.passages = [&](std::size_t passages) { computed += passages; };
  const auto sink = [&](PointReport&&) { ++points; };
  CHECK_FALSE(run_sweep(
      e.sweep, {0}, 3, sink, [&] { return computed >= 300; }, observer));
  CHECK(computed >= 300);
  CHECK(points == 0);
}

TEST_CASE("equal runs with equal provenance give equal files byte for byte, as objects have no time stamps",
          "[threads]") {
  const Scratch s;
  const Experiment e = quick(s);
  run_to(e, s.path("r.h5"), 1);
  const std::string first = bytes_of(s.path("r.h5"));
  std::this_thread::sleep_for(
      std::chrono::milliseconds(1100));  // HDF5's time stamps have a resolution of seconds
  run_to(e, s.path("r.h5"), 2);
  CHECK((first == bytes_of(s.path("r.h5"))));
}

TEST_CASE("axes, values, bristles and attributes read back as written", "[threads]") {
  const Scratch s;
  const Experiment e = quick(s);
  run_to(e, s.path("r.h5"), 2);
  const ResultReader r(s.path("r.h5"));
  const Array& R_n = r.variable("R_n");
  CHECK(R_n.dimensions == std::vector<std::string>{"k_r", "k_phi"});
  CHECK(R_n.shape == std::vector<std::size_t>{2, 2});
  const PointInput last = e.sweep.point(3);
  const PointResult expected = solve_point(last.setup, last.loading, make_runner(Engine::fast));
  CHECK(R_n.values[3] == expected.value[bristle::R_N]);
  CHECK(r.variable("R_x_norm").values[3] == expected.R_x_norm.value);
  CHECK(r.experiment()["name"] == "quick");
  CHECK(r.variables().size() >= 2 * 13);
  CHECK(r.variable("bristles/theta_0").shape == std::vector<std::size_t>{12});
  CHECK(r.variable("bristles/theta_0").dimensions == std::vector<std::string>{"bristle"});
}

TEST_CASE("every variable has the descriptive attributes") {
  const Scratch s;
  run_to(quick(s), s.path("r.h5"), 1);
  const ResultReader r(s.path("r.h5"));
  for (const std::string& name : r.variables()) {
    CAPTURE(name);
    const h5::Handle dataset = h5::open_dataset(h5::open_file(s.path("r.h5"), false), name);
    for (const char* attribute : {"long_name", "units", "symbol", "equation"})
      CHECK(h5::has_attribute(dataset, attribute));
    CHECK(!h5::read_text_attribute(dataset, "long_name").empty());
  }
}

TEST_CASE("a run that fails leaves the previous result unchanged and no temporary file") {
  const Scratch s;
  const Experiment e = quick(s);
  run_to(e, s.path("r.h5"), 1);
  const std::string before = bytes_of(s.path("r.h5"));
  try {
    ResultWriter writer(e, s.path("r.h5"));
    writer.write(0, record_of(layout_of(e.sweep), PointResult{}, {}));
    throw RunError("a failure in the middle");
  } catch (const RunError&) {
  }
  CHECK(bytes_of(s.path("r.h5")) == before);
  CHECK(!std::filesystem::exists(s.path("r.h5.partial")));
}

TEST_CASE("output that cannot be written is refused before anything is computed") {
  const Scratch s;
  const Experiment e = quick(s);
  CHECK_THROWS_AS(ResultWriter(e, "/proc/nowhere/r.h5"), InputError);
  std::filesystem::create_directory(s.path("folder.h5"));
  CHECK_THROWS_WITH(ResultWriter(e, s.path("folder.h5")), Catch::Contains("is a folder"));
  s.write("file", "");
  CHECK_THROWS_WITH(ResultWriter(e, s.path("file/r.h5")), Catch::Contains("cannot be written"));
}

TEST_CASE("of two runs with one output file, the second is refused and changes nothing") {
  const Scratch s;
  const Experiment e = quick(s);
  const std::string undisturbed = run_to(e, s.path("alone.h5"), 1);
  ResultWriter first(e, s.path("r.h5"));
  write_all(first, e, 1);
  CHECK_THROWS_WITH(ResultWriter(e, s.path("r.h5")), Catch::Contains("another run is writing it"));
  first.close({});
  first.publish();
  CHECK(ResultReader(s.path("r.h5")).text("payload_sha256") == undisturbed);
}

TEST_CASE(
    "a result is up to date with the same inputs and undamaged numbers, regardless of title and checks") {
  const Scratch s;
  const std::string path = s.path("r.h5");
  CHECK(!up_to_date(path, quick(s)));
  run_to(quick(s), path, 1);
  CHECK(up_to_date(path, quick(s)));
  CHECK(up_to_date(path, quick(s, R"(, "title": "another")")));
  CHECK(!up_to_date(path, quick(s, R"(, "model": {"k_theta": 2})")));
  {
    h5::Handle file = h5::open_file(path, true);
    const h5::Handle dataset = h5::open_dataset(file, "R_n");
    const double wrong = 1;
    h5::write_part(dataset, H5T_NATIVE_DOUBLE, {0, 0}, {1, 1}, &wrong);
  }
  CHECK(!up_to_date(path, quick(s)));
  s.write("r.h5", "not HDF5");
  CHECK(!up_to_date(path, quick(s)));
}

TEST_CASE("files that are not results are refused with their name and the reason") {
  const Scratch s;
  CHECK_THROWS_WITH(ResultReader(s.path("none.h5")), Catch::Contains("no such file"));
  CHECK_THROWS_WITH(ResultReader(s.write("text.h5", "hello")), Catch::EndsWith("not an HDF5 file"));
  { const h5::Handle empty = h5::create_file(s.path("empty.h5")); }
  CHECK_THROWS_WITH(ResultReader(s.path("empty.h5")), Catch::Contains("not a result of bristle"));
  {
    const h5::Handle future = h5::create_file(s.path("future.h5"));
    h5::write_attribute(future, "schema_version", "bristle-result/9");
  }
  CHECK_THROWS_WITH(ResultReader(s.path("future.h5")), Catch::Contains("bristle-result/9"));
  run_to(quick(s), s.path("r.h5"), 1);
  CHECK_THROWS_WITH(ResultReader(s.path("r.h5")).variable("R_x_nrom"),
                    Catch::Contains("did you mean R_x_norm?"));
}

TEST_CASE("values written in blocks are at their places") {
  const Scratch s;
  const std::vector<h5::Shape> shapes = {{},         {70000},    {3, 20011},   {20011, 3},
                                         {40000, 1}, {1, 40000}, {7, 50, 200}, {5, 1, 8191}};
  std::mt19937 random(1);
  for (const h5::Shape& shape : shapes)
    for (const unsigned most : {300u, 30000u}) {  // values at a time
      std::size_t size = 1;
      for (const hsize_t n : shape) size *= std::size_t(n);
      const h5::Handle file = h5::create_file(s.path("blocks.h5"));
      h5::BlockWriter writer(h5::create_dataset(file, "x", H5T_NATIVE_DOUBLE, shape), shape);
      std::vector<double> expected(size), found(size, 0);
      std::iota(expected.begin(), expected.end(), 0.0);
      for (std::size_t place = 0; place < size;) {
        const auto first = expected.begin() + long(place);
        const std::size_t count = std::min(size - place, std::size_t(random() % most));
        writer.append({first, first + long(count)});
        place += count;
      }
      writer.flush();
      const h5::Handle dataset = h5::open_dataset(file, "x");
      h5::read_part(dataset, H5T_NATIVE_DOUBLE, h5::Shape(shape.size(), 0), shape, found.data());
      CHECK(found == expected);
    }
}

TEST_CASE("an experiment of more than 64 KiB is stored completely") {
  const Scratch s;
  std::string angles = "1";
  for (int i = 0; i < 20000; ++i) angles += ", 100.5";
  Experiment e = quick(s);
  Json document = *e.document;
  document["orientation"]["theta_0_deg"] = Json::parse("[" + angles + "]");
  e.document = std::make_shared<const Json>(document);
  ResultWriter writer(e, s.path("big.h5"));
  writer.close({});
  writer.publish();
  CHECK(ResultReader(s.path("big.h5")).experiment() == *e.document);
}

}  // namespace bristle::results_test
