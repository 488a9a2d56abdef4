#pragma once

#include "pairs.hpp"

#include "dynamics/ode.hpp"
#include "model/friction/table.hpp"
#include "simd/tableau.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

namespace bristle::bench {

// Methods for the passage of one bristle, in scalar code. Each has a function attempt() for one step, the
// exponent -1/(order of the error) and gives_next, whether it evaluates the slopes at the end of the step.

constexpr int kComponents = COMPONENTS;

using Velocity = std::array<double, 2>;  // or another vector in the plane

// A symmetric 2 x 2 matrix.
struct Block {
  double xx = 0, xy = 0, yy = 0;
  Velocity operator*(const Velocity& v) const { return {xx * v[0] + xy * v[1], xy * v[0] + yy * v[1]}; }
  // Adds factor e e^T.
  void add(double factor, double e_x, double e_y) {
    xx += factor * e_x * e_x;
    xy += factor * e_x * e_y;
    yy += factor * e_y * e_y;
  }
  // The solution d of (1 - a M) d = v.
  Velocity solve(double a, const Velocity& v) const {
    const double m_xx = 1 - a * xx, m_xy = -a * xy, m_yy = 1 - a * yy;
    const double one_det = 1 / (m_xx * m_yy - m_xy * m_xy);
    return {(m_yy * v[0] - m_xy * v[1]) * one_det, (m_xx * v[1] - m_xy * v[0]) * one_det};
  }
  // Eigenvalues, and the unit vector of the first.
  void eigen(double (&value)[2], double& e_x, double& e_y) const {
    const double mean = (xx + yy) / 2, half = (xx - yy) / 2, radius = std::hypot(half, xy);
    value[0] = mean - radius;
    value[1] = mean + radius;
    e_x = half < 0 ? radius - half : -xy;
    e_y = half < 0 ? -xy : radius + half;
    const double length = std::hypot(e_x, e_y);
    e_x = length > 0 ? e_x / length : 1;
    e_y = length > 0 ? e_y / length : 0;
  }
};

// The modulation of friction and its slope, by the engine's table; secant is modulation/V_R, also at V_R = 0.
struct Modulation {
  double value, secant, slope;
};
inline Modulation look_up(const ModulationTable& table, double V_R) {
  const double inverse = 1 / (V_R + table.V_s()), t = V_R * inverse, scaled = t * table.intervals();
  const int interval = scaled <= table.intervals() ? int(scaled) : 0;  // 0 for a state that is not finite
  const double u = scaled - interval, *c = table.coefficients() + 4 * interval;
  const double q = c[0] + u * (c[1] + u * (c[2] + u * c[3]));
  const double dq = table.intervals() * (c[1] + u * (2 * c[2] + u * 3 * c[3]));
  return {t * q, q * inverse, (q + t * dq) * table.V_s() * inverse * inverse};
}

// One evaluation of the right-hand side.
struct Evaluation {
  Place<double> place;
  Sliding<double> sliding;
  Modulation modulation;
  OdeState slope;
};

struct Problem {
  const Bristle<double>& bristle;
  const ModulationTable& table;
  long evaluations = 0;

