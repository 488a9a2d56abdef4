#pragma once

#include "bristle/simd/group.hpp"
#include "bristle/simd/modulation.hpp"
#include "bristle/simd/regions.hpp"

#include <algorithm>
#include <new>
#include <numeric>

namespace bristle::HWY_NAMESPACE {

// Steps by an additive Runge-Kutta pair. Friction and the azimuth's damper, which are stiff while the tip
// sticks or is near the pole, are implicit in the in-plane velocity; all other terms are explicit. The place
// of a stage is known before its velocity, so that a stage solves a 2 x 2 system. One iteration of Newton's
// method suffices, from the velocity that the two stages before extrapolate to: the stage's equation then
// holds exactly for a friction force that is linearised about that velocity. From the velocity of one stage
// before, the error of the linearisation would reduce the order of the pair to 2. Near the pole the damper of
// the polar angle is implicit, too, in all of the velocity: with c_phi/r^2 it is stiff for a tip near the
// base. So are both dampers of a rod.
template <class Tableau, class Region>
class AdditiveStep {
 public:
  static constexpr double kExponent = Tableau::exponent;

  // Attempts a step of each group.
  static void attempt(Group* groups, int count) {
    alignas(64) static thread_local Work work[kVectors];
    stages(groups, work, count, std::make_index_sequence<S>());
  }

 private:
  static constexpr int S = Tableau::stages;
  static constexpr bool kAzimuthDamper = Region::kImplicitAzimuthDamper;
  static constexpr bool kPolarDamper = Region::kImplicitPolarDamper;
  static constexpr bool kRodDampers = Region::kImplicitRodDampers;
  static constexpr std::bool_constant<!kRodDampers> kPole{};
  // Returns true if the component c is integrated. The angles of a rod are not, because no force depends on
  // them.
  static constexpr bool is_integrated(int c) {
    return !kRodDampers || (c != component::THETA && c != component::PHI);
  }
  static constexpr int kImplicit = kPolarDamper || kRodDampers ? 3 : 2;  // components of the velocity

  struct Work {
    Slopes<S> k;
    Slopes<S, kImplicit> implicit;  // acceleration by friction and the implicit dampers
    State<Lanes> state;  // of the stage; before solve(), without the implicit acceleration of this stage
    Place<Lanes> place;  // constructed in place: an assignment would copy its 19 vectors
    InPlane<Lanes> velocity, velocity_before;  // of the last stage and of the one before it
    // Motion where Newton's method starts, then at the velocity of the stage; secant and slope of the
    // modulation stay at the start.
    Sliding<Lanes> sliding;
    TableEntry entry;
    Lanes secant, slope;
    InPlane<Lanes> friction;
    Lanes h_gamma, one_h_gamma;
    Path<Lanes> path;  // with this step, as far as the stages are known
  };

  static HWY_INLINE void set_sliding(const Group& g, Work& w, Lanes v_x, Lanes v_y) {
    w.sliding = relative_motion(v_x, v_y);
    look_up(*g.modulation, w.sliding.V_R, g.bristle.V_scale, w.entry);
  }
  static HWY_INLINE void set_modulation(const Group& g, Work& w) {
    const Modulation modulation = modulation_of(*g.modulation, g.bristle.V_scale, w.entry);
    w.sliding.modulation = modulation.value;
    w.secant = modulation.secant;
    w.slope = modulation.slope;
  }

  // Returns the component of the velocity along e_theta, along which the azimuth's damper exerts its force.
  static HWY_INLINE Lanes along_theta(const Frame<Lanes>& f, Lanes v_x, Lanes v_y) {
    return f.cos_theta * v_y - f.sin_theta * v_x;
  }

  static HWY_INLINE Vector3<Lanes> e_phi_of(const Frame<Lanes>& f) {
    return {-f.sin_phi * f.cos_theta, -f.sin_phi * f.sin_theta, f.cos_phi};
  }

