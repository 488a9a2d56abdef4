#include "results/variables.hpp"

namespace bristle {
namespace {

using Value = std::function<double(const PointResult&)>;

ResultVariable mean(const char* name, const char* long_name, const char* symbol, const char* equation,
                    Observable k) {
  return {name,
          long_name,
          symbol,
          equation,
          [k](const PointResult& p) { return p.value[k]; },
          [k](const PointResult& p) { return p.error[k]; }};
}

// Part of a total that pinned bristles carry.
ResultVariable share(const char* name, const char* long_name, const char* symbol, Observable part,
                     Observable total) {
  const Value value = [=](const PointResult& p) { return p.value[part] / p.value[total]; };
  const Value error = [=](const PointResult& p) {
    return (p.error[part] + value(p) * p.error[total]) / p.value[total];
  };
  return {name, long_name, symbol, "", value, error};
}

ResultVariable field(const char* name, const char* long_name, const char* symbol, const char* equation,
                     double PointResult::*value, double PointResult::*error = nullptr) {
  ResultVariable v{name, long_name, symbol, equation, [value](const PointResult& p) { return p.*value; }, {}};
  if (error) v.error = [error](const PointResult& p) { return p.*error; };
  return v;
}

}  // namespace

const std::vector<ResultVariable>& result_variables() {
  using P = PointResult;
  static const std::vector<ResultVariable> variables = {
      field("z_0", "gap between slab and ground", R"(\tilde{z}_0)", "Fig. 3", &P::z_0, &P::z_0_error),
      mean("R_n", "normal load per bristle", R"(\tilde{R}_n/N_{c,0})", "Eq. (19)", R_N),
      mean("R_x", "friction force per bristle along the motion", R"(\tilde{R}_x/N_{c,0})", "Eq. (19)", R_X),
      mean("R_y", "friction force per bristle across the motion", R"(\tilde{R}_y/N_{c,0})", "Eq. (19)", R_Y),
      field("R_x_norm", "friction force over that of rigid bristles", R"(\check{R}_x)", "Eq. (20)",
            &P::R_x_norm, &P::R_x_norm_error),
      field("R_y_norm", "transverse force over the friction of rigid bristles", R"(\check{R}_y)", "Eq. (21)",
            &P::R_y_norm, &P::R_y_norm_error),
      mean("N_c_ratio", "bristles in contact over those of rigid bristles", R"(N_c/N_{c,0})", "Eq. (A2)",
           N_C_RATIO),
      mean("gamma_1", "modulation of friction by the sliding speed", R"(\tilde{\gamma}_1)", "Eq. (24)",
           GAMMA_1),
      mean("gamma_2", "alignment of friction with the motion", R"(\tilde{\gamma}_2)", "Eq. (25)", GAMMA_2),
      mean("gamma_3", "reduction of the contact area by load fluctuations", R"(\tilde{\gamma}_3)", "Eq. (26)",
           GAMMA_3),
      mean("pinned_fraction", "fraction of bristles held upright at the axis", R"(f_\mathrm{pinned})", "",
           PINNED_FRACTION),
      share("pinned_share_R_n", "pinned bristles' share of R_n", R"(R_{n,\mathrm{pinned}}/R_n)", PINNED_R_N,
            R_N),
      share("pinned_share_R_x", "pinned bristles' share of R_x", R"(R_{x,\mathrm{pinned}}/R_x)", PINNED_R_X,
            R_X),
      mean("energy_residual", "mean defect of the energy budget over the energy dissipated", R"(\epsilon_E)",
           "Eqs. (13, 17, 18)", ENERGY_RESIDUAL),
      field("jump_z_0", "last gap before R_n(z_0) jumps across the target", R"(\tilde{z}_{0,\mathrm{jump}})",
            "Fig. 3", &P::jump_z_0),
      field("jump_R_n", "normal load there", R"(\tilde{R}_{n,\mathrm{jump}}/N_{c,0})", "Fig. 3",
            &P::jump_R_n),
      field("incomplete_theta_0", "azimuth (rad) of the first passage without an exit", R"(\theta_0)", "",
            &P::incomplete_theta_0),
  };
  return variables;
}

const std::vector<BristleVariable>& bristle_variables() {
  using B = const Passage&;
  const auto integral = [](Component c) { return [c](B b) { return b.end[std::size_t(c)]; }; };
  static const std::vector<BristleVariable> variables = {
      {"theta_0", "undeformed azimuth (rad)", R"(\theta_0)", "", [](B b) { return b.theta_0; }},
      {"contact_time", "contact time", R"(\Delta\xi)", "Eq. (A2)", [](B b) { return b.contact_time; }},
      {"normal_impulse", "integral of F_n", R"(\int F_n)", "Eq. (3)", integral(NORMAL)},
      {"friction_impulse_x", "integral of the friction force along the motion", R"(\int F_{f,x})", "Eq. (5)",
       integral(FRICTION_X)},
      {"friction_impulse_y", "integral of the friction force across the motion", R"(\int F_{f,y})", "Eq. (5)",
       integral(FRICTION_Y)},
      {"gamma_1", "ratio in Eq. (24)", R"(\tilde{\gamma}_{1,i})", "Eq. (24)", [](B b) { return b.gamma_1; }},
      {"gamma_2", "ratio in Eq. (25)", R"(\tilde{\gamma}_{2,i})", "Eq. (25)", [](B b) { return b.gamma_2; }},
      {"gamma_3", "ratio in Eq. (26)", R"(\tilde{\gamma}_{3,i})", "Eq. (26)", [](B b) { return b.gamma_3; }},
      {"energy_residual", "defect of the energy budget over the energy dissipated", R"(\epsilon_E)", "",
       [](B b) { return b.energy_residual; }},
      {"steps", "integration steps", "", "", [](B b) { return double(b.steps); }},
      {"reflections", "reflections at the pole, s = s_min", "", "",
       [](B b) { return double(b.reflections); }},
  };
  return variables;
}

const std::vector<std::string> kPointStatusNames = {"ok", "jump", "unreachable", "incomplete",
                                                    "not_converged"};
const std::vector<std::string> kOutcomeNames = {"left", "pinned", "step_limit", "not_finite"};

}  // namespace bristle
