#include "run/slow_points.hpp"

#include "catch.hpp"
#include <chrono>
#include <thread>

namespace bristle::slow_points_test {
using run::SlowPoints;
using Found = std::vector<std::pair<std::size_t, double>>;

TEST_CASE("slow points: points that are solved together share the processor time equally") {
  SlowPoints points(7);
  points.begin(3);
  points.begin(5);
  CHECK(points.found_after(7 + 600) == Found{});  // 300 s each
  CHECK(points.found_after(7 + 600) == Found{});  // the processors did something else
  CHECK(points.found_after(7 + 602) == Found{{3, 301}, {5, 301}});
  CHECK(points.found_after(7 + 900) == Found{});  // each point once
}

TEST_CASE("slow points: ten times the mean of the points that have ended") {
  SlowPoints points(0);
  for (std::size_t i = 0; i < 4; ++i) {
    points.begin(i);
    CHECK(points.found_after(100. * double(i + 1)).empty());
    points.end(i);
  }
  points.begin(4);
  CHECK(points.found_after(400 + 301).empty());  // mean: 175 s
  for (std::size_t i = 5; i < 45; ++i) {
    points.begin(i);
    points.end(i);
  }
  CHECK(points.found_after(400 + 302) == Found{{4, 302}});  // mean: 16 s
}

TEST_CASE("slow points: the processor time of this process stands still while it sleeps") {
  const double before = run::processor_seconds();
  volatile double sum = 0;
  while (run::processor_seconds() < before + 0.02) sum = sum + 1;
  const double after = run::processor_seconds();
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  CHECK(run::processor_seconds() - after < 0.2);
}

}  // namespace bristle::slow_points_test