  void set_sliding(const State<double>& state, Evaluation& e) const {
    e.sliding = relative_motion(state.v[0], state.v[1]);
    e.modulation = look_up(table, e.sliding.V_R);
    e.sliding.modulation = e.modulation.value;
  }
  void evaluate(const OdeState& y, Evaluation& e) {
    ++evaluations;
    const auto state = unpack<double>(y);
    e.place = place_at(bristle, state.r);
    set_sliding(state, e);
    slopes_of(bristle, state, motion(bristle, state, e.place, e.sliding, friction_force(e.place, e.sliding)),
              e.slope);
  }
  // The derivatives by the in-plane velocity, at another place than that of the sliding, of the friction
  // force, with no steeper fall than `least`, and of the acceleration by the azimuth's damper.
  static Block friction_block(const Place<double>& place, const Evaluation& at, double least) {
    const double limit = place.friction_limit, secant = limit * at.modulation.secant;
    Block block{-secant, 0, -secant};
    block.add(std::min(secant - limit * at.modulation.slope, least), at.sliding.e_x, at.sliding.e_y);
    return block;
  }
  void add_damper(const Place<double>& place, Block& block) const {
    block.add(-azimuth_damping(bristle, place.frame), -place.frame.sin_theta, place.frame.cos_theta);
  }
  Block stiff_block(const Evaluation& at) const {
    Block block = friction_block(at.place, at, kNone);
    add_damper(at.place, block);
    return block;
  }
  static constexpr double kNone = std::numeric_limits<double>::infinity();
};

// A step that was attempted; next is the evaluation at its end if the method makes one.
struct Attempt {
  OdeState y, error;
  Evaluation next;
};

// out = y + h sum_j weight[j] slopes[j]
inline void combine(const OdeState& y, double h, const OdeState* slopes, const double* weight, int count,
                    OdeState& out) {
  OdeState sum{};
  for (int j = 0; j < count; ++j)
    if (weight[j] != 0)
      for (int c = 0; c < kComponents; ++c) sum[c] += weight[j] * slopes[j][c];
  for (int c = 0; c < kComponents; ++c) out[c] = y[c] + h * sum[c];
}

// How an additive pair solves its stages. As in simd/step.hpp, friction and the azimuth's damper are implicit
// in the velocity, by iterations of Newton's method, and friction is that linearised about the velocity
// before the last iteration. The error of the linear friction is quadratic in the change of the velocity. One
// iteration from the velocity of the stage before therefore leaves order 2, where friction is not linear. A
// start that is extrapolated from the two stages before, or a second iteration, restores the order. As the
// rest of a stage depends on the place only, neither costs an evaluation, but a look-up in friction's table.
// The engine extrapolates.
struct FromStageBefore {
  static constexpr const char* name = ", start at the stage before";
  static constexpr int iterations = 1;
  static constexpr bool extrapolated = false;
};
struct TwoIterations {
  static constexpr const char* name = ", two iterations";
  static constexpr int iterations = 2;
  static constexpr bool extrapolated = false;
};
struct Extrapolated {
  static constexpr const char* name = "";
  static constexpr int iterations = 1;
  static constexpr bool extrapolated = true;
};

template <class Stages, class Tableau = KennedyCarpenter4>
struct Additive {
  static inline const std::string name =
      std::string(Tableau::stages == 7 ? "ARK4(3)7L[2]SA" : "ARK4(3)6L[2]SA") + Stages::name;
  static constexpr double exponent = Tableau::exponent;
  static constexpr bool gives_next = false;

