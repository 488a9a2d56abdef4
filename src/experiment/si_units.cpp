#include "experiment/si_units.hpp"

#include "experiment/input_error.hpp"

#include <fmt/format.h>

namespace bristle {

void apply_si_units(const Document& document, PointInput& input) {
  const Json& json = document.json();
  if (!json.contains("si")) return;
  const Json& si = json["si"];
  const double m = si["m_kg"], r0 = si["r0_m"], V0 = si["V0_m_per_s"];
  const double energy = m * V0 * V0, force = energy / r0;
  const double stiffness = force / r0, stress = force / (r0 * r0);
  Parameters& p = input.interface.parameters;
  const auto set = [&](const char* key, const char* dimensionless, double scale, double& target) {
    if (!si.contains(key)) return;
    if (json.contains("sweep") && json["sweep"].contains(dimensionless)) {
      const JsonPointer at = JsonPointer("/si") / key;
      throw InputError(fmt::format("{}: {}: {} is swept as well; remove one", document.origin(at),
                                   at.to_string(), dimensionless));
    }
    target = si[key].get<double>() / scale;
  };
  set("k_r_N_per_m", "k_r", stiffness, p.k_r);
  set("k_theta_N_m", "k_theta", energy, p.k_theta);
  set("k_phi_N_m", "k_phi", energy, p.k_phi);
  set("E_star_Pa", "E_star", stress, p.E_star);
  set("tau_f_Pa", "tau_f", stress, p.tau_f);
  set("R_c_m", "R_c", r0, p.R_c);
  set("R_n_N", "R_n", force, input.loading.R_n);
}

}  // namespace bristle