  static HWY_NOINLINE HWY_FLATTEN void first_stage(const Group& g, Work& w) {
    w.h_gamma = g.h * Lanes(Tableau::gamma);
    w.one_h_gamma = 1.0 / w.h_gamma;
    w.state = unpack<Lanes>(g.y);
    w.velocity = {w.state.v[0], w.state.v[1]};
    set_sliding(g, w, w.velocity[0], w.velocity[1]);
    new (&w.place) Place<Lanes>(place_at(g.bristle, w.state.r, kPole));
    set_modulation(g, w);
    w.friction = friction_force(w.place.friction_limit, w.sliding);
    const Frame<Lanes>& f = w.place.frame;
    w.implicit[0] = {w.friction[0], w.friction[1]};
    if constexpr (kAzimuthDamper) {
      const Lanes damper = azimuth_damping(g.bristle, f) * along_theta(f, w.state.v[0], w.state.v[1]);
      w.implicit[0][0] += damper * f.sin_theta;
      w.implicit[0][1] -= damper * f.cos_theta;
    }
    if constexpr (kPolarDamper) {
      const Vector3<Lanes> e_phi = e_phi_of(f);
      const Lanes force = -polar_damping(g.bristle, f) * dot(e_phi, w.state.v);
      w.implicit[0][2] = force * e_phi[2];
      for (int i = 0; i < 2; ++i) w.implicit[0][i] += force * e_phi[i];
    }
    if constexpr (kRodDampers) {
      const RodAngles<Lanes>& rod = w.place.rod;
      const Lanes along_p = -g.bristle.c_phi * dot(rod.grad_p, w.state.v);
      const Lanes along_s = -g.bristle.c_theta * dot(rod.grad_s, w.state.v);
      w.implicit[0][2] = along_p * rod.grad_p[2] + along_s * rod.grad_s[2];
      for (int i = 0; i < 2; ++i) w.implicit[0][i] += along_p * rod.grad_p[i] + along_s * rod.grad_s[i];
    }
    slopes_of(g.bristle, w.state, motion(g.bristle, w.state, w.place, w.sliding, w.friction, kPole), w.k[0],
              kPole);
    w.path = g.path;
    add_position(g.bristle, w.state.r, f, g.x_0, w.path);
    add_stage<0>(g, w);
  }

  static constexpr int kWeightedStages =
      int(std::ranges::count_if(Tableau::b, [](double b) { return b != 0; }));

  template <int I>
  static HWY_INLINE void add_stage(const Group& g, Work& w) {
    if constexpr (Tableau::b[I] != 0)
      add_instant(g.bristle, w.state.r[2], w.place.contact, w.sliding, w.friction,
                  Lanes(g.h * Lanes(Tableau::b[I])), Lanes(g.h * Lanes(1.0 / kWeightedStages)), w.path);
  }

  // Returns the time of stage i within the step, as a share of the step.
  static constexpr double time(int i) {
    return std::accumulate(std::begin(Tableau::a[i]), std::end(Tableau::a[i]), 0.0);
  }

  // Sets the place and where Newton's method starts: for the first implicit stage, the velocity before.
  template <int I>
  static HWY_NOINLINE HWY_FLATTEN void locate(const Group& g, Work& w) {
    if constexpr (I > 1) {
      constexpr double ahead = (time(I) - time(I - 1)) / (time(I - 1) - time(I - 2));
      const auto extrapolated = [&](int i) {
        return Lanes(w.velocity[i] + Lanes(ahead) * (w.velocity[i] - w.velocity_before[i]));
      };
      set_sliding(g, w, extrapolated(0), extrapolated(1));
    }
    new (&w.place) Place<Lanes>(place_at(g.bristle, w.state.r, kPole));
    if constexpr (I > 1) set_modulation(g, w);
  }

