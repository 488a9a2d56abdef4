#include "experiment/parameters_table.hpp"

#include "model/friction/laws.hpp"

#include <cmath>

namespace bristle::experiment {

namespace {

template <class Enum>
Choice choice(const char* name, const char* description, Enum Parameters::*member,
              std::vector<std::string> options) {
  return {name, description, std::move(options), [member](const Parameters& p) { return int(p.*member); },
          [member](Parameters& p, int index) { p.*member = Enum(index); }};
}

}  // namespace

const std::vector<ParameterEntry>& parameters_table() {
  using P = Parameters;
  static const std::vector<ParameterEntry> table = {
      {"k_r", &P::k_r, 1, R"(\tilde{k}_r)", "radial stiffness"},
      {"k_theta", &P::k_theta, 1, R"(\tilde{k}_\theta)", "azimuthal stiffness"},
      {"k_phi", &P::k_phi, 1, R"(\tilde{k}_\varphi)", "polar stiffness"},
      {"phi_0_deg", &P::phi_0, M_PI / 180, R"(\varphi_0)", "undeformed polar angle"},
      {"zeta_theta", &P::zeta_theta, 1, R"(\zeta_\theta)", "azimuthal damping ratio"},
      {"zeta_phi", &P::zeta_phi, 1, R"(\zeta_\varphi)", "polar damping ratio"},
      {"mu_c", &P::mu_c, 1, R"(\mu_c)", "Coulomb friction coefficient"},
      {"tau_f", &P::tau_f, 1, R"(\tilde{\tau}_f)", "NSS shear stress"},
      {"R_c", &P::R_c, 1, R"(\tilde{R}_c)", "tip radius"},
      {"E_star", &P::E_star, 1, R"(\tilde{E}^*)", "contact modulus"},
      {"A", &P::A, 1, "A", "maximum of chi"},
      {"C", &P::C, 1, "C", "shape of chi"},
      {"V_s", &P::V_s, 1, "V_s/V_0", "threshold speed"},
      {"lambda", &P::lambda, 1, R"(\lambda)", "range of the pole repulsion"},
      {"lambda_z", &P::lambda_z, 1, R"(\lambda_z)", "range of the slab's wall"},
      {"alpha", &P::alpha, 1, R"(\alpha)", "strength of the pole repulsion"},
      {"beta", &P::beta, 1, R"(\beta)", "strength of the slab's wall"},
      {"s_min", &P::s_min, 1, R"(s_{\min})", "distance from the pole at which the pole rule acts"},
      {"L_x", &P::L_x, 1, R"(\tilde{L}_x)", "slab length"},
      {"L_y", &P::L_y, 1, R"(\tilde{L}_y)", "slab width"},
      {"spacing", &P::spacing, 1, R"(\tilde{\Delta})", "lattice spacing"},
  };
  return table;
}

const std::vector<Choice>& choices_table() {
  using P = Parameters;
  static const std::vector<Choice> table = {
      choice("friction", "local friction law", &P::friction, friction_law_names()),
      choice("azimuth_rate", "closing equation for theta'", &P::azimuth_rate, {"kinematic", "as_printed"}),
      choice("initial_state", "state at the leading edge", &P::initial_state,
             {"static_equilibrium", "at_slab", "unstretched", "upright"}),
      choice("pole_rule", "rule for a tip that reaches s = s_min", &P::pole_rule, {"reflect", "cross"}),
  };
  return table;
}

}  // namespace bristle::experiment
