#include "experiment/si_units.hpp"

#include "util/error.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace bristle {
namespace {

double energy_unit(const PointInput& input) {
  const double V0 = input.si.at("V0_m_per_s");
  return input.si.at("m_kg") * V0 * V0;
}

// Bending stiffness of the shaft, N m/rad.
double cantilever(double E, double R, double r0) { return 3 * M_PI * E * (R * R) * (R * R) / (4 * r0); }

}  // namespace

const std::vector<SiQuantity>& si_quantities() {
  static const std::vector<SiQuantity> table = {
      {"m_kg", "m", "tip mass", "kg", {}},
      {"r0_m", "r_0", "bristle length", "m", {}},
      {"V0_m_per_s", "V_0", "slab velocity", "m/s", {}},
      {"E_Pa", "E", "Young's modulus", "Pa", {}},
      {"nu", R"(\nu)", "Poisson's ratio", "1", {"E_star"}},
      {"R_m", "R", "radius of the bristle's shaft", "m", {"k_theta", "k_phi", "k_r"}},
      {"k_r_over_k_phi", R"(\tilde{k}_r/\tilde{k}_\varphi)", "radial over polar stiffness", "1", {"k_r"}},
      {"k_r_N_per_m", "k_r", "radial stiffness", "N/m", {"k_r"}},
      {"k_theta_N_m", R"(k_\theta)", "azimuthal stiffness", "N m", {"k_theta"}},
      {"k_phi_N_m", R"(k_\varphi)", "polar stiffness", "N m", {"k_phi"}},
      {"E_star_Pa", "E^*", "contact modulus", "Pa", {"E_star"}},
      {"tau_f_Pa", R"(\tau_f)", "shear stress", "Pa", {"tau_f"}},
      {"R_c_m", "R_c", "tip radius", "m", {"R_c"}},
      {"V_s_m_per_s", "V_s", "threshold speed", "m/s", {"V_s"}},
      {"alpha_J", R"(\alpha)", "strength of the axis repulsion", "J", {"alpha"}},
      {"beta_J", R"(\beta)", "strength of the slab's wall", "J", {"beta"}},
      {"R_n_N", "R_n/N_{c,0}", "normal load per bristle", "N", {"R_n"}},
  };
  return table;
}

void read_si_units(const Document& document, const std::vector<Axis>& axes, PointInput& input) {
  const auto swept = [&](const std::string& name) { return bristle::swept(axes, name); };
  const Json& json = document.json();
  const bool given = json.contains("si");
  const auto has = [&](const char* key) { return (given && json["si"].contains(key)) || swept(key); };
  for (const SiQuantity& q : si_quantities()) {
    if (!has(q.name)) continue;
    if (!given) document.fail("/si/" + std::string(q.name), "is swept, but there is no si block with m_kg, r0_m and V0_m_per_s");
    for (const char* name : q.replaces)
      if (swept(name)) document.fail("/si/" + std::string(q.name), fmt::format("{} is swept as well; remove one", name));
    if (json["si"].contains(q.name)) input.si[q.name] = json["si"][q.name];
  }
  if ((has("nu") || has("R_m")) != has("E_Pa"))
    document.fail(has("E_Pa") ? "/si/nu" : "/si/E_Pa",
         has("E_Pa") ? "is missing, as is R_m: E_Pa alone says nothing" : "is missing; nu and R_m need it");
  if (has("R_m") && has("k_r_over_k_phi") == has("k_r_N_per_m"))
    document.fail("/si/k_r_over_k_phi",
         "R_m needs either k_r_over_k_phi or k_r_N_per_m for the radial stiffness");
  if (has("k_r_over_k_phi") && !has("R_m")) document.fail("/si/k_r_over_k_phi", "is used with R_m only");
}

void apply_si_units(PointInput& input) {
  if (input.si.empty()) return;
  const auto value = [&](const char* key) { return input.si.at(key); };
  const auto has = [&](const char* key) { return input.si.contains(key); };
  const double r0 = value("r0_m"), energy = energy_unit(input), force = energy / r0;
  const double stress = force / (r0 * r0);
  Parameters& p = input.setup.parameters;
  if (has("R_m")) {
    p.k_theta = p.k_phi = cantilever(value("E_Pa"), value("R_m"), r0) / energy;
    if (has("k_r_over_k_phi")) p.k_r = value("k_r_over_k_phi") * p.k_phi;
  }
  if (has("nu")) p.E_star = value("E_Pa") / (1 - value("nu") * value("nu")) / stress;
  const auto set = [&](const char* key, double scale, double& target) {
    if (has(key)) target = value(key) / scale;
  };
  set("k_r_N_per_m", force / r0, p.k_r);
  set("k_theta_N_m", energy, p.k_theta);
  set("k_phi_N_m", energy, p.k_phi);
  set("E_star_Pa", stress, p.E_star);
  set("tau_f_Pa", stress, p.tau_f);
  set("R_c_m", r0, p.R_c);
  set("V_s_m_per_s", value("V0_m_per_s"), p.V_s);
  set("alpha_J", energy, p.alpha);
  set("beta_J", energy, p.beta);
  set("R_n_N", force, input.loading.R_n);
}

double force_unit(const PointInput& input) {
  if (input.si.empty()) return std::numeric_limits<double>::quiet_NaN();
  return energy_unit(input) / input.si.at("r0_m");
}

}  // namespace bristle
