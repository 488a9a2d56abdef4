// Points of a run that share passages: the numbers are those of points that compute all passages themselves.
#include "run/task.hpp"

#include "bristle/random.hpp"
#include "bristle/sanitizer.hpp"
#include "design/design.hpp"
#include "experiment/experiment.hpp"
#include "results/reader.hpp"
#include "results/record.hpp"
#include "generators.hpp"
#include "scratch.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <numeric>

namespace bristle::shared_passages_test {
using namespace testing;

namespace {

constexpr std::size_t kFew = 20'000;  // bytes of a memo with a few dozen passages

// Means over a few azimuths take a fraction of the time.
const std::string kFewAzimuths =
    R"("orientation": {"sampling": "list", "theta_0_deg": [10, 60, 90, 120, 170]})";

Experiment loaded(const Scratch& s, const std::string& more) {
  s.write("paper.json", bytes_of(std::string(BRISTLE_EXPERIMENTS) + "/paper.json"));
  return load_experiment(
      s.write("e.json", fmt::format(R"({{"extends": "paper.json", "name": "e", {}}})", more)), {});
}

// Two paths of two brushes under these loads.
Experiment loads_of_brushes(const Scratch& s, const std::string& R_n = "[0.5, 1, 1.5, 2]") {
  return loaded(s, fmt::format(R"("model": {{"bending": "rod"}}, "sweep": {{"path": {{"values":
      ["loading", "unloading"]}}, "k_r": {{"values": [8, 12]}}, "R_n": {{"values": {}}}}})",
                               R_n));
}

std::vector<std::size_t> all_points(const Sweep& sweep) {
  std::vector<std::size_t> points(sweep.size());
  std::iota(points.begin(), points.end(), 0);
  return points;
}

struct Computed {
  std::vector<PointRecord> records;  // by point
  std::size_t passages = 0;          // number of computed passages
};

// Computes these points. Stops when `most` passages have been computed.
Computed computed(const Sweep& sweep, const std::vector<std::size_t>& points, int threads, PassageMemo* memo,
                  std::size_t most = std::size_t(-1)) {
  Computed out{std::vector<PointRecord>(sweep.size())};
  SchedulerObserver observer;
  observer.passages = [&](std::size_t passages) { out.passages += passages; };
  run_sweep(
      sweep, points, threads, [&](PointReport&& r) { out.records[r.index] = std::move(r.record); },
      [&] { return out.passages >= most; }, observer, memo);
  return out;
}

// Returns the number of points whose records differ in any bit.
std::size_t different(const Computed& a, const Computed& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.records.size(); ++i)
    count += !differences(a.records[i], b.records[i]).empty();
  return count;
}

// Returns the number of passages of all points, computed or not.
std::size_t passages_of(const Computed& all) {
  std::size_t count = 0;
  for (const PointRecord& record : all.records) count += std::size_t(record.at("passages").front());
  return count;
}

}  // namespace

TEST_CASE("shared passages: points of a brush compute each passage once, with equal bits", "[threads]") {
  const Scratch s;
  const Experiment e = loads_of_brushes(s);
  const std::vector<std::size_t> points = all_points(e.sweep);
  const Computed alone = computed(e.sweep, points, 1, nullptr);
  CHECK(alone.passages == passages_of(alone));
  std::set<std::size_t> passages;
  for (const int threads : {1, 2, 3}) {
    PassageMemo memo;
    const Computed shared = computed(e.sweep, points, threads, &memo);
    CHECK(different(alone, shared) == 0);
    passages.insert(shared.passages);
    CHECK(shared.passages < 0.9 * alone.passages);
    if (!kSanitized) CHECK(memo.size() == shared.passages);
    // The memo outlives the call: only the passages of new gaps are computed.
    CHECK(computed(e.sweep, points, threads, &memo).passages == 0);
    const Experiment between = loads_of_brushes(s, "[1.2]");
    const std::vector<std::size_t> some = all_points(between.sweep);
    const Computed later = computed(between.sweep, some, threads, &memo);
    CHECK(different(computed(between.sweep, some, 1, nullptr), later) == 0);
    CHECK(later.passages < 0.8 * passages_of(later));
  }
  if (!kSanitized) CHECK(passages.size() == 1);
}

TEST_CASE("shared passages: the reference engine shares them, too", "[threads]") {
  const Scratch s;
  const Experiment e = loaded(s, R"("integrator": {"engine": "reference"}, "load": {"R_n": null, "z_0": 0.5},
      "sweep": {"concentration": {"values": [1, 2, 3]}},
      "orientation": {"distribution": "von_mises", "concentration": 1, "mean_deg": 0, "rtol": 0.2})");
  const Computed alone = computed(e.sweep, {0, 1, 2}, 1, nullptr);
  for (const int threads : {1, 2}) {
    PassageMemo memo;
    const Computed shared = computed(e.sweep, {0, 1, 2}, threads, &memo);
    CHECK(different(alone, shared) == 0);
    if (threads == 1) CHECK(shared.passages < alone.passages * 2 / 3);
  }
}