  static void attempt(Problem& p, const OdeState& y, const Evaluation& first, double h, Attempt& out) {
    constexpr int S = Tableau::stages;
    const double a = h * Tableau::gamma;
    std::array<OdeState, S> k;
    std::array<Velocity, S> implicit, velocity;
    std::array<double, S> c;  // times of the stages
    for (int i = 0; i < S; ++i) c[i] = std::accumulate(Tableau::a[i], Tableau::a[i] + i, 0.0);
    k[0] = first.slope;
    Evaluation at = first;
    velocity[0] = {y[VX], y[VY]};
    implicit[0] = stiff_force(p, at.place, at.sliding, velocity[0]);
    for (int i = 1; i < S; ++i) {
      OdeState stage;
      combine(y, h, k.data(), Tableau::a[i], i, stage);
      for (int j = 0; j < i; ++j)
        for (int d = 0; d < 2; ++d)
          stage[VX + d] += h * (Tableau::a_implicit[i][j] - Tableau::a[i][j]) * implicit[j][d];
      at.place = place_at(p.bristle, Vector3<double>{stage[X], stage[Y], stage[Z]});
      const Velocity from = {stage[VX], stage[VY]};
      Velocity& v = velocity[i];
      v = velocity[i - 1];
      if (Stages::extrapolated && i >= 2) {
        const double u = (c[i] - c[i - 1]) / (c[i - 1] - c[i - 2]);
        for (int d = 0; d < 2; ++d) v[d] += u * (velocity[i - 1][d] - velocity[i - 2][d]);
        set_velocity(p, v, stage, at);
      }
      InPlane<double> friction;  // linearised about the velocity before the last iteration
      for (int n = 0; n < Stages::iterations; ++n) {
        // The matrix stays regular where friction falls steeply with the speed: see AdditiveStep.
        const double least = at.place.friction_limit * at.modulation.secant + 0.9 / a;
        const Block of_friction = Problem::friction_block(at.place, at, least);
        Block block = of_friction;
        p.add_damper(at.place, block);
        const Velocity force = stiff_force(p, at.place, at.sliding, v);
        const Velocity change =
            block.solve(a, {from[0] - v[0] + a * force[0], from[1] - v[1] + a * force[1]});
        const Velocity steeper = of_friction * change;
        friction = friction_force(at.place, at.sliding);
        for (int d = 0; d < 2; ++d) {
          friction[d] += steeper[d];
          v[d] += change[d];
        }
        set_velocity(p, v, stage, at);
      }
      for (int d = 0; d < 2; ++d) implicit[i][d] = (v[d] - from[d]) / a;
      const auto state = unpack<double>(stage);
      slopes_of(p.bristle, state, motion(p.bristle, state, at.place, at.sliding, friction), k[i]);
      ++p.evaluations;
    }
    combine(y, h, k.data(), Tableau::b, S, out.y);
    combine({}, h, k.data(), Tableau::error, S, out.error);
  }
  static void set_velocity(const Problem& p, const Velocity& v, OdeState& stage, Evaluation& at) {
    stage[VX] = v[0];
    stage[VY] = v[1];
    p.set_sliding(unpack<double>(stage), at);
  }
  static Velocity stiff_force(const Problem& p, const Place<double>& place, const Sliding<double>& sliding,
                              const Velocity& v) {
    const auto friction = friction_force(place, sliding);
    Block damper;
    p.add_damper(place, damper);
    const Velocity damping = damper * v;
    return {friction[0] + damping[0], friction[1] + damping[1]};
  }
};

// J. R. Dormand, P. J. Prince, J. Comput. Appl. Math. 6 (1980) 19.
struct DormandPrince {
  static constexpr const char* name = "Dormand-Prince 5(4)";
  static constexpr double exponent = -1.0 / 5;
  static constexpr bool gives_next = true;
  static constexpr double a[7][6] = {
      {},
      {1.0 / 5},
      {3.0 / 40, 9.0 / 40},
      {44.0 / 45, -56.0 / 15, 32.0 / 9},
      {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
      {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656},
      {35.0 / 384, 0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84}};
  static constexpr double e[7] = {71.0 / 57600,      0,          -71.0 / 16695, 71.0 / 1920,
                                  -17253.0 / 339200, 22.0 / 525, -1.0 / 40};

  static void attempt(Problem& p, const OdeState& y, const Evaluation& first, double h, Attempt& out) {
    std::array<OdeState, 7> k;
    k[0] = first.slope;
    for (int i = 1; i < 7; ++i) {
      combine(y, h, k.data(), a[i], i, out.y);
      p.evaluate(out.y, out.next);
      k[i] = out.next.slope;
    }
    combine({}, h, k.data(), e, 7, out.error);
  }
};

// RKC, of order 2: B. P. Sommeijer, L. F. Shampine, J. G. Verwer, J. Comput. Appl. Math. 88 (1998) 315. A
// recurrence of shifted Chebyshev polynomials gives stability on the negative real axis up to 2/3 (s^2 - 1)
// for s stages, which is what the spectral radius requires. The radius is that of friction and damper at the
// start, and the frequencies of the radial spring and the wall.
struct Chebyshev {
  static constexpr const char* name = "RKC2";
  static constexpr double exponent = -1.0 / 3;
  static constexpr bool gives_next = true;
  static constexpr int kMostStages = 100;

  struct Coefficients {
    double mu_1;  // the article's tilde mu_1
    struct Stage {
      double mu, nu, mu_tilde, gamma_tilde;
    };
    std::vector<Stage> stage;

    explicit Coefficients(int s) : stage(std::size_t(s) + 1) {
      const double w_0 = 1 + 2.0 / 13 / (s * s);
      // T_j(w_0) and its derivatives
      std::vector<double> T = {1, w_0}, dT = {0, 1}, ddT = {0, 0};
      for (std::size_t j = 2; j < stage.size(); ++j) {
        T.push_back(2 * w_0 * T[j - 1] - T[j - 2]);
        dT.push_back(2 * T[j - 1] + 2 * w_0 * dT[j - 1] - dT[j - 2]);
        ddT.push_back(4 * dT[j - 1] + 2 * w_0 * ddT[j - 1] - ddT[j - 2]);
      }
      const double w_1 = dT.back() / ddT.back();
      const auto b = [&](std::size_t j) {
        j = std::max<std::size_t>(j, 2);
        return ddT[j] / (dT[j] * dT[j]);
      };
      mu_1 = b(1) * w_1;
      for (std::size_t j = 2; j < stage.size(); ++j) {
        const double mu_tilde = 2 * w_1 * b(j) / b(j - 1);
        stage[j] = {2 * w_0 * b(j) / b(j - 1), -b(j) / b(j - 2), mu_tilde,
                    -(1 - b(j - 1) * T[j - 1]) * mu_tilde};
      }
    }
  };
  static const Coefficients& coefficients(int s) {
    static const std::vector<Coefficients> all = [] {
      std::vector<Coefficients> list;
      for (int i = 0; i <= kMostStages; ++i) list.emplace_back(std::max(i, 2));
      return list;
    }();
    return all[std::size_t(s)];
  }

