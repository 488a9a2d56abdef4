#include "bristle/ensemble/load.hpp"

#include "catch.hpp"
#include <cmath>

namespace bristle::load_test {

namespace {

constexpr double kContact = 0.98;

LoadPoint search(const std::function<double(double)>& R_n, double target, LoadPath path = LoadPath::loading) {
  LoadSearch s;
  s.target = target;
  s.path = path;
  s.first_contact = kContact;
  return first_crossing([&](double z_0, Accuracy) { return Load{R_n(z_0), 1e-6}; }, s);
}

double rising(double z_0) { return 4 * (kContact - z_0); }
// Rises to 1.5 at z_0 = 0.7, falls to 0.5 at 0.4, rises again: a fold.
double folded(double z_0) {
  const double x = kContact - z_0;
  return 1.5 * std::exp(-std::pow((x - 0.28) / 0.12, 2)) + 5 * x * x * x;
}
double jumping(double z_0) { return rising(z_0) + (z_0 < 0.6 ? 1.0 : 0.0); }

}  // namespace

TEST_CASE("load control: a monotonic curve on both paths") {
  for (const auto path : {LoadPath::loading, LoadPath::unloading}) {
    const LoadPoint p = search(rising, 2, path);
    CHECK(p.status == LoadStatus::reached);
    CHECK(p.z_0 == Approx(kContact - 0.5).margin(5e-4));
    CHECK(p.load.R_n == Approx(2).epsilon(1e-3));
  }
}

TEST_CASE("load control: both paths find a small load above first contact") {
  const auto soft = [](double z_0) {
    return std::max(0.0, rising(z_0)) + 0.2 * std::min(1.0, std::exp((kContact - z_0) / 1e-3));
  };
  for (const auto path : {LoadPath::loading, LoadPath::unloading}) {
    const LoadPoint p = search(soft, 0.1, path);
    CHECK(p.status == LoadStatus::reached);
    CHECK(p.z_0 > kContact);
    CHECK(p.load.R_n == Approx(0.1).epsilon(1e-3));
    CHECK_FALSE(p.ambiguous);
  }
  CHECK(search(rising, 100, LoadPath::unloading).status == LoadStatus::unreachable);
}

TEST_CASE(
    "load control: at a fold the loading path finds the first crossing and the unloading path the last") {
  const LoadPoint loading = search(folded, 1.2), unloading = search(folded, 1.2, LoadPath::unloading);
  REQUIRE(loading.status == LoadStatus::reached);
  REQUIRE(unloading.status == LoadStatus::reached);
  CHECK(loading.z_0 > 0.7);
  CHECK(unloading.z_0 < 0.5);
  // Three times the tolerance suffices where values at the target follow from both sides.
  for (const LoadPoint& p : {loading, unloading})
    CHECK(folded(p.z_0) == Approx(1.2).epsilon(p.even_between ? 3e-3 : 1e-3));
}

TEST_CASE(
    "load control: a target just below the top of the fold is reached at the fold, one just above beyond "
    "it") {
  double top = 0;
  for (double z_0 = 0.8; z_0 > 0.5; z_0 -= 1e-5) top = std::max(top, folded(z_0));
  CHECK(search(folded, top * 0.998).z_0 > 0.65);
  CHECK(search(folded, top * 1.002).z_0 < 0.4);
}

TEST_CASE("load control: a jump across the target is reported with both sides") {
  const LoadPoint p = search(jumping, 2);
  CHECK(p.status == LoadStatus::load_jump);
  CHECK(p.z_0 == Approx(0.6).margin(1e-5));
  CHECK(p.load.R_n == Approx(rising(0.6) + 1).epsilon(1e-4));
  CHECK(p.jump_z_0 == Approx(0.6).margin(1e-5));
  CHECK(p.jump_R_n == Approx(rising(0.6)).epsilon(1e-4));
  CHECK(p.jump_z_0 > p.z_0);
}

TEST_CASE("load control: a jump that does not cross the target has no effect") {
  const LoadPoint p = search(jumping, 1);
  CHECK(p.status == LoadStatus::reached);
  CHECK(p.z_0 == Approx(kContact - 0.25).margin(5e-4));
}

TEST_CASE("load control: a load that no gap carries is unreachable and not an error") {
  CHECK(search(rising, 100).status == LoadStatus::unreachable);
  CHECK(search(rising, 100, LoadPath::unloading).status == LoadStatus::unreachable);
}

TEST_CASE("load control: a load below that at first contact is reached at a larger gap") {
  const auto soft = [](double z_0) { return std::exp((kContact - z_0) / 0.005); };
  const LoadPoint p = search(soft, 0.5);
  CHECK(p.status == LoadStatus::reached);
  CHECK(p.z_0 > kContact);
}

TEST_CASE("load control: wrong rough means during the scan do not change the precise result") {
  for (const double bias : {-0.3, 0.3}) {
    CAPTURE(bias);
    LoadSearch s;
    s.first_contact = kContact;
    const LoadPoint p = first_crossing(
        [&](double z_0, Accuracy a) {
          return Load{rising(z_0) + (a == Accuracy::rough ? bias : 0.0), 1e-6};
        },
        s);
    CHECK(p.status == LoadStatus::reached);
    CHECK(p.z_0 == Approx(kContact - 0.5).margin(5e-4));
  }
}

TEST_CASE("load control: a load beside the target is accepted only where the curve is even") {
  LoadSearch s;
  s.first_contact = kContact;
  s.target = 2;
  for (const double steeper : {1.5, 5.0}) {  // slope beyond the target over that before it
    CAPTURE(steeper);
    const auto kinked = [&](double z_0) {
      const double beyond = kContact - 0.5 - z_0;
      return s.target + beyond * (beyond > 0 ? steeper : 1) + 0.3 * beyond * beyond * beyond;
    };
    const LoadPoint p = first_crossing([&](double z_0, Accuracy) { return Load{kinked(z_0), 1e-6}; }, s);
    CHECK(p.status == LoadStatus::reached);
    CHECK(p.even_between.has_value() == (steeper < 2));
    CHECK(kinked(p.z_0) == Approx(s.target).epsilon(p.even_between ? 3e-3 : 1e-3));
  }
}

TEST_CASE("load control: without secants the load is within rtol") {
  LoadSearch s;
  s.target = 2;
  s.first_contact = kContact;
  s.by_secants = false;
  const LoadPoint p = first_crossing([](double z_0, Accuracy) { return Load{rising(z_0), 1e-6}; }, s);
  CHECK(!p.even_between);
  CHECK(rising(p.z_0) == Approx(s.target).epsilon(1e-3));
}

TEST_CASE("load control: a hump next to a gap of the scan with a wrong rough mean is found") {
  // All rough means of the scan are too low, so the hump between the gaps of the scan is searched. The
  // precise mean at the gap before the hump then already reaches the target.
  LoadSearch s;
  s.first_contact = kContact;
  const int count = int(std::ceil((kContact - s.ground) / s.step));
  const double step = (kContact - s.ground) / count, bias = 0.4;
  double highest = 0;
  for (int i = 0; i < count / 2; ++i) highest = std::max(highest, folded(kContact - i * step));
  s.target = highest - bias + 0.02;
  const LoadPoint p = first_crossing(
      [&](double z_0, Accuracy a) {
        const double steps = (kContact - z_0) / step;
        const bool low = a == Accuracy::rough && std::abs(steps - std::round(steps)) < 1e-9;
        return Load{folded(z_0) - (low ? bias : 0.0), 1e-6};
      },
      s);
  CHECK(p.status == LoadStatus::reached);
  CHECK(p.z_0 > 0.7);
  CHECK(folded(p.z_0) == Approx(s.target).epsilon(p.even_between ? 3e-3 : 1e-3));
}

TEST_CASE("load control: a soft wall is followed far above first contact") {
  LoadSearch s;
  s.target = 0.5;
  s.first_contact = kContact;
  s.contact_range = 0.05;
  const LoadPoint p = first_crossing(
      [](double z_0, Accuracy) {
        return Load{1.3 * std::exp((kContact - z_0) / 0.2), 1e-6};
      },
      s);
  CHECK(p.status == LoadStatus::reached);
  CHECK(p.z_0 == Approx(kContact + 0.2 * std::log(2.6)).margin(1e-3));
}

TEST_CASE("load control: a maximum that is within the errors or 0.5 % of the target is ambiguous") {
  double top = 0;
  for (double z_0 = 0.8; z_0 > 0.5; z_0 -= 1e-5) top = std::max(top, folded(z_0));
  const auto search_with_error = [&](double target, double error) {
    LoadSearch s;
    s.target = target;
    s.first_contact = kContact;
    return first_crossing([&](double z_0, Accuracy) { return Load{folded(z_0), error}; }, s);
  };
  for (const double share : {-0.004, 0.004, -0.008, 0.008}) {
    CAPTURE(share);
    const double target = top * (1 + share);
    const bool close = std::abs(share) < 0.005;
    const LoadPoint inaccurate = search_with_error(target, 0.01), accurate = search_with_error(target, 1e-6);
    CHECK(inaccurate.ambiguous);
    CHECK(accurate.ambiguous == close);
    CHECK(accurate.z_0_other.has_value() == close);
    // The gap and the other one are on both sides of the range in which the load falls.
    CHECK((share < 0 ? accurate.z_0 > 0.6 : accurate.z_0 < 0.4));
    if (close) CHECK((share > 0 ? *accurate.z_0_other > 0.6 : *accurate.z_0_other < 0.4));
  }
  CHECK(!search_with_error(1.2, 0.01).ambiguous);
}

TEST_CASE("load control: a fall beyond the crossing by more than the precise errors makes it ambiguous") {
  const auto dipping = [](double z_0) {
    const double x = kContact - z_0;
    if (x < 0.25) return 4 * x;
    return x < 0.45 ? 1 - 0.04 * std::pow(std::sin((x - 0.25) / 0.2 * M_PI), 2) : 1 + 4 * (x - 0.45);
  };
  LoadSearch s;
  s.target = 0.998;
  s.rtol = 0.02;
  s.first_contact = kContact;
  const LoadPoint p = first_crossing(
      [&](double z_0, Accuracy accuracy) {
        return Load{dipping(z_0), accuracy == Accuracy::rough ? 0.08 : 0.01};
      },
      s);
  CHECK(p.ambiguous);
  REQUIRE(p.z_0_other);
  CHECK(*p.z_0_other < kContact - 0.4);
}

TEST_CASE("load control: noise of the precise means is not taken for a jump") {
  // The precise means are too high beyond a gap where the reported ones have no jump.
  LoadSearch s;
  s.first_contact = kContact;
  const LoadPoint p = first_crossing(
      [](double z_0, Accuracy a) {
        return Load{rising(z_0) + (a != Accuracy::reported && z_0 < 0.5 ? 0.2 : 0.0), 1e-6};
      },
      s);
  CHECK(p.status == LoadStatus::reached);
  CHECK(p.load.R_n == Approx(2).epsilon(1e-3));
  CHECK(p.z_0 == Approx(kContact - 0.5).margin(5e-4));
}

TEST_CASE(
    "load control: humps of a hundredth near the target are found, and an earlier one is not passed over") {
  for (double at = 0.5; at < 0.56; at += 0.0037) {
    CAPTURE(at);
    // A plateau 2 % below the target with one hump.
    const auto curve = [at](double z_0) {
      const double plateau = z_0 > 0.4 ? std::min(1.96, rising(z_0) * 1.2) : 1.96 + 10 * (0.4 - z_0);
      return plateau + 0.075 * std::exp(-std::pow((z_0 - at) / 0.006, 2));
    };
    const LoadPoint p = search(curve, 2);
    CHECK(p.status == LoadStatus::reached);
    CHECK(p.z_0 == Approx(at).margin(0.006));
    CHECK(!p.ambiguous);
  }
}

TEST_CASE("load control: an earlier crossing within the same step of the scan is found") {
  // A hump of half a hundredth just before the crossing.
  const auto curve = [](double z_0) {
    return rising(z_0) + 0.1 * std::exp(-std::pow((z_0 - 0.487) / 0.002, 2));
  };
  const LoadPoint p = search(curve, 2);
  CHECK(p.status == LoadStatus::reached);
  CHECK(p.z_0 > 0.487);
  CHECK(curve(p.z_0) == Approx(2).epsilon(1e-3));
}

TEST_CASE("load control: a hump between an even slope and the gap of the scan before it is found") {
  const auto curve = [](double z_0) {
    return rising(z_0) + 0.2 * std::exp(-std::pow((z_0 - 0.461) / 0.003, 2));
  };
  CHECK(search(curve, 2.13).z_0 > 0.46);
}

TEST_CASE("load control: a curve that cannot be computed has status failed") {
  CHECK(search([](double z_0) { return z_0 < 0.7 ? NAN : 0.1; }, 2).status == LoadStatus::failed);
}

}  // namespace bristle::load_test
