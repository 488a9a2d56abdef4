#pragma once

#include "bristle/words.hpp"

#include <array>
#include <cmath>
#include <limits>

namespace bristle {

class ModulationTable;         // model/friction/table.hpp
enum class FrictionLaw : int;  // model/friction/laws.hpp
template <>
Words words<FrictionLaw>();

// Model of the springs against bending. polar: the springs of the paper in the angles theta and phi, Eq.
// (13), with theta' kinematically exact. polar_as_printed: with theta' by Eq. (17) as printed. rod: springs
// of the same stiffnesses in coordinates without a pole (model/rod.hpp).
enum class Bending {
  polar,
  polar_as_printed,
  rod
};
template <>
inline Words words<Bending>() {
  static constexpr const char* list[] = {"polar", "polar_as_printed", "rod"};
  return list;
}

// Returns whether the coordinates of bending are singular upright, at s = 0: there the pole repulsion and the
// pole rule act. A rod has neither.
constexpr bool has_pole(Bending bending) { return bending != Bending::rod; }
// Returns whether dE/dt is exactly the power of forces and dampers (model/energy.hpp).
constexpr bool conserves_energy(Bending bending) { return bending != Bending::polar_as_printed; }

// Law of the contact between slab and tip (model/contact.hpp). wall: the paper's short-range wall, Eq. (3).
// hertz: a tip of radius R_c and contact modulus E_star.
enum class Contact {
  wall,
  hertz
};
template <>
inline Words words<Contact>() {
  static constexpr const char* list[] = {"wall", "hertz"};
  return list;
}

// Cross-section of the shaft, which matters to a rod only. round: k_theta equals k_phi, whatever the
// parameter k_theta is. oval: k_theta is the parameter.
enum class Section {
  round,
  oval
};
template <>
inline Words words<Section>() {
  static constexpr const char* list[] = {"round", "oval"};
  return list;
}

// State of the bristle at the slab's leading edge, at rest in the vertical plane theta = theta_0:
// static_equilibrium: frictionless equilibrium of springs, pole repulsion and contact force;
// at_slab: tip at z = z_0, at the polar angle of least energy of springs and pole repulsion;
// unstretched: r = 1, tip at z_0, and 5 lambda_z below it under a wall;
// upright: tip at z = z_0, at the undeformed polar angle phi_0.
enum class InitialState {
  static_equilibrium,
  at_slab,
  unstretched,
  upright
};
template <>
inline Words words<InitialState>() {
  static constexpr const char* list[] = {"static_equilibrium", "at_slab", "unstretched", "upright"};
  return list;
}

// Rule for a tip that reaches s = s_min. reflect reverses its radial in-plane velocity. cross moves it to the
// opposite side of the pole.
enum class PoleRule {
  reflect,
  cross
};
template <>
inline Words words<PoleRule>() {
  static constexpr const char* list[] = {"reflect", "cross"};
  return list;
}

// What the friction law "custom" needs. The experiment owns the table.
struct CustomFriction {
  const ModulationTable* table = nullptr;
  double V_0 = 1;  // velocity of the slab, in the unit of the table's speeds
};

// The parameters of bristle, friction and slab, dimensionless (length r0, time r0/V0, force m V0^2/r0), with
// their defaults. kParameters and choices() below describe them. Values without a source in the paper are
// assumptions, listed in docs/model.md.
struct Parameters {
  FrictionLaw friction{};  // nss
  Bending bending = Bending::polar;
  Contact contact = Contact::wall;
  Section section = Section::round;
  InitialState initial_state = InitialState::static_equilibrium;
  PoleRule pole_rule = PoleRule::reflect;
  double k_r = 10;
  double k_theta = 1;
  double k_phi = 1.9;
  double phi_0 = 1.3962634015954636;  // rad (80 deg)
  double zeta_theta = 0.1;
  double zeta_phi = 0.1;
  double mu_c = 1;
  double tau_f = 3e4;
  double R_c = 1.0 / 17;
  double E_star = 5.849e4;
  double A = 1.2;
  double C = -5.592;
  double V_s = 0.01;
  double lambda = 1e-3;
  double lambda_z = 1e-3;
  double alpha = 1;
  double beta = 1;
  double s_min = 1e-4;
  double L_x = 5;
  double L_y = 5;
  double spacing = 0.2;
  double R = 0.0637;  // from k_phi = 3 pi E R^4/4 with the paper's k_phi, E_star and nu = 0.4
  double strain_limit = 0.05;
  double stretch_limit = 0.5;
  double pressure_limit = std::numeric_limits<double>::infinity();
  CustomFriction custom_friction;
};

// Returns the azimuthal stiffness of bristles: k_phi for round rods.
inline double azimuthal_stiffness(const Parameters& p) {
  return p.bending == Bending::rod && p.section == Section::round ? p.k_phi : p.k_theta;
}

// Returns how far the contact force reaches below the slab, in units of r0; 0 with the Hertz contact.
inline double contact_range(const Parameters& p) { return p.contact == Contact::wall ? p.lambda_z : 0; }

// Returns the room between the shafts of neighbours, over their diameter: spacing/(2 R) - 1. They overlap if
// it is negative.
inline double clearance(const Parameters& p) { return p.spacing / (2 * p.R) - 1; }

// Returns the length of a shaft over its diameter, r_0/(2 R).
inline double slenderness(const Parameters& p) { return 1 / (2 * p.R); }

// Limits of the values that an experiment may give a number.
struct Bounds {
  double least = -std::numeric_limits<double>::infinity(), most = std::numeric_limits<double>::infinity();
  bool above_least = false, below_most = false;  // whether the limit itself is excluded
};
constexpr Bounds kPositive{.least = 0, .above_least = true}, kNotNegative{.least = 0};

// Describes a number in Parameters for experiments, results and documents. The key of the block "model", its
// limits, its axis in sweeps and the attributes of that axis follow from its row.
struct Parameter {
  const char* name;  // JSON key
  double Parameters::*member;
  const char* symbol;  // LaTeX
  const char* description;
  const char* scale;  // unit or equation of the JSON value, in its description
  Bounds limits;
  double unit = 1;             // member = JSON value * unit
  const char* word = nullptr;  // word that an experiment may give instead: the program computes the number
};

inline constexpr std::array kParameters = {
    Parameter{"k_r", &Parameters::k_r, R"(\tilde{k}_r)", "radial stiffness", "dimensionless", kPositive},
    Parameter{"k_theta", &Parameters::k_theta, R"(\tilde{k}_\theta)", "azimuthal stiffness", "dimensionless",
              kPositive},
    Parameter{"k_phi", &Parameters::k_phi, R"(\tilde{k}_\varphi)", "polar stiffness", "dimensionless",
              kPositive},
    Parameter{"phi_0_deg",
              &Parameters::phi_0,
              R"(\varphi_0)",
              "undeformed polar angle",
              "degrees",
              {0, 90, true, true},
              M_PI / 180},
    Parameter{"zeta_theta", &Parameters::zeta_theta, R"(\zeta_\theta)", "azimuthal damping ratio", "Eq. (11)",
              kNotNegative},
    Parameter{"zeta_phi", &Parameters::zeta_phi, R"(\zeta_\varphi)", "polar damping ratio", "Eq. (11)",
              kNotNegative},
    Parameter{"mu_c", &Parameters::mu_c, R"(\mu_c)", "Coulomb friction coefficient", "Eq. (14)",
              kNotNegative},
    Parameter{"tau_f", &Parameters::tau_f, R"(\tilde{\tau}_f)", "NSS shear stress", "dimensionless",
              kNotNegative},
    Parameter{"R_c", &Parameters::R_c, R"(\tilde{R}_c)", "tip radius", "in units of r0", kPositive},
    Parameter{"E_star", &Parameters::E_star, R"(\tilde{E}^*)", "contact modulus", "dimensionless", kPositive},
    Parameter{"A", &Parameters::A, "A", "maximum of chi", "Eq. (7)", {.least = 1}},
    Parameter{"C", &Parameters::C, "C", "shape of chi", "Eq. (7)", {-1000, 1}, 1, "peak_at_V_s"},
    Parameter{"V_s", &Parameters::V_s, "V_s/V_0", "threshold speed", "in units of V0", kPositive},
    Parameter{"lambda", &Parameters::lambda, R"(\lambda)", "range of the pole repulsion", "in units of r0",
              kPositive},
    Parameter{"lambda_z", &Parameters::lambda_z, R"(\lambda_z)", "range of the slab's wall", "in units of r0",
              kPositive},
    Parameter{"alpha", &Parameters::alpha, R"(\alpha)", "strength of the pole repulsion", "dimensionless",
              kNotNegative},
    Parameter{"beta", &Parameters::beta, R"(\beta)", "strength of the slab's wall", "dimensionless",
              kPositive},
    Parameter{"s_min", &Parameters::s_min, R"(s_{\min})",
              "distance from the pole, or from a rod's base, at which a tip is reflected", "in units of r0",
              kPositive},
    Parameter{"L_x", &Parameters::L_x, R"(\tilde{L}_x)", "slab length", "in units of r0", kPositive},
    Parameter{"L_y", &Parameters::L_y, R"(\tilde{L}_y)", "slab width", "in units of r0", kPositive},
    Parameter{"spacing", &Parameters::spacing, R"(\tilde{\Delta})", "lattice spacing", "in units of r0",
              kPositive},
    Parameter{"R", &Parameters::R, R"(\tilde{R})", "radius of the bristle's shaft", "in units of r0",
              kPositive},
    Parameter{"strain_limit", &Parameters::strain_limit, R"(\epsilon_{\mathrm{limit}})",
              "strain at the root beyond which exceeds_strain_limit is yes", "dimensionless", kPositive},
    Parameter{"stretch_limit", &Parameters::stretch_limit, R"((r - 1)_{\mathrm{limit}})",
              "elongation beyond which exceeds_stretch_limit is yes", "in units of r0", kPositive},
    Parameter{"pressure_limit", &Parameters::pressure_limit, R"(p_{\mathrm{limit}})",
              "contact pressure beyond which exceeds_pressure_limit is yes", "dimensionless", kPositive},
};

// Describes an enumeration in Parameters, whose JSON value is one of several words.
struct Choice {
  const char* name;  // JSON key
  const char* description;
  Words words;
  int (*get)(const Parameters&);  // index of the word
  void (*set)(Parameters&, int);
};

template <auto member>
Choice choice(const char* name, const char* description) {
  using Enum = std::remove_reference_t<decltype(std::declval<Parameters&>().*member)>;
  return {name, description, words<Enum>(), [](const Parameters& p) { return int(p.*member); },
          [](Parameters& p, int index) { p.*member = Enum(index); }};
}

inline const auto& choices() {
  static const std::array table = {
      choice<&Parameters::friction>("friction", "local friction law"),
      choice<&Parameters::bending>("bending", "springs against bending: coordinates and Eq. (17)"),
      choice<&Parameters::contact>("contact",
                                   "contact between slab and tip: the paper's wall, or Hertz's sphere"),
      choice<&Parameters::section>("section",
                                   "cross-section of a rod's shaft: round, with k_theta = k_phi, or oval"),
      choice<&Parameters::initial_state>("initial_state", "state at the leading edge"),
      choice<&Parameters::pole_rule>("pole_rule", "rule for a tip that reaches s = s_min"),
  };
  static_assert(sizeof(Parameters) ==
                    kParameters.size() * sizeof(double) + table.size() * sizeof(int) + sizeof(CustomFriction),
                "kParameters and choices() describe every other member of Parameters");
  return table;
}

// Constants of a friction law's modulation. Each law documents its own; only "custom" has a table.
template <class P>
struct FrictionConstants {
  std::array<P, 3> values{};
  const ModulationTable* table = nullptr;

  const P& operator[](std::size_t i) const { return values[i]; }
  P& operator[](std::size_t i) { return values[i]; }
  bool operator==(const FrictionConstants&) const = default;
};

}  // namespace bristle