  static void attempt(Problem& p, const OdeState& y, const Evaluation& first, double h, Attempt& out) {
    double value[2], e_x, e_y;
    p.stiff_block(first).eigen(value, e_x, e_y);
    const Bristle<double>& b = p.bristle;
    const double radius = std::max(std::abs(value[0]), std::abs(value[1])) +
                          std::sqrt(b.k_r + b.wall_rate * first.place.wall.F_n);
    const int s = std::clamp(1 + int(std::sqrt(1 + 1.54 * h * radius)), 2, kMostStages);
    const Coefficients& c = coefficients(s);
    OdeState before = y, now;
    for (int i = 0; i < kComponents; ++i) now[i] = y[i] + c.mu_1 * h * first.slope[i];
    for (int j = 2; j <= s; ++j) {
      p.evaluate(now, out.next);
      const auto& w = c.stage[std::size_t(j)];
      for (int i = 0; i < kComponents; ++i) {
        const double next = (1 - w.mu - w.nu) * y[i] + w.mu * now[i] + w.nu * before[i] +
                            h * (w.mu_tilde * out.next.slope[i] + w.gamma_tilde * first.slope[i]);
        before[i] = now[i];
        now[i] = next;
      }
    }
    out.y = now;
    p.evaluate(now, out.next);
    for (int i = 0; i < kComponents; ++i)
      out.error[i] = 0.8 * (y[i] - now[i]) + 0.4 * h * (first.slope[i] + out.next.slope[i]);
  }
};

// ROS34PW2, of order 3(2) for any approximate Jacobian: J. Rang, L. Angermann, BIT 45 (2005) 761. Stage i
// solves k_i = f(y + h sum_j alpha_ij k_j) + h J sum_j<=i gamma_ij k_j.
struct Rosenbrock {
  static constexpr const char* name = "ROS34PW2";
  static constexpr double exponent = -1.0 / 3;
  static constexpr bool gives_next = false;
  static constexpr double gamma = 0.43586652150845900;
  static constexpr double alpha[4][3] = {
      {}, {0.87173304301691801}, {0.84457060015369423, -0.11299064236484185}, {0, 0, 1}};
  static constexpr double gammas[4][3] = {{},
                                          {-0.87173304301691801},
                                          {-0.90338057013044082, 0.054180672388095326},
                                          {0.24212380706095346, -1.2232505839045147, 0.54526025533510214}};
  static constexpr double b[4] = {0.24212380706095346, -1.2232505839045147, 1.5452602553351020, gamma};
  static constexpr double embedded[4] = {0.37810903145819369, -0.096042292212423178, 0.5,
                                         0.21793326075422950};

