#include "sweep/si.hpp"

#include "bristle/model/material.hpp"

#include <fmt/format.h>
#include <string_view>

namespace bristle::sweep {
namespace {

// Sets the stiffnesses of the shaft and the contact modulus, from the elastic constants of the material.
void apply_material(PointInput& input, const SiScales& scales) {
  const auto value = [&](const char* key) { return input.si.at(key); };
  const auto has = [&](const char* key) { return input.si.contains(key); };
  Parameters& p = input.setup.parameters;
  if (has("R_m")) {
    p.k_phi = (has("k_phi_N_m") ? value("k_phi_N_m")
                                : cantilever_stiffness(value("E_Pa"), value("R_m"), scales.length)) /
              scales.energy;
    p.R = value("R_m") / scales.length;
    p.k_theta = (has("k_theta_over_k_phi") ? value("k_theta_over_k_phi") : 1) * p.k_phi;
    if (has("k_r_over_k_phi")) p.k_r = value("k_r_over_k_phi") * p.k_phi;
  }
  if (has("nu")) p.E_star = contact_modulus(value("E_Pa"), value("nu")) / scales.stress;
}

// Returns the values that SI quantities can replace, as "name = value": the values that they do replace
// (given), or the values that they do not.
std::vector<std::string> replaceable_values(const PointInput& input, bool given) {
  std::vector<std::string> out;
  for (const Parameter& entry : kParameters) {
    bool convertible = false, replaced = false;
    for (const SiQuantity& q : si_quantities())
      for (const char* name : q.replaces)
        if (std::string_view(name) == entry.name) {
          convertible = true;
          replaced = replaced || input.si.contains(q.name);
        }
    const Parameters& p = input.setup.parameters;
    const bool acts = entry.member == &Parameters::alpha  ? has_pole(p.bending)
                      : entry.member == &Parameters::beta ? p.contact == Contact::wall
                                                          : std::isfinite(p.*entry.member);
    if (convertible && replaced == given && acts)
      out.push_back(fmt::format("{} = {:.6g}", entry.name, input.setup.parameters.*entry.member));
  }
  return out;
}

}  // namespace

const std::vector<SiQuantity>& si_quantities() {
  using S = SiScales;
  static const std::vector<SiQuantity> table = {
      {"m_kg", "m", "tip mass", "kg", kPositive, {}},
      {"rho_kg_per_m3",
       R"(\rho)",
       "density of the shaft",
       "kg/m^3",
       kPositive,
       {},
       nullptr,
       "with R_m, in place of m_kg: the tip mass is 0.2427 of the mass of the shaft, as in its first mode of "
       "bending"},
      {"r0_m", "r_0", "bristle length", "m", kPositive, {}},
      {"V0_m_per_s", "V_0", "slab velocity", "m/s", kPositive, {}},
      {"E_Pa", "E", "Young's modulus", "Pa", kPositive, {}},
      {"nu", R"(\nu)", "Poisson's ratio", "1", {0, 0.5}, {"E_star"}, nullptr, "with E_Pa: contact modulus"},
      {"R_m",
       "R",
       "radius of the bristle's shaft",
       "m",
       kPositive,
       {"k_theta", "k_phi", "k_r", "R"},
       nullptr,
       "with E_Pa: bending stiffnesses; strain at the root"},
      {"k_r_over_k_phi",
       R"(\tilde{k}_r/\tilde{k}_\varphi)",
       "radial over polar stiffness",
       "1",
       kPositive,
       {"k_r"},
       nullptr,
       "with R_m only"},
      {"k_theta_over_k_phi",
       R"(\tilde{k}_\theta/\tilde{k}_\varphi)",
       "azimuthal over polar stiffness",
       "1",
       kPositive,
       {"k_theta"},
       nullptr,
       "with R_m only; otherwise 1; for rods of oval section"},
      {"k_r_N_per_m", "k_r", "radial stiffness", "N/m", kPositive, {"k_r"}, &S::stiffness},
      {"k_theta_N_m", R"(k_\theta)", "azimuthal stiffness", "N m/rad", kPositive, {"k_theta"}, &S::energy},
      {"k_phi_N_m", R"(k_\varphi)", "polar stiffness", "N m/rad", kPositive, {"k_phi"}, &S::energy},
      {"E_star_Pa", "E^*", "contact modulus", "Pa", kPositive, {"E_star"}, &S::stress},
      {"pressure_limit_Pa",
       R"(p_{\mathrm{limit}})",
       "contact pressure beyond which exceeds_pressure_limit is yes",
       "Pa",
       kPositive,
       {"pressure_limit"},
       &S::stress},
      {"tau_f_Pa", R"(\tau_f)", "NSS shear stress", "Pa", kPositive, {"tau_f"}, &S::stress},
      {"R_c_m", "R_c", "tip radius", "m", kPositive, {"R_c"}, &S::length},
      {"V_s_m_per_s", "V_s", "threshold speed", "m/s", kPositive, {"V_s"}, &S::velocity},
      {"alpha_J", R"(\alpha)", "strength of the pole repulsion", "J", kNotNegative, {"alpha"}, &S::energy},
      {"beta_J", R"(\beta)", "strength of the slab's wall", "J", kPositive, {"beta"}, &S::energy},
      {"R_n_N", "R_n/N_{c,0}", "normal load per bristle", "N", kPositive, {"R_n"}, &S::force},
      {"pressure_Pa",
       "p",
       "mean pressure of the slab on the lattice",
       "Pa",
       kPositive,
       {"R_n"},
       nullptr,
       "in place of R_n_N: a bristle carries the load of its area, the square of the spacing"},
      {"z_0_m", "z_0", "gap between slab and ground", "m", kPositive, {"z_0"}, &S::length},
      {"L_x_m", "L_x", "slab length", "m", kPositive, {"L_x"}, &S::length},
      {"L_y_m", "L_y", "slab width", "m", kPositive, {"L_y"}, &S::length},
      {"spacing_m", R"(\Delta)", "lattice spacing", "m", kPositive, {"spacing"}, &S::length},
  };
  return table;
}

void apply_si_units(PointInput& input) {
  if (input.si.empty()) return;
  const SiScales scales = si_scales(input);
  apply_material(input, scales);
  if (input.friction_law_in_si) input.setup.parameters.custom_friction.V_0 = scales.velocity;
  for (const SiQuantity& q : si_quantities())
    if (const auto given = input.si.find(q.name); q.scale && given != input.si.end())
      find_sweepable(q.replaces.front())->set(input, given->second / (scales.*q.scale));
  const double spacing = input.setup.parameters.spacing;
  if (const auto given = input.si.find("pressure_Pa"); given != input.si.end())
    input.loading.R_n = given->second / scales.stress * spacing * spacing;
}

std::vector<std::string> values_from_si(const PointInput& input) {
  std::vector<std::string> out = replaceable_values(input, true);
  if (input.si.contains("R_n_N") || input.si.contains("pressure_Pa"))
    out.push_back(fmt::format("R_n = {:.6g}", input.loading.R_n));
  if (input.si.contains("z_0_m")) out.push_back(fmt::format("z_0 = {:.6g}", *input.loading.z_0));
  return out;
}

std::vector<std::string> values_not_in_si(const PointInput& input) {
  return replaceable_values(input, false);
}

SiScales si_scales(const PointInput& input) {
  if (input.si.empty()) return {};
  const double r0 = input.si.at("r0_m");
  const auto density = input.si.find("rho_kg_per_m3");
  const double m =
      density == input.si.end() ? input.si.at("m_kg") : modal_mass(density->second, input.si.at("R_m"), r0);
  return bristle::si_scales(m, r0, input.si.at("V0_m_per_s"));
}

}  // namespace bristle::sweep