  // Solves for the velocity.
  static HWY_NOINLINE HWY_FLATTEN void solve(const Group& g, Work& w,
                                             std::array<Lanes, kImplicit>& implicit) {
    const Bristle<Lanes>& b = g.bristle;
    const Frame<Lanes>& f = w.place.frame;
    const Sliding<Lanes>& s = w.sliding;
    const Lanes limit = w.h_gamma * w.place.friction_limit;
    const Lanes from_x = w.state.v[0], from_y = w.state.v[1];
    const Lanes v_x = s.V_x + 1.0, v_y = s.V_y;
    const Lanes secant = limit * w.secant;
    Lanes residual_x = (v_x - from_x) + secant * s.V_x;
    Lanes residual_y = (v_y - from_y) + secant * s.V_y;
    const Lanes diagonal = 1.0 + secant;
    // Where the modulation falls steeply with the speed, a smaller slope keeps the matrix regular.
    const Lanes along_e = max(limit * w.slope - secant, 0.1 - diagonal);
    const Lanes e_x = along_e * s.e_x;
    Lanes m_xx = diagonal + e_x * s.e_x, m_yy = diagonal + Lanes(along_e * s.e_y) * s.e_y;
    Lanes m_xy = e_x * s.e_y;
    if constexpr (kAzimuthDamper) {
      const Lanes h_damping = w.h_gamma * azimuth_damping(b, f);
      const Lanes damper = h_damping * along_theta(f, v_x, v_y);
      residual_x -= damper * f.sin_theta;
      residual_y += damper * f.cos_theta;
      const Lanes t_x = h_damping * f.sin_theta, t_y = h_damping * f.cos_theta;
      m_xx += t_x * f.sin_theta;
      m_yy += t_y * f.cos_theta;
      m_xy -= t_x * f.cos_theta;
    }
    const Lanes inverse = 1.0 / (m_xx * m_yy - m_xy * m_xy);
    Lanes change_x = Lanes(m_xy * residual_y - m_yy * residual_x) * inverse;
    Lanes change_y = Lanes(m_xy * residual_x - m_xx * residual_y) * inverse;
    // The matrix of friction and the azimuth's damper times the result is e.
    const auto divided = [&](const Vector3<Lanes>& e) -> Vector3<Lanes> {
      return {Lanes(m_yy * e[0] - m_xy * e[1]) * inverse, Lanes(m_xx * e[1] - m_xy * e[0]) * inverse, e[2]};
    };
    if constexpr (kPolarDamper) {  // adds a matrix of rank one, by the formula of Sherman and Morrison
      const Vector3<Lanes> e = e_phi_of(f);
      const Lanes damping = w.h_gamma * polar_damping(b, f);
      const Vector3<Lanes> across = divided(e);
      const Lanes v_phi = dot(e, {v_x + change_x, v_y + change_y, w.state.v[2]});
      const Lanes force = damping * v_phi / (1.0 + damping * dot(e, across));
      change_x -= force * across[0];
      change_y -= force * across[1];
      const Lanes change_z = -force * across[2];
      implicit[2] = change_z * w.one_h_gamma;
      w.state.v[2] += change_z;
    }
    if constexpr (kRodDampers) {  // adds a matrix of rank two, by the formula of Woodbury
      const RodAngles<Lanes>& rod = w.place.rod;
      const Lanes damping_p = w.h_gamma * b.c_phi, damping_s = w.h_gamma * b.c_theta;
      const Vector3<Lanes> across_p = divided(rod.grad_p), across_s = divided(rod.grad_s);
      const Vector3<Lanes> undamped = {v_x + change_x, v_y + change_y, w.state.v[2]};
      const Lanes rate_p = damping_p * dot(rod.grad_p, undamped),
                  rate_s = damping_s * dot(rod.grad_s, undamped);
      const Lanes n_pp = 1.0 + damping_p * dot(rod.grad_p, across_p);
      const Lanes n_ss = 1.0 + damping_s * dot(rod.grad_s, across_s);
      const Lanes coupling = dot(rod.grad_p, across_s);
      const Lanes n_ps = damping_p * coupling, n_sp = damping_s * coupling;
      const Lanes one_n = 1.0 / (n_pp * n_ss - n_ps * n_sp);
      const Lanes force_p = Lanes(n_ss * rate_p - n_ps * rate_s) * one_n;
      const Lanes force_s = Lanes(n_pp * rate_s - n_sp * rate_p) * one_n;
      change_x -= force_p * across_p[0] + force_s * across_s[0];
      change_y -= force_p * across_p[1] + force_s * across_s[1];
      const Lanes change_z = -Lanes(force_p * across_p[2] + force_s * across_s[2]);
      implicit[2] = change_z * w.one_h_gamma;
      w.state.v[2] += change_z;
    }
    const Lanes new_x = v_x + change_x, new_y = v_y + change_y;
    implicit[0] = (new_x - from_x) * w.one_h_gamma;
    implicit[1] = (new_y - from_y) * w.one_h_gamma;
    const Lanes steeper = along_e * Lanes(s.e_x * change_x + s.e_y * change_y);
    w.friction = {-w.one_h_gamma * Lanes(secant * (new_x - 1.0) + steeper * s.e_x),
                  -w.one_h_gamma * Lanes(secant * new_y + steeper * s.e_y)};
    w.state.v[0] = new_x;
    w.state.v[1] = new_y;
    w.velocity_before = w.velocity;
    w.velocity = {new_x, new_y};
    const Sliding<Lanes> start = s;
    w.sliding = relative_motion(new_x, new_y);
    w.sliding.modulation = start.modulation + w.slope * (w.sliding.V_R - start.V_R);
  }

