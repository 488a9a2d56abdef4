#include "experiment/si_units.hpp"

#include "bristle/model/material.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <string_view>

namespace bristle::experiment {
namespace {

// Stiffnesses of the shaft and the contact modulus, from the elastic constants of the material.
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

}  // namespace

const std::vector<SiQuantity>& si_quantities() {
  using S = SiScales;
  static const std::vector<SiQuantity> table = {
      {"m_kg", "m", "tip mass", "kg", kPositive, {}},
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
      {"tau_f_Pa", R"(\tau_f)", "NSS shear stress", "Pa", kPositive, {"tau_f"}, &S::stress},
      {"R_c_m", "R_c", "tip radius", "m", kPositive, {"R_c"}, &S::length},
      {"V_s_m_per_s", "V_s", "threshold speed", "m/s", kPositive, {"V_s"}, &S::velocity},
      {"alpha_J", R"(\alpha)", "strength of the pole repulsion", "J", kNotNegative, {"alpha"}, &S::energy},
      {"beta_J", R"(\beta)", "strength of the slab's wall", "J", kPositive, {"beta"}, &S::energy},
      {"R_n_N", "R_n/N_{c,0}", "normal load per bristle", "N", kPositive, {"R_n"}, &S::force},
      {"z_0_m", "z_0", "gap between slab and ground", "m", kPositive, {"z_0"}, &S::length},
      {"L_x_m", "L_x", "slab length", "m", kPositive, {"L_x"}, &S::length},
      {"L_y_m", "L_y", "slab width", "m", kPositive, {"L_y"}, &S::length},
      {"spacing_m", R"(\Delta)", "lattice spacing", "m", kPositive, {"spacing"}, &S::length},
  };
  return table;
}

void read_si_units(const Document& document, const std::vector<Axis>& axes, PointInput& input) {
  const auto swept = [&](const std::string& name) { return varies(axes, name); };
  const Json& json = document.json();
  const bool given = json.contains("si");
  const auto has = [&](const char* key) { return (given && json["si"].contains(key)) || swept(key); };
  for (const SiQuantity& q : si_quantities()) {
    if (!has(q.name)) continue;
    if (!given)
      document.fail("/si/" + std::string(q.name),
                    "is swept, but there is no si block with m_kg, r0_m and V0_m_per_s");
    for (const char* name : q.replaces)
      if (swept(name))
        document.fail("/si/" + std::string(q.name),
                      fmt::format("{}, which it replaces, is swept as well; remove one of them", name));
    if (json["si"].contains(q.name)) input.si[q.name] = json["si"][q.name];
  }
  if ((has("nu") || has("R_m")) != has("E_Pa"))
    document.fail(has("E_Pa") ? "/si/nu" : "/si/E_Pa",
                  has("E_Pa") ? "is missing, and so is R_m; E_Pa needs at least one of them"
                              : "is missing; nu and R_m need it");
  if (has("R_m") && has("k_r_over_k_phi") == has("k_r_N_per_m"))
    document.fail(
        "/si/k_r_over_k_phi",
        fmt::format("R_m needs either k_r_over_k_phi or k_r_N_per_m for the radial stiffness; {} given",
                    has("k_r_over_k_phi") ? "both are" : "neither is"));
  if (has("E_Pa") && has("nu") == has("E_star_Pa"))
    document.fail("/si/nu", fmt::format("E_Pa needs either nu or E_star_Pa for the contact modulus; {} given",
                                        has("nu") ? "both are" : "neither is"));
  for (const char* ratio : {"k_r_over_k_phi", "k_theta_over_k_phi"})
    if (has(ratio) && !has("R_m")) document.fail(fmt::format("/si/{}", ratio), "is allowed with R_m only");
  if (has("k_theta_over_k_phi") && has("k_theta_N_m"))
    document.fail("/si/k_theta_over_k_phi", "and k_theta_N_m give the same stiffness; remove one of them");
}

void apply_si_units(PointInput& input) {
  if (input.si.empty()) return;
  const SiScales scales = si_scales(input);
  apply_material(input, scales);
  if (input.friction_law_in_si) input.setup.parameters.custom_friction.V_0 = scales.velocity;
  for (const SiQuantity& q : si_quantities())
    if (const auto given = input.si.find(q.name); q.scale && given != input.si.end())
      find_sweepable(q.replaces.front())->set(input, given->second / (scales.*q.scale));
}

std::vector<std::string> si_warnings(const Document& document, const Experiment& experiment) {
  std::vector<std::string> out;
  if (experiment.sweep.base.si.empty()) return out;
  const auto warn = [&](const std::string& pointer, const std::string& what) {
    out.push_back(fmt::format("{}: {}: {}", document.origin(JsonPointer(pointer)), pointer, what));
  };
  const auto given = [&](const char* key) {
    return experiment.sweep.base.si.contains(key) || experiment.sweep.varies(key);
  };
  std::map<std::string, std::vector<const char*>> replaced;  // by JSON pointer: the keys of the block
  for (const SiQuantity& q : si_quantities())
    for (const std::string name : q.replaces)
      if (given(q.name))
        replaced[(name == "R_n" || name == "z_0" ? "/load/" : "/model/") + name].push_back(q.name);
  for (const auto& [pointer, keys] : replaced)
    if (document.chosen(JsonPointer(pointer))) {
      const auto what =
          fmt::format("has no effect, because the si block replaces it by {}", fmt::join(keys, " and "));
      if (document.set_by_option(JsonPointer(pointer))) document.fail(pointer, what + "; set that instead");
      warn(pointer, what);
    }
  const bool in_load = document.json()["load"].contains("R_n");
  if (!given("R_n_N") && (in_load || experiment.sweep.varies("R_n")))
    warn(in_load ? "/load/R_n" : "/sweep/R_n",
         fmt::format("is in units of m V_0^2/r_0, {:.3g} N at the first point; R_n_N of the si block is the "
                     "load in newtons",
                     si_scales(experiment.sweep.point(0)).force));
  return out;
}

namespace {

// The values that the block can replace, as "name = value": those that it does (given), or those that it does
// not.
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
                                                          : true;
    if (convertible && replaced == given && acts)
      out.push_back(fmt::format("{} = {:.6g}", entry.name, input.setup.parameters.*entry.member));
  }
  return out;
}

}  // namespace

std::vector<std::string> values_from_si(const PointInput& input) {
  std::vector<std::string> out = replaceable_values(input, true);
  if (input.si.contains("R_n_N")) out.push_back(fmt::format("R_n = {:.6g}", input.loading.R_n));
  if (input.si.contains("z_0_m")) out.push_back(fmt::format("z_0 = {:.6g}", *input.loading.z_0));
  return out;
}

std::vector<std::string> values_not_in_si(const PointInput& input) {
  return replaceable_values(input, false);
}

SiScales si_scales(const PointInput& input) {
  if (input.si.empty()) return {};
  return bristle::si_scales(input.si.at("m_kg"), input.si.at("r0_m"), input.si.at("V0_m_per_s"));
}

}  // namespace bristle::experiment
