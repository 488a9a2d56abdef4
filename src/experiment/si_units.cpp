#include "experiment/si_units.hpp"

#include "experiment/overrides.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>

namespace bristle::experiment {
namespace {

// Limits of usual values: a value outside of them may be in millimetres, gigapascals or grams.
struct Usual {
  const char* key;
  double from, to;
};
constexpr Usual kUsual[] = {{"r0_m", 1e-6, 1},     {"R_m", 1e-8, 0.05},          {"R_c_m", 1e-8, 0.05},
                            {"E_Pa", 1e4, 2e12},   {"rho_kg_per_m3", 50, 25000}, {"V0_m_per_s", 1e-6, 1000},
                            {"spacing_m", 1e-7, 1}};

// Returns warnings of values that look as if they were in another unit than the unit of their key.
std::vector<std::string> unusual_values(const json::Document& document, const sweep::Sweep& sweep) {
  std::vector<std::string> out;
  for (const Usual& usual : kUsual) {
    std::vector<double> given;
    if (const auto own = sweep.base.si.find(usual.key); own != sweep.base.si.end())
      given.push_back(own->second);
    for (const sweep::Axis& axis : sweep.axes)
      if (axis.name == usual.key) given = axis.values;
      else
        for (const sweep::Axis& column : axis.columns)
          if (column.name == usual.key) given = column.values;
    const auto found = std::ranges::find_if(given, [&](double x) { return x < usual.from || x > usual.to; });
    if (found == given.end()) continue;
    const JsonPointer at = place_of(document, usual.key);
    out.push_back(fmt::format("{}: {}: {:g} is unusual, outside {:g} to {:g}; is it in the unit of the key?",
                              document.origin(at), at.to_string(), *found, usual.from, usual.to));
  }
  return out;
}

}  // namespace

void read_si_units(const json::Document& document, const std::vector<sweep::Axis>& axes,
                   sweep::PointInput& input) {
  const auto swept = [&](const std::string& name) { return sweep::varies(axes, name); };
  const Json& json = document.json();
  const bool given = json.contains("si");
  const auto has = [&](const char* key) { return (given && json["si"].contains(key)) || swept(key); };
  for (const sweep::SiQuantity& q : sweep::si_quantities()) {
    if (!has(q.name)) continue;
    if (!given)
      document.fail("/si/" + std::string(q.name),
                    "is swept, but there is no si block with r0_m, V0_m_per_s, and m_kg or rho_kg_per_m3");
    for (const char* name : q.replaces)
      if (swept(name))
        document.fail("/si/" + std::string(q.name),
                      fmt::format("{}, which it replaces, is swept as well; remove one of them", name));
    if (json["si"].contains(q.name)) input.si[q.name] = json["si"][q.name];
  }
  if (!given) return;
  if (has("m_kg") == has("rho_kg_per_m3"))
    document.fail(
        has("m_kg") ? "/si/rho_kg_per_m3" : "/si/m_kg",
        has("m_kg") ? "is given, and so is m_kg; both are the mass of a bristle: remove one of them (a null "
                      "removes an inherited key)"
                    : "is missing; give it, or rho_kg_per_m3 and R_m, from which it follows");
  if (has("rho_kg_per_m3") && !has("R_m"))
    document.fail("/si/R_m", "is missing; the mass of a bristle follows from it and rho_kg_per_m3");
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

std::vector<std::string> si_warnings(const json::Document& document, const Experiment& experiment) {
  std::vector<std::string> out;
  if (experiment.sweep.base.si.empty()) return out;
  const auto warn = [&](const std::string& pointer, const std::string& what) {
    out.push_back(fmt::format("{}: {}: {}", document.origin(JsonPointer(pointer)), pointer, what));
  };
  const auto given = [&](const char* key) {
    return experiment.sweep.base.si.contains(key) || experiment.sweep.varies(key);
  };
  std::map<std::string, std::vector<const char*>> replaced;  // by JSON pointer: the keys of the block
  for (const sweep::SiQuantity& q : sweep::si_quantities())
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
  std::ranges::move(unusual_values(document, experiment.sweep), std::back_inserter(out));
  const bool in_load = document.json()["load"].contains("R_n");
  if (!given("R_n_N") && !given("pressure_Pa") && (in_load || experiment.sweep.varies("R_n")))
    warn(in_load ? "/load/R_n" : "/sweep/R_n",
         fmt::format("is in units of m V_0^2/r_0, {:.3g} N at the first point; R_n_N of the si block is the "
                     "load in newtons",
                     sweep::si_scales(experiment.sweep.point(0)).force));
  return out;
}

}  // namespace bristle::experiment