  static void attempt(Problem& p, const OdeState& y, const Evaluation& first, double h, Attempt& out) {
    const Block J = p.stiff_block(first);
    std::array<OdeState, 4> k;
    Evaluation at;
    for (int i = 0; i < 4; ++i) {
      if (i == 0) {
        k[i] = first.slope;
      } else {
        OdeState stage;
        combine(y, h, k.data(), alpha[i], i, stage);
        p.evaluate(stage, at);
        k[i] = at.slope;
      }
      Velocity sum{};  // of gamma_ij k_j
      for (int j = 0; j < i; ++j)
        for (int c = 0; c < 2; ++c) sum[c] += gammas[i][j] * k[j][VX + c];
      const Velocity J_sum = J * sum;
      const Velocity solution = J.solve(h * gamma, {k[i][VX] + h * J_sum[0], k[i][VY] + h * J_sum[1]});
      for (int c = 0; c < 2; ++c) k[i][VX + c] = solution[c];
    }
    combine(y, h, k.data(), b, 4, out.y);
    double difference[4];
    for (int i = 0; i < 4; ++i) difference[i] = b[i] - embedded[i];
    combine({}, h, k.data(), difference, 4, out.error);
  }
};

// phi_0 .. phi_3 of a number: phi_0 = exp, phi_(k+1)(z) = (phi_k(z) - 1/k!)/z.
struct Phi {
  static constexpr int count = 4;
  static constexpr double one_factorial[count] = {1, 1, 1.0 / 2, 1.0 / 6};
  double value[count];
  explicit Phi(double z) {
    if (std::abs(z) > 1) {
      value[0] = bristle::exp(z);
      for (int k = 1; k < count; ++k) value[k] = (value[k - 1] - one_factorial[k - 1]) / z;
      return;
    }
    double sum = 0, term = one_factorial[count - 1];
    for (int i = 1; i <= 16; ++i) {
      sum += term;
      term *= z / (count - 1 + i);
    }
    value[count - 1] = sum;
    for (int k = count - 1; k > 0; --k) value[k - 1] = z * value[k] + one_factorial[k - 1];
  }
};

// ETD4RK: S. M. Cox, P. C. Matthews, J. Comput. Phys. 176 (2002) 430, with the stages of S. Krogstad, J.
// Comput. Phys. 203 (2005) 72, for f = L y + N with the frozen linear part L. Written with D_i = N_i - N_1,
// which needs the increments of the state only. The error is the difference to weights that use N at the end
// of the step instead of that at stage 4: of order 3, without a further evaluation.
struct Exponential {
  static constexpr const char* name = "ETD4RK (Krogstad)";
  static constexpr double exponent = -1.0 / 4;
  static constexpr bool gives_next = true;

  // phi functions of h L, which is 0 for all components but the in-plane velocity
  struct Functions {
    double e_x, e_y;
    Phi phi[2];
    Functions(const double (&value)[2], double x, double y, double h)
        : e_x(x), e_y(y), phi{Phi(h * value[0]), Phi(h * value[1])} {}
    // out += factor sum_k weight[k] phi_k(h L) w, k = 1 .. 3
    void add(double factor, std::array<double, 4> weight, const OdeState& w, OdeState& out) const {
      double plain = 0, g[2] = {0, 0};
      for (int k = 1; k <= 3; ++k) {
        plain += factor * weight[k] * Phi::one_factorial[k];
        for (int i = 0; i < 2; ++i) g[i] += factor * weight[k] * phi[i].value[k];
      }
      const double along = g[0] * (e_x * w[VX] + e_y * w[VY]), across = g[1] * (e_x * w[VY] - e_y * w[VX]);
      for (int c = 0; c < kComponents; ++c)
        if (c != VX && c != VY) out[c] += plain * w[c];
      out[VX] += along * e_x - across * e_y;
      out[VY] += along * e_y + across * e_x;
    }
  };

  static void attempt(Problem& p, const OdeState& y, const Evaluation& first, double h, Attempt& out) {
    const Block L = p.stiff_block(first);
    double value[2], e_x, e_y;
    L.eigen(value, e_x, e_y);
    const Functions half(value, e_x, e_y, h / 2), full(value, e_x, e_y, h);
    // N at a state, less N at y
    const auto evaluate = [&](const OdeState& at) {
      p.evaluate(at, out.next);
      const Velocity linear = L * Velocity{at[VX] - y[VX], at[VY] - y[VY]};
      OdeState D;
      for (int c = 0; c < kComponents; ++c) D[c] = out.next.slope[c] - first.slope[c];
      for (int c = 0; c < 2; ++c) D[VX + c] -= linear[c];
      return D;
    };
    OdeState middle = y, end = y;
    half.add(h / 2, {0, 1, 0, 0}, first.slope, middle);
    full.add(h, {0, 1, 0, 0}, first.slope, end);
    const OdeState D_2 = evaluate(middle);
    half.add(h, {0, 0, 1, 0}, D_2, middle);
    const OdeState D_3 = evaluate(middle);
    OdeState last = end;
    full.add(h, {0, 0, 2, 0}, D_3, last);
    const OdeState D_4 = evaluate(last);
    OdeState both;
    for (int c = 0; c < kComponents; ++c) both[c] = D_2[c] + D_3[c];
    full.add(h, {0, 0, 2, -4}, both, end);
    full.add(h, {0, 0, -1, 4}, D_4, end);
    const OdeState D_5 = evaluate(end);
    for (int c = 0; c < kComponents; ++c) both[c] = D_4[c] - D_5[c];
    out.y = end;
    out.error = {};
    full.add(h, {0, 0, -1, 4}, both, out.error);
  }
};

}  // namespace bristle::bench
