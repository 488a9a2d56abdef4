// Compares classes of methods for the passage of one bristle, in scalar code: the engine's additive
// Runge-Kutta pair, an explicit pair, a stabilised explicit method, a linearly implicit method and
// exponential integrators. All of them have the equations, the step size control, the norm of the error and
// the rule for the exit in common. Writes JSON to standard output, from which scripts/performance.py makes a
// table.
// --orders instead prints the order of convergence of each method, which tests its coefficients.
#include "sample.hpp"

#include "dynamics/jacobian.hpp"
#include "dynamics/rules.hpp"
#include "simd/hermite.hpp"
#include "simd/tableau.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <numeric>

using namespace bristle;
using namespace bristle::bench;
using Json = nlohmann::ordered_json;

namespace {

constexpr long kMaxAttempts = 200'000;  // of steps of one passage
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
Modulation look_up(const ModulationTable& table, double V_R) {
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

// What the velocity does linearly, frozen over a step: the derivatives of the slopes by v_x and v_y.
// BlockOnly: those of the accelerations in the plane by friction and the azimuth's damper. Columns: those of
// all components, by automatic differentiation; in the plane the matrix is symmetric, as all dampers are.
struct BlockOnly {
  static constexpr const char* suffix = "";
  Block block;
  BlockOnly(const Problem& problem, const OdeState&, const Evaluation& at) : block(problem.stiff_block(at)) {}
  void add_rows(double, const Velocity&, OdeState&) const {}
};
struct Columns {
  static constexpr const char* suffix = ", all rows";
  std::array<Velocity, COMPONENTS> rows;
  Block block;
  Columns(const Problem& problem, const OdeState& y, const Evaluation&) {
    using Dual = Eigen::AutoDiffScalar<Eigen::Vector2d>;
    std::array<Dual, kState> in;
    std::array<Dual, COMPONENTS> out;
    for (int c = 0; c < kState; ++c) in[c] = Dual(y[c], Eigen::Vector2d(c == VX, c == VY));
    derivative<Dual>(problem.bristle, in, out);
    for (int c = 0; c < kComponents; ++c) rows[c] = {out[c].derivatives()[0], out[c].derivatives()[1]};
    block = {rows[VX][0], (rows[VX][1] + rows[VY][0]) / 2, rows[VY][1]};
  }
  // Adds factor * (row . v) to all components but v_x and v_y.
  void add_rows(double factor, const Velocity& v, OdeState& out) const {
    for (int c = 0; c < kComponents; ++c)
      if (c != VX && c != VY) out[c] += factor * (rows[c][0] * v[0] + rows[c][1] * v[1]);
  }
};

// A step that was attempted; next is the evaluation at its end if the method makes one.
struct Attempt {
  OdeState y, error;
  Evaluation next;
};

// out = y + h sum_j weight[j] slopes[j]
void combine(const OdeState& y, double h, const OdeState* slopes, const double* weight, int count,
             OdeState& out) {
  OdeState sum{};
  for (int j = 0; j < count; ++j)
    if (weight[j] != 0)
      for (int c = 0; c < kComponents; ++c) sum[c] += weight[j] * slopes[j][c];
  for (int c = 0; c < kComponents; ++c) out[c] = y[c] + h * sum[c];
}

// How the engine's method, of simd/step.hpp, solves its stages: friction and the azimuth's damper are
// implicit in the velocity, by a number of iterations of Newton's method. They start from the velocity of the
// stage before or from one extrapolated from the two stages before. The rest of a stage depends on the place
// only, so that a further iteration costs a look-up in the table of friction, but no evaluation.
struct Shipped {
  static constexpr const char* name = "ARK4(3)6L[2]SA";
  static constexpr int iterations = 1;
  static constexpr bool extrapolated = false;
};
struct TwoIterations {
  static constexpr const char* name = "ARK4(3)6L[2]SA, two iterations";
  static constexpr int iterations = 2;
  static constexpr bool extrapolated = false;
};
struct Extrapolated {
  static constexpr const char* name = "ARK4(3)6L[2]SA, extrapolated start";
  static constexpr int iterations = 1;
  static constexpr bool extrapolated = true;
};

template <class Stages>
struct Additive {
  using Tableau = KennedyCarpenter4;
  static constexpr const char* name = Stages::name;
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
template <class Linear>
struct Rosenbrock {
  static inline const std::string name = std::string("ROS34PW2") + Linear::suffix;
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
    const Linear J(p, y, first);
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
      const Velocity J_sum = J.block * sum;
      const Velocity solution = J.block.solve(h * gamma, {k[i][VX] + h * J_sum[0], k[i][VY] + h * J_sum[1]});
      for (int c = 0; c < 2; ++c) {
        k[i][VX + c] = solution[c];
        sum[c] += gamma * solution[c];
      }
      J.add_rows(h, sum, k[i]);
    }
    combine(y, h, k.data(), b, 4, out.y);
    double difference[4];
    for (int i = 0; i < 4; ++i) difference[i] = b[i] - embedded[i];
    combine({}, h, k.data(), difference, 4, out.error);
  }
};

// phi_0 .. phi_5 of a number: phi_0 = exp, phi_(k+1)(z) = (phi_k(z) - 1/k!)/z.
struct Phi {
  static constexpr int count = 6;
  static constexpr double one_factorial[count] = {1, 1, 1.0 / 2, 1.0 / 6, 1.0 / 24, 1.0 / 120};
  double value[count];
  explicit Phi(double z) {
    if (std::abs(z) > 1) {
      value[0] = bristle::exp(z);
      for (int k = 1; k < count; ++k) value[k] = (value[k - 1] - one_factorial[k - 1]) / z;
      return;
    }
    double sum = 0, term = one_factorial[count - 1];
    for (int i = 1; i <= 14; ++i) {
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
template <class Linear>
struct Exponential {
  static inline const std::string name = std::string("ETD4RK (Krogstad)") + Linear::suffix;
  static constexpr double exponent = -1.0 / 4;
  static constexpr bool gives_next = true;

  // sum_k weight[k] phi_k(h L), for k = 1 .. 3, applied to vectors
  struct Functions {
    const Linear& L;
    double h, e_x, e_y;
    Phi phi[2];
    Functions(const Linear& linear, double step, const double (&value)[2], double x, double y)
        : L(linear), h(step), e_x(x), e_y(y), phi{Phi(step * value[0]), Phi(step * value[1])} {}
    void add(double factor, std::array<double, 4> weight, const OdeState& w, OdeState& out) const {
      double plain = 0, own[2] = {0, 0}, row[2] = {0, 0};
      for (int k = 1; k <= 3; ++k) {
        plain += weight[k] * Phi::one_factorial[k];
        for (int i = 0; i < 2; ++i) {
          own[i] += weight[k] * phi[i].value[k];
          row[i] += weight[k] * phi[i].value[k + 1];
        }
      }
      const double along = e_x * w[VX] + e_y * w[VY], across = e_x * w[VY] - e_y * w[VX];
      const auto in_plane = [&](const double(&g)[2]) -> Velocity {
        return {g[0] * along * e_x - g[1] * across * e_y, g[0] * along * e_y + g[1] * across * e_x};
      };
      const Velocity v = in_plane(own), x = in_plane(row);
      for (int c = 0; c < kComponents; ++c)
        out[c] += factor * (c == VX || c == VY ? v[c - VX] : plain * w[c]);
      L.add_rows(factor * h, x, out);
    }
  };

  static void attempt(Problem& p, const OdeState& y, const Evaluation& first, double h, Attempt& out) {
    const Linear L(p, y, first);
    double value[2], e_x, e_y;
    L.block.eigen(value, e_x, e_y);
    const Functions half(L, h / 2, value, e_x, e_y), full(L, h, value, e_x, e_y);
    // N at a state, less N at y
    const auto nonlinear = [&](const OdeState& at, const OdeState& slope) {
      const Velocity dv = {at[VX] - y[VX], at[VY] - y[VY]}, linear = L.block * dv;
      OdeState D;
      for (int c = 0; c < kComponents; ++c) D[c] = slope[c] - first.slope[c];
      for (int c = 0; c < 2; ++c) D[VX + c] -= linear[c];
      L.add_rows(-1, dv, D);
      return D;
    };
    const auto evaluate = [&](const OdeState& at) {
      p.evaluate(at, out.next);
      return nonlinear(at, out.next.slope);
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

// The largest ratio of error to tolerance; NaN if any error is NaN.
double error_norm(const OdeState& y, const OdeState& error, double rtol, double atol) {
  double largest = 0, sum = 0;
  for (int c = 0; c < kComponents; ++c) {
    const double size = std::abs(error[c]);
    largest = std::max(largest, size / (atol * tolerance_scale(c) + rtol * std::abs(y[c])));
    sum += size;
  }
  return largest + (sum - sum);
}

// The engine's next_size(), of simd/group.hpp.
double next_size(double h, double error, double last_error, double exponent) {
  if (!(error < 1e6)) return 0.2 * h;
  const auto power = [](double x, double e) { return std::pow(std::max(x, 1e-4), e); };
  const double factor =
      error < 1 ? power(error, 0.7 * exponent) * power(last_error, -0.4 * exponent) : power(error, exponent);
  return h * std::clamp(0.9 * factor, 0.2, 5.0);
}

struct Result {
  OdeState end;
  long steps = 0, evaluations = 0;
  bool complete = false;
};

template <class M>
Result integrate(const PassageTask& task, const ModulationTable& table) {
  Problem p{task.bristle, table};
  const double rtol = task.integrator.rtol, atol = task.integrator.atol, L_x = task.parameters->L_x;
  OdeState y = pack(state_at_rest(task.bristle, task.start));
  const double x_0 = y[X];
  double t = 0, h = kFirstStep, last_error = 1;
  Evaluation at;
  p.evaluate(y, at);
  Result out;
  Attempt attempt;
  while (++out.steps < kMaxAttempts && h > kSmallestStep) {
    M::attempt(p, y, at, h, attempt);
    const double error = error_norm(y, attempt.error, rtol, atol);
    const double h_next = next_size(h, error, last_error, M::exponent);
    if (!(error < 1)) {
      h = h_next;
      continue;
    }
    const double slip = t + h - (attempt.y[X] - x_0) - L_x;
    if (slip > kSlipTolerance) {  // the next attempt ends at the exit
      const InPlanePath path(y, attempt.y, h);
      h *= first_root([&](double u) { return t + u * h - (path(u)[X] - x_0) - L_x; }, 0, 1, 1e-14);
      continue;
    }
    t += h;
    y = attempt.y;
    if (slip >= -kSlipTolerance) {
      out.complete = true;
      break;
    }
    if (M::gives_next) at = attempt.next;
    else p.evaluate(y, at);
    h = h_next;
    last_error = error;
  }
  out.end = y;
  out.evaluations = p.evaluations;
  return out;
}

// The tables of the friction laws' modulations.
class Tables {
 public:
  const ModulationTable& of(const PassageTask& task) {
    for (const ModulationTable& table : tables_)
      if (table.serves(task.bristle.friction, task.bristle.friction_constants, task.parameters->V_s))
        return table;
    return tables_.emplace_back(task.bristle.friction, task.bristle.friction_constants, task.parameters->V_s);
  }

 private:
  std::deque<ModulationTable> tables_;
};

// The relative error of each bristle's impulses of normal force and friction, in ascending order.
std::vector<double> impulse_errors(const std::vector<Result>& results, const std::vector<Passage>& exact) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < results.size(); ++i) {
    double worst = results[i].complete ? 0 : 1;
    for (const int c : {NORMAL, FRICTION_X})
      worst = std::max(worst, std::abs(results[i].end[c] / exact[i].end[c] - 1));
    errors.push_back(worst);
  }
  std::sort(errors.begin(), errors.end());
  return errors;
}

constexpr double kSmallestError = 1e-5;  // where a curve ends

// solve(tasks) returns the results.
template <class Solve>
Json curve(const std::string& name, const Bristles& bristles, const std::vector<Passage>& exact, int repeats,
           Solve solve) {
  fmt::print(stderr, "{} ...\n", name);
  Json points = Json::array();
  for (int half_decade = 2; half_decade <= 16; ++half_decade) {
    const double rtol = std::pow(10, -half_decade / 2.0), n = double(exact.size());
    const auto tasks = bristles.at(rtol);
    std::vector<Result> results;
    std::vector<double> times;
    for (int i = 0; i < repeats; ++i) times.push_back(seconds([&] { results = solve(tasks); }));
    const auto errors = impulse_errors(results, exact);
    double evaluations = 0, steps = 0;
    for (const Result& r : results) {
      evaluations += double(r.evaluations) / n;
      steps += double(r.steps) / n;
    }
    points.push_back({{"rtol", rtol},
                      {"error", errors[errors.size() * 9 / 10]},
                      {"median_error", errors[errors.size() / 2]},
                      {"evaluations", evaluations},
                      {"steps", steps},
                      {"ms_per_bristle", 1e3 * median(times) / n}});
    if (errors[errors.size() / 2] < kSmallestError && errors[errors.size() * 9 / 10] < kSmallestError) break;
  }
  return {{"name", name}, {"curve", points}};
}

// For a sequence of halved fixed steps: how often each halving halves the error of the state and integrals at
// the end, and the sum of the estimates, on bristles under a soft wall with friction that changes slowly.
template <class M>
void print_order(const std::vector<PassageTask>& tasks, Tables& tables) {
  constexpr double duration = 1;
  const auto run = [&]<class Method>(Method, const PassageTask& task, int steps, double& estimates) {
    Problem p{task.bristle, tables.of(task)};
    OdeState y = pack(state_at_rest(task.bristle, task.start));
    Attempt attempt;
    estimates = 0;
    for (int i = 0; i < steps; ++i) {
      Evaluation at;
      p.evaluate(y, at);
      Method::attempt(p, y, at, duration / steps, attempt);
      y = attempt.y;
      estimates += error_norm(y, attempt.error, 1, 1);
    }
    return y;
  };
  std::string errors, estimates;
  double last_error = 0, last_estimate = 0;
  for (int steps = 16; steps <= 1024; steps *= 2) {
    double error = 0, estimate = 0;
    for (const PassageTask& task : tasks) {
      double one = 0, unused = 0;
      const OdeState y = run(M(), task, steps, one), exact = run(DormandPrince(), task, 8192, unused);
      for (int c = 0; c < kComponents; ++c) error = std::max(error, std::abs(y[c] - exact[c]));
      estimate = std::max(estimate, one);
    }
    if (last_error > 0) {
      errors += fmt::format("  {:.1e} ({:.2f})", error, std::log2(last_error / error));
      estimates += fmt::format("  {:.1e} ({:.2f})", estimate, std::log2(last_estimate / estimate));
    }
    last_error = error;
    last_estimate = estimate;
  }
  fmt::print("{}\n  errors (orders)   {}\n  estimates (orders){}\n", M::name, errors, estimates);
}

void print_orders() {
  std::deque<Parameters> parameters;
  std::vector<PassageTask> tasks;
  for (const double k_r : {3.0, 10.0, 40.0}) {
    Parameters& p = parameters.emplace_back();
    p.friction = k_r == 10 ? FrictionLaw::coulomb : FrictionLaw::nss;
    p.k_r = k_r;
    p.V_s = 0.5;
    p.lambda_z = 0.1;
    p.beta = 0.2;
    p.C = chi_C_peak_at_V_s(p.A);
    const auto b = make_bristle(p, 0.7, 0.8);
    tasks.push_back({&p, b, static_equilibrium(b), {}});
  }
  Tables tables;
  const auto print = [&]<class... M>(M...) { (print_order<M>(tasks, tables), ...); };
  print(Additive<Shipped>(), Additive<TwoIterations>(), Additive<Extrapolated>(), DormandPrince(),
        Chebyshev(), Rosenbrock<BlockOnly>(), Rosenbrock<Columns>(), Exponential<BlockOnly>(),
        Exponential<Columns>());
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Work and precision of further classes of methods, in scalar code");
  bool orders = false;
  int count = 256, repeats = 3;
  app.add_flag("--orders", orders, "print the order of convergence of each method");
  app.add_option("--bristles", count, "number of bristles");
  app.add_option("--repeats", repeats, "times are medians of this many");
  CLI11_PARSE(app, argc, argv);
  if (orders) {
    print_orders();
    return 0;
  }
  const Bristles bristles(count, 1.8);
  const auto exact = run_lanes(best_kernels(), bristles.at(1e-11));
  Tables tables;
  Json out = Json::array();
  // The engine, whose errors those of the scalar code of the same method should equal.
  out.push_back(curve("engine", bristles, exact, repeats, [](const std::vector<PassageTask>& tasks) {
    std::vector<Result> results;
    for (const Passage& p : run_lanes(best_kernels(), tasks))
      results.push_back({p.end, p.steps, p.evaluations, p.complete()});
    return results;
  }));
  const auto add = [&]<class... M>(M...) {
    (out.push_back(curve(M::name, bristles, exact, repeats,
                         [&](const std::vector<PassageTask>& tasks) {
                           std::vector<Result> results;
                           for (const PassageTask& task : tasks)
                             results.push_back(integrate<M>(task, tables.of(task)));
                           return results;
                         })),
     ...);
  };
  add(Additive<Shipped>(), Additive<TwoIterations>(), Additive<Extrapolated>(), DormandPrince(), Chebyshev(),
      Rosenbrock<BlockOnly>(), Rosenbrock<Columns>(), Exponential<BlockOnly>(), Exponential<Columns>());
  fmt::print("{}\n", out.dump(1));
}