TEST_CASE("property: any loads, paths and friction laws have equal bits, with any memory, threads and order",
          "[threads]") {
  const Scratch s;
  rc::prop("records with and without a memo", [&] {
    const double R_n = uniform(0.2, 2);
    const Experiment e = loaded(
        s, fmt::format(R"("model": {{"bending": "{}", "k_r": {}}}, "sweep": {{"path": {{"values": ["loading",
            "unloading"]}}, "R_n": {{"values": [{}, {}]}}, "friction": {{"values": ["nss", "coulomb"]}}}}, {})",
                       *rc::gen::element("polar", "polar_as_printed", "rod"), uniform(5, 20), R_n,
                       R_n + uniform(0.1, 1), kFewAzimuths));
    std::vector<std::size_t> points = all_points(e.sweep);
    const Computed alone = computed(e.sweep, points, 1, nullptr);
    const auto seed = *rc::gen::arbitrary<std::uint64_t>();
    std::ranges::sort(points, {}, [&](std::size_t i) { return split_mix(seed + i); });
    for (const int threads : {1, 3}) {
      PassageMemo memo(*rc::gen::element(std::size_t(500), kFew, kMemoBytes));
      RC_ASSERT(different(alone, computed(e.sweep, points, threads, &memo)) == 0u);
    }
  });
}

TEST_CASE("shared passages: a sweep that is stopped or fails leaves a memo that can be used", "[threads]") {
  const Scratch s;
  const Experiment e = loads_of_brushes(s);
  const std::vector<std::size_t> points = all_points(e.sweep);
  const Computed alone = computed(e.sweep, points, 1, nullptr);
  PassageMemo memo;
  for (const std::size_t most : {0, 1, 100, 1000, 3000}) computed(e.sweep, points, 3, &memo, most);
  struct Full {};
  CHECK_THROWS_AS(
      run_sweep(
          e.sweep, points, 3, [](PointReport&&) { throw Full{}; }, [] { return false; }, {}, &memo),
      Full);
  const Computed rest = computed(e.sweep, points, 3, &memo);
  CHECK(different(alone, rest) == 0);
  CHECK(rest.passages < alone.passages / 2);  // most are known from the runs that ended early
}

TEST_CASE("shared passages: results with jumps have equal digests, also if a run is resumed or has shards",
          "[threads]") {
  const Scratch s;
  const Experiment e =
      loaded(s, R"("model": {"bending": "rod"}, "locate_jumps": "R_n", "sweep": {"k_r": {"values": [12]},
      "R_n": {"values": [0.5, 1, 1.5]}})");
  const auto digest = [&](const RunOptions& options) {
    run_experiment(e, options);
    return ResultReader(options.output).text("payload_sha256");
  };
  const std::string alone =
      digest({.output = s.path("alone/r.h5"), .threads = 1, .quiet = true, .memo_bytes = 0});
  CHECK(ResultReader(s.path("alone/r.h5")).has("jumps"));
  for (const std::size_t bytes : {kFew, kMemoBytes})
    CHECK(digest({.output = s.path("shared/r.h5"),
                  .threads = 3,
                  .force = true,
                  .quiet = true,
                  .memo_bytes = bytes}) == alone);
  for (const std::size_t i : {1, 2})
    run_experiment(e, {.output = s.path("shards/r.h5"), .shard = Shard{i, 2}, .threads = 2, .quiet = true});
  CHECK(digest({.output = s.path("shards/r.h5"), .complete = true, .threads = 2, .quiet = true}) == alone);
}

TEST_CASE("shared passages: a design with several loads has an equal digest", "[threads]") {
  const Scratch s;
  const Experiment e =
      loaded(s, kFewAzimuths + R"(, "load": {"R_n": null}, "sweep": {"R_n": {"values": [0.8, 1, 1.2]}},
      "design": {"variables": {"k_r": [8, 30]}, "objectives": [{"minimise": "R_x_norm"}], "budget": 6,
                 "second_model": {"bending": "rod"}})");
  const auto digest = [&](std::size_t bytes) {
    const RunOptions options{
        .output = s.path("d.h5"), .threads = 2, .force = true, .quiet = true, .memo_bytes = bytes};
    design::run_design(e, options);
    return ResultReader(options.output).text("payload_sha256");
  };
  CHECK(digest(0) == digest(kMemoBytes));
}

}  // namespace bristle::shared_passages_test
