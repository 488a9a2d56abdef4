#include "run/jumps.hpp"

#include "shards.hpp"

#include <cmath>

namespace bristle::jumps_test {
using namespace testing;

constexpr const char* kAlong = R"(, "locate_jumps": "k_r")";

// The gap of every point of a sweep by a function of k_r and k_theta.
template <class Law>
std::vector<run::Gap> gaps(const Sweep& sweep, const std::vector<std::size_t>& points, Law law) {
  std::vector<run::Gap> out;
  for (const std::size_t i : points) {
    const Parameters p = sweep.point(i).setup.parameters;
    out.push_back(law(p.k_r, p.k_theta));
  }
  return out;
}

// The rows of /jumps, and the number of points that were solved for them.
template <class Law>
std::pair<Rows, std::size_t> located(const Experiment& e, Law law) {
  std::size_t solved = 0;
  Rows rows = run::locate_jumps(e.sweep, e.locate_jumps, gaps(e.sweep, shard_points({}, e.sweep.size()), law),
                                [&](const Sweep& between, const std::vector<std::size_t>& points) {
                                  solved += points.size();
                                  return gaps(between, points, law);
                                });
  return {rows, solved};
}

run::Gap gap(double z_0) { return {true, z_0}; }

TEST_CASE("jumps of the gap are located within 1 percent, each on its line of the sweep") {
  const Scratch s;
  const Experiment e = sharded(s, kAlong);
  const auto place = [](double k_theta) { return 11 + k_theta; };
  const auto [rows, solved] =
      located(e, [&](double k_r, double k_theta) { return gap(k_r < place(k_theta) ? 0.1 : 0.6); });
  REQUIRE(rows.size() == 8);
  CHECK(rows[0] == std::vector<double>{0, 1, 2});
  for (std::size_t i = 0; i < 3; ++i) {
    const double k_theta = e.sweep.axes[1].values[i];
    CAPTURE(k_theta);
    CHECK(rows[1][i] <= place(k_theta));
    CHECK(rows[2][i] >= place(k_theta));
    CHECK(std::sqrt(rows[1][i] * rows[2][i]) == Approx(place(k_theta)).epsilon(0.01));
  }
  CHECK(rows[3] == std::vector<double>(3, 0.1));
  CHECK(rows[4] == std::vector<double>(3, 0.6));
  CHECK(solved < 3 * 9);
}

TEST_CASE("all jumps between two points of the sweep are located, in ascending order") {
  const Scratch s;
  const Experiment e = sharded(s, kAlong, R"("k_r": {"values": [5, 20]})");
  const auto [rows, solved] = located(e, [](double k_r, double) {
    return gap(k_r < 7 ? 0.1 : k_r < 13 ? 0.35 : 0.7);
  });
  CHECK(rows[0] == std::vector<double>{0, 0});
  CHECK(rows[1][0] == Approx(7).epsilon(0.02));
  CHECK(rows[1][1] == Approx(13).epsilon(0.02));
}

TEST_CASE("the bisection towards a jump at zero ends") {
  const Scratch s;
  const Experiment e = sharded(s, R"(, "locate_jumps": "mu_c")", R"("mu_c": {"values": [0, 1]})");
  const auto law = [](const Sweep& x, const std::vector<std::size_t>& points) {
    std::vector<run::Gap> out;
    for (const std::size_t i : points) out.push_back(gap(x.point(i).setup.parameters.mu_c > 0 ? 0.6 : 0.1));
    return out;
  };
  std::size_t rounds = 0;
  const Rows rows =
      run::locate_jumps(e.sweep, "mu_c", law(e.sweep, {0, 1}), [&](const Sweep& x, const auto& points) {
        ++rounds;
        return law(x, points);
      });
  CHECK(rounds == 20);
  CHECK(rows[1] == std::vector<double>{0});
  CHECK(rows[2][0] < 1e-5);
}

TEST_CASE("the band of a jump reaches as far as the points beside it are ambiguous") {
  const Scratch s;
  const Experiment e = sharded(s, kAlong, R"("k_r": {"values": [5, 10, 20, 40]})");
  const auto [rows, solved] = located(e, [](double k_r, double) {
    return run::Gap{true, k_r < 14 ? 0.1 : 0.6, k_r > 9 && k_r < 14.5};
  });
  REQUIRE(rows[0].size() == 1);
  CHECK(rows[5][0] == 10);
  CHECK(rows[6][0] > 14);
  CHECK(rows[6][0] < 14.5);
  const auto [sharp, more] = located(e, [](double k_r, double) { return gap(k_r < 14 ? 0.1 : 0.6); });
  CHECK(sharp[5] == sharp[1]);
  CHECK(sharp[6] == sharp[2]);
}

TEST_CASE("a continuous gap has no jump") {
  const Scratch s;
  const Experiment e = sharded(s, kAlong);
  const auto [rows, solved] = located(e, [](double k_r, double) { return gap(0.4 * std::log(k_r)); });
  CHECK(rows == Rows(8));
  CHECK(solved == 3 * (1 + 2 + 4));  // 0.55, halved until less than 0.1
}

TEST_CASE("the place where a load becomes unreachable is located") {
  const Scratch s;
  const Experiment e = sharded(s, kAlong, R"("k_r": {"values": [5, 20]})");
  const auto [rows, solved] = located(e, [](double k_r, double) { return gap(k_r < 9 ? NAN : 0.2); });
  REQUIRE(rows[0].size() == 1);
  CHECK(rows[1][0] == Approx(9).epsilon(0.02));
  CHECK(std::isnan(rows[3][0]));
  CHECK(rows[4][0] == 0.2);
}

TEST_CASE("a point whose gap was not found is no side of a jump") {
  const Scratch s;
  const Experiment e = sharded(s, kAlong);
  const auto [rows, solved] = located(e, [](double k_r, double) {
    return k_r > 10 ? run::Gap{false, NAN} : gap(0.1);
  });
  CHECK(rows == Rows(8));
  CHECK(solved == 0);
}

TEST_CASE("a result completed from shards has the jumps between their points", "[threads]") {
  const Scratch s;
  const Experiment e = sharded(s, kAlong + std::string(R"(, "orientation": {"rtol": 0.05})"),
                               R"("k_r": {"values": [16, 26]})");
  for (const Shard shard : {Shard{1, 2}, Shard{2, 2}})
    run_experiment(e, {.output = s.path("small/r.h5"), .shard = shard, .threads = 1, .quiet = true});
  const std::string digest = completed(s, e);
  const ResultReader result(s.path("small/r.h5"));
  const auto before = result.variable("jumps/before").values, after = result.variable("jumps/after").values;
  REQUIRE(!before.empty());
  CHECK(h5::read_text_attribute(h5::open_group(h5::open_file(s.path("small/r.h5"), false), "jumps"),
                                "along") == "k_r");
  for (std::size_t i = 0; i < before.size(); ++i) CHECK(after[i] / before[i] < 1.021);
  run_experiment(e, {.output = s.path("whole.h5"), .threads = 2, .quiet = true});
  CHECK(ResultReader(s.path("whole.h5")).text("payload_sha256") == digest);
}

}  // namespace bristle::jumps_test
