#include "compare/comparison.hpp"
#include "compare/replay.hpp"
#include "results/csv.hpp"
#include "shards.hpp"

#include "catch.hpp"
#include <atomic>
#include <cstdlib>
#include <new>

namespace {
std::atomic<std::size_t> allocated_bytes = 0;

void* counted(std::size_t bytes) noexcept {
  allocated_bytes += bytes;
  return std::malloc(bytes > 0 ? bytes : 1);
}

void* counted_or_thrown(std::size_t bytes) {
  if (void* memory = counted(bytes)) return memory;
  throw std::bad_alloc();
}
}  // namespace

// In place of those of the library, for the whole program: every new whose memory a delete below may free.
// The address sanitizer ends the program where a delete of the test frees the memory of a new of the library.
void* operator new(std::size_t bytes) { return counted_or_thrown(bytes); }
void* operator new[](std::size_t bytes) { return counted_or_thrown(bytes); }
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept { return counted(bytes); }
void* operator new[](std::size_t bytes, const std::nothrow_t&) noexcept { return counted(bytes); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

namespace bristle::scaling_test {
using namespace testing;

namespace {

// A result of this many rows of a table, which are in the given order, and another in the opposite order.
struct ManyPoints {
  explicit ManyPoints(std::size_t rows) {
    s.write("paper.json", bytes_of(std::string(BRISTLE_EXPERIMENTS) + "/paper.json"));
    std::string up = "k_r,friction\n", down = up;
    for (std::size_t i = 0; i < rows; ++i) {
      up += fmt::format("{},nss\n", 5 + 0.01 * double(i));
      down += fmt::format("{},nss\n", 5 + 0.01 * double(rows - 1 - i));
    }
    experiment = of("up", up);
    a = small_result(s, "a.h5", *experiment);
    b = small_result(s, "b.h5", of("down", down));
    Journal journal(s.path("a.h5.journal"), kCommit, false);
    for (std::size_t i = 0; i < rows; ++i)
      journal.append(point_key(experiment->sweep, i),
                     record_of(layout_of(experiment->sweep), small_point(i), {}));
  }

  Experiment of(const std::string& name, const std::string& table) const {
    s.write(name + ".csv", table);
    return load_experiment(
        s.write(name + ".json", R"({"extends": "paper.json", "name": "n", "sweep": {"sample": {"table": ")" +
                                    name + R"(.csv"}}})"),
        {});
  }

  Scratch s;
  std::optional<Experiment> experiment;
  std::string a, b;
};

// The memory that is allocated, all in all, for a result of this many points.
std::size_t bytes_for(std::size_t points, const std::function<void(const ManyPoints&)>& task) {
  const ManyPoints many(points);
  const std::size_t before = allocated_bytes;
  task(many);
  return allocated_bytes - before;
}

// Whatever is read or copied again for every point grows with the square of their number.
void require_proportional(const std::function<void(const ManyPoints&)>& task) {
  const std::size_t few = bytes_for(500, task), many = bytes_for(2000, task);
  CAPTURE(few, many);
  CHECK(many < 5 * few);
}

}  // namespace

TEST_CASE("the work on a finished result is proportional to its points") {
  SECTION("commands of all points")
  require_proportional([](const ManyPoints& m) { ReplayCommands(ResultReader(m.a)).of_all_points(); });
  SECTION("the experiment in it")
  require_proportional([](const ManyPoints& m) {
    experiment::stored_experiment(ResultReader(m.a).experiment(), "full", m.a);
  });
  SECTION("its checks") require_proportional([](const ManyPoints& m) { evaluate_checks(ResultReader(m.a)); });
  SECTION("its table")
  require_proportional([](const ManyPoints& m) {
    const ResultReader result(m.a);
    csv_text(result, table_of(result, ""));
  });
  SECTION("comparing it with a result of the same rows in another order")
  require_proportional([](const ManyPoints& m) {
    CHECK(diff_results(ResultReader(m.a), ResultReader(m.b), {}).failures.empty());
  });
  SECTION("its reference")
  require_proportional([](const ManyPoints& m) {
    const ResultReader result(m.a);
    const Reference reference = make_reference(result, {});
    CHECK(compare_with_reference(result, {}, reference, "the reference").agree());
  });
  SECTION("the points of its journal")
  require_proportional([](const ManyPoints& m) {
    const Journal journal(m.s.path("a.h5.journal"), kCommit, false);
    const KeyedPoints points(m.experiment->sweep, shard_points({}, m.experiment->sweep.size()));
    CHECK(points.missing_in(journal).empty());
  });
}

}  // namespace bristle::scaling_test