  template <int I>
  static HWY_NOINLINE HWY_FLATTEN void evaluate(const Group& g, Work& w) {
    slopes_of(g.bristle, w.state, motion(g.bristle, w.state, w.place, w.sliding, w.friction, kPole), w.k[I],
              kPole);
    add_stage<I>(g, w);
  }

  template <std::size_t... I>
  static HWY_INLINE void stages(Group* groups, Work* work, int count, std::index_sequence<I...>) {
    const auto all = [&](auto stage) {
      for (int i = 0; i < count; ++i) advance<stage>(groups[i], work[i]);
    };
    (all(std::integral_constant<int, int(I)>{}), ...);
  }
  // Computes the slopes of stage I, then the next stage up to where its velocity is solved for, or the end of
  // the step. Solving takes long for its few operations, as each waits for the one before; the processor
  // overlaps it with what precedes it here in the other group.
  template <int I>
  static HWY_INLINE void advance(Group& g, Work& w) {
    if constexpr (I == 0) {
      first_stage(g, w);
    } else {
      solve(g, w, w.implicit[I]);
      evaluate<I>(g, w);
    }
    if constexpr (I + 1 < S) {
      predict<I + 1>(g, w);
      locate<I + 1>(g, w);
    } else {
      finish(g, w);
    }
  }

  // Computes the state of stage I without the implicit acceleration of this stage.
  template <int I>
  static HWY_NOINLINE HWY_FLATTEN void predict(const Group& g, Work& w) {
    std::array<Lanes, kState> at;
    for (int c = 0; c < kState; ++c)
      at[c] = is_integrated(c)
                  ? Lanes(g.y[c] + g.h * weighted_sum<I>(w.k, c, [](int j) { return Tableau::a[I][j]; }))
                  : g.y[c];
    // The sum above weights the implicit parts of the slopes by a; they need the weights a_implicit.
    for (int i = 0; i < kImplicit; ++i)
      at[component::VX + i] += g.h * weighted_sum<I>(w.implicit, i, [](int j) {
                                 return Tableau::a_implicit[I][j] - Tableau::a[I][j];
                               });
    w.state = unpack<Lanes>(at);
  }

  static HWY_NOINLINE HWY_FLATTEN void finish(Group& g, const Work& w) {
    ErrorNorm norm(g);
    for (int c = 0; c < COMPONENTS; ++c) {
      if (!is_integrated(c)) {
        g.y_new[c] = g.y[c];
        continue;
      }
      g.y_new[c] = g.y[c] + g.h * weighted_sum<S>(w.k, c, [](int j) { return Tableau::b[j]; });
      norm.add(c, g.h * weighted_sum<S>(w.k, c, [](int j) { return Tableau::error[j]; }));
    }
    g.error = norm.value();
    g.path_new = w.path;
  }
};

template <class Tableau, class Region>
using AdditiveKernel = Kernel<AdditiveStep<Tableau, Region>, Region>;

}  // namespace bristle::HWY_NAMESPACE
