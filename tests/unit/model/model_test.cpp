#include "generators.hpp"

#include "bristle/dynamics/jacobian.hpp"
#include "bristle/model/friction/table.hpp"
#include "bristle/model/equilibrium.hpp"

#include "catch.hpp"
#include <Eigen/Geometry>

namespace bristle::model_test {
using namespace testing;

namespace {

constexpr double kRounding = 1e-12;

Eigen::Vector3d vector(const Vector3<double>& v) { return {v[0], v[1], v[2]}; }
Vector3<double> array(const Eigen::Vector3d& v) { return {v[0], v[1], v[2]}; }

double nss_chi(double u) { return chi(u, 1.2, chi_B(1.2), chi_C_peak_at_V_s(1.2)); }

}  // namespace

TEST_CASE("friction law: chi vanishes at rest, peaks with A at V_s and tends to 1") {
  CHECK(nss_chi(0) == 0);
  CHECK(nss_chi(1) == Approx(1.2).epsilon(kRounding));
  CHECK(nss_chi(1 - 1e-3) < 1.2);
  CHECK(nss_chi(1 + 1e-3) < 1.2);
  CHECK(nss_chi(1e9) == Approx(1).epsilon(1e-8));
  CHECK(nss_chi(100) == Approx(1.001).margin(5e-4));  // V_0 when V_s = 0.01
  CHECK(chi_C_peak_at_V_s(1.2) == Approx(-5.592).margin(1e-3));
}

TEST_CASE("friction law: chi is odd and bounded by A") {
  rc::prop("for any speed", [] {
    const double u = log_uniform(1e-8, 1e8);
    RC_ASSERT(nss_chi(-u) == -nss_chi(u));
    RC_ASSERT(nss_chi(u) > 0);
    RC_ASSERT(nss_chi(u) <= 1.2 * (1 + kRounding));
  });
}

TEST_CASE("Hertz area: pi (3 R_c F_n / (4 E*))^(2/3)") {
  const double R_c = 1.0 / 17, E_star = 5.849e4, F_n = 3.7;
  const double radius = std::cbrt(3 * R_c * F_n / (4 * E_star));  // of the contact circle
  CHECK(hertz_area_factor(R_c, E_star) * std::pow(F_n, 2.0 / 3) == Approx(M_PI * radius * radius));
  const auto wall = wall_force(0.0123, std::cbrt(500.0), 1e3 / 3);
  CHECK(wall.F_n == Approx(short_range_force(0.0123, 500.0, 1e3)));
  CHECK(wall.F_n_23 == Approx(std::pow(wall.F_n, 2.0 / 3)));
}

TEST_CASE("the frame of Eq. (2) agrees with the position") {
  rc::prop("for any position off the pole", [] {
    const Vector3<double> r = random_state(0.6).r;
    const auto f = frame_at(r, true);
    RC_ASSERT(std::abs(f.s * f.one_s - 1) < kRounding);
    RC_ASSERT(std::abs(f.r * f.one_r - 1) < kRounding);
    RC_ASSERT(std::abs(std::hypot(f.cos_theta, f.sin_theta) - 1) < kRounding);
    const Eigen::Vector3d e_r(f.cos_phi * f.cos_theta, f.cos_phi * f.sin_theta, f.sin_phi);
    RC_ASSERT((f.r * e_r - vector(r)).norm() < kRounding);
  });
}

TEST_CASE("a short-range force is cut off where it is smaller than rounding errors") {
  CHECK(short_range_force(0.0399, 500.0, 1e3) > 0);
  CHECK(short_range_force(0.0401, 500.0, 1e3) == 0);
  CHECK(short_range_force(0.0399, 500.0, 1e3) < 1e-14);
}

TEST_CASE("without friction and damping the force is minus the gradient of the potential") {
  rc::prop("for any position", [] {
    Parameters p = random_parameters();
    p.friction = FrictionLaw::coulomb;
    p.mu_c = p.zeta_theta = p.zeta_phi = 0;
    const auto b = make_bristle(p, 0.6, 0.5);
    State<double> state = random_state(0.6);
    state.theta = std::atan2(state.r[1], state.r[0]);  // angles that agree with the position
    state.phi = std::atan2(state.r[2], std::hypot(state.r[0], state.r[1]));
    const auto potential = [&](const Vector3<double>& at) {
      return potential_energy(b, at, std::atan2(at[1], at[0]), std::atan2(at[2], std::hypot(at[0], at[1])));
    };
    const Eigen::Vector3d force = vector(motion(b, state).acceleration);
    const double scale = 1 + force.norm();
    for (int i = 0; i < 3; ++i) {
      // The error of central differences is h^2/6 times the third derivative, which is force/lambda^2.
      const double h = 1e-6;
      Vector3<double> above = state.r, below = state.r;
      above[i] += h;
      below[i] -= h;
      const double slope = (potential(above) - potential(below)) / (2 * h);
      RC_ASSERT(std::abs(force[i] + slope) < 1e-5 * scale);
    }
  });
}

TEST_CASE("closing equations: theta' kinematically exact or as printed, phi' exact") {
  rc::prop("against differences along the motion", [] {
    const State<double> s = random_state(0.6);
    const auto f = frame_at(s.r, true);
    const auto exact = angular_rates(Bending::polar, f, s.v);
    const auto printed = angular_rates(Bending::polar_as_printed, f, s.v);
    const double cross = s.r[0] * s.v[1] - s.r[1] * s.v[0];
    RC_ASSERT(std::abs(exact.theta - cross / (f.s * f.s)) < 1e-10 * (1 + std::abs(exact.theta)));
    RC_ASSERT(std::abs(printed.theta - cross / (f.r * f.r)) < 1e-10 * (1 + std::abs(printed.theta)));
    const double Eq18 = (s.v[2] - s.r[2] * vector(s.r).dot(vector(s.v)) / (f.r * f.r)) / f.s;
    RC_ASSERT(std::abs(exact.phi - Eq18) < 1e-10 * (1 + std::abs(Eq18)));
    const double h = 1e-7;
    const auto polar_angle = [&](double t) {
      const Eigen::Vector3d at = vector(s.r) + t * vector(s.v);
      return std::asin(at[2] / at.norm());
    };
    const double slope = (polar_angle(h) - polar_angle(-h)) / (2 * h);
    RC_ASSERT(std::abs(exact.phi - slope) < 1e-5 * (1 + std::abs(slope)));
  });
}

TEST_CASE("the friction force is smooth at V_R = 0") {
  const auto b = make_bristle(Parameters{}, 0.6, 0);
  State<double> s{{0.5, 0.1, 0.6}, {1, 0, 0}, 0.2, 0.9};
  CHECK(motion(b, s).friction[0] == 0);
  s.v[0] = 1 - 1e-9;
  const auto slow = motion(b, s);
  const double slope = 1.2 * chi_B(1.2) / 0.01 * b.friction_factor * slow.contact.F_n_23;
  CHECK(slow.friction[0] == Approx(slope * 1e-9).epsilon(1e-6));
  CHECK(slow.sliding.e_x == Approx(-1));
}

TEST_CASE("the power of the forces equals the rate of the energy, except with Eq. (17) as printed") {
  rc::prop("by differences along the flow", [] {
    Parameters p = random_parameters();
    const double z_0 = 0.6;
    State<double> s = random_state(z_0);
    const double h = 1e-7;
    for (const auto bending : {Bending::polar, Bending::polar_as_printed, Bending::rod}) {
      p.bending = bending;
      const auto b = make_bristle(p, z_0, 0.3);
      const auto m = motion(b, s);
      const auto at = [&](double t) {
        return State<double>{array(vector(s.r) + t * vector(s.v)),
                             array(vector(s.v) + t * vector(m.acceleration)), s.theta + t * m.rates.theta,
                             s.phi + t * m.rates.phi};
      };
      const double rate = (energy(b, at(h)) - energy(b, at(-h))) / (2 * h);
      const double defect = std::abs(rate - power(b, m));
      const auto exact = angular_rates(Bending::polar, frame_at(s.r, true), s.v);
      const double of_twist = std::abs((b.k_theta * (s.theta - b.theta_0) + b.c_theta * m.rates.theta) *
                                       (m.rates.theta - exact.theta));
      const double printed_defect = bending == Bending::polar_as_printed ? of_twist : 0;
      const double scale = 1 + std::abs(rate) + vector(m.acceleration).norm() * vector(s.v).norm();
      RC_ASSERT(std::abs(defect - printed_defect) < 1e-4 * scale);
    }
  });
}

TEST_CASE("Eqs. (11, 12): damping coefficients") {
  Parameters p;
  p.k_theta = 4;
  p.k_phi = 2.25;
  const auto b = make_bristle(p, 0.5, 0);
  CHECK(b.c_theta == Approx(2 * 0.1 * 2 * std::cos(p.phi_0)));
  CHECK(b.c_phi == Approx(2 * 0.1 * 1.5));
}

TEST_CASE("static equilibrium: no force, and no lower energy nearby") {
  rc::prop("for any parameters and gap", [] {
    Parameters p = random_parameters();
    p.friction = FrictionLaw::coulomb;
    p.mu_c = 0;
    const auto b = make_bristle(p, uniform(0.05, 0.98), uniform(-3, 3));
    const Equilibrium e = static_equilibrium(b);
    const State<double> s = state_at_rest(b, e);
    const Eigen::Vector3d force = vector(motion(b, s).acceleration);
    // Rounding of z times the stiffness F_n/lambda_z of the wall gives a force of this size.
    RC_ASSERT(force.norm() < 1e-8 * (1 + p.k_r));
    const auto U = [&](double r, double phi) {
      return potential_energy(b, state_at_rest(b, {r, phi}).r, b.theta_0, phi);
    };
    for (const double d : {-1e-4, 1e-4}) {
      RC_ASSERT(U(e.r + d, e.phi) > U(e.r, e.phi));
      RC_ASSERT(U(e.r, e.phi + d) > U(e.r, e.phi));
    }
  });
}

TEST_CASE("automatic differentiation gives the derivatives of the equations") {
  rc::prop("against differences", [] {
    const auto b = make_bristle(random_parameters(), 0.6, 0.4);
    const OdeState y = pack(random_state(0.6));
    Jacobian J;
    jacobian(b, y, J);
    double scale = 1;
    for (const auto& row : J)
      for (const double slope : row) scale = std::max(scale, 1 + std::abs(slope));
    for (int j = 0; j < kState; ++j) {
      const double h = 1e-7;
      OdeState up = y, down = y, f_up, f_down;
      up[j] += h;
      down[j] -= h;
      derivative<double>(b, up, f_up);
      derivative<double>(b, down, f_down);
      for (int i = 0; i < COMPONENTS; ++i)
        RC_ASSERT(std::abs((f_up[i] - f_down[i]) / (2 * h) - J[i][j]) < 1e-3 * scale);
    }
  });
}

TEST_CASE("the tabulated modulation has an error below its bound, for every law") {
  rc::prop("at random speeds and parameters", [] {
    Parameters p = random_parameters();
    p.friction = FrictionLaw(*rc::gen::inRange(0, int(FrictionLaw::count)));
    RC_PRE(p.friction != FrictionLaw::custom);  // its table is the law
    p.A = log_uniform(1.001, 1e6);
    p.C = *rc::gen::arbitrary<bool>() ? chi_C_peak_at_V_s(p.A) : uniform(-1000, 0.9);
    p.V_s = log_uniform(1e-4, 1);
    const auto b = make_bristle(p, 0.6, 0);
    const ModulationTable table(p.friction, b.friction_constants);
    for (int i = 0; i < 100; ++i) {
      const double V_R = log_uniform(1e-12, 1e3), t = V_R / (V_R + p.V_s), scaled = t * table.intervals();
      const int interval = int(scaled);
      const double* c = table.coefficients() + std::ptrdiff_t(4) * interval;
      const double u = scaled - interval, q = c[0] + u * (c[1] + u * (c[2] + u * c[3]));
      RC_ASSERT(std::abs(t * q - sliding_at(b, 1 - V_R, 0.0).modulation) <
                kModulationError * std::max(1.0, p.A / 10));
    }
  });
}

}  // namespace bristle::model_test
