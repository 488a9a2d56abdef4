#include "experiment/point_checks.hpp"

#include "bristle/ensemble/lattice.hpp"
#include "bristle/ensemble/load.hpp"
#include "experiment/overrides.hpp"
#include "bristle/model/elementary.hpp"
#include "sweep/si.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

namespace bristle::experiment {
namespace {

// What the geometry of a brush follows from.
const std::vector<std::string> kGeometry = {"R", "R_m", "r0_m", "spacing", "spacing_m"};

// Returns the sweep that the checks look at: a design has an axis for each of its quantities, with their
// extremes, in place of the sample of its trials.
Sweep sweep_of(const Experiment& experiment) {
  if (experiment.ranges.empty() || experiment.document->contains(JsonPointer("/sweep/sample")))
    return experiment.sweep;
  Sweep out = experiment.sweep.without(sweep::kSample);
  std::ranges::move(experiment.ranges.extremes(), std::back_inserter(out.axes));
  return out;
}

void check_gap(const json::Document& d, const Experiment& experiment) {
  const Sweep sweep =
      sweep_of(experiment).first_values({"z_0", "z_0_m", "r0_m", "phi_0_deg", "lambda_z", "contact"});
  for (std::size_t i = 0; i < sweep.size(); ++i) {
    const sweep::PointInput point = sweep.point(i);
    const Parameters& p = point.setup.parameters;
    const double highest = sin(p.phi_0) + kWallRangesAboveContact * contact_range(p);
    const auto where = [&] { return sweep.size() > 1 ? fmt::format(" at {}", sweep.place(i)) : ""; };
    if (!point.loading.z_0) return;
    if (*point.loading.z_0 <= highest) continue;
    const bool wall = p.contact == Contact::wall;
    const std::string reach = wall ? fmt::format(" + {:g} lambda_z", kWallRangesAboveContact) : "";
    const char* beyond = wall ? ", beyond the wall" : "";
    if (const auto in_m = point.si.find("z_0_m"); in_m != point.si.end())
      d.fail(place_of(d, "z_0_m").to_string(),
             fmt::format("{} m is above first contact{}{}; allowed: at most r_0 {}sin(phi_0){}{} = {:.6g} m",
                         in_m->second, where(), beyond, wall ? "(" : "", reach, wall ? ")" : "",
                         highest * point.si.at("r0_m")));
    d.fail(place_of(d, "z_0").to_string(),
           fmt::format("{} is above first contact{}{}; allowed: at most sin(phi_0){} = {:.6f}",
                       *point.loading.z_0, where(), beyond, reach, highest));
  }
}

// Quantities that only bristles of some kind have, such as the range of the wall.
struct Meaning {
  std::vector<const char*> quantities;
  bool (*have)(const Parameters&);
  const char* why;  // says why other bristles do not have them, and the remedy
};
const std::array kMeanings = {
    Meaning{{"lambda_z", "beta", "beta_J"},
            [](const Parameters& p) { return p.contact == Contact::wall; },
            "has no meaning for the contact \"hertz\", which E_star and R_c determine; remove it, or set "
            "/model/contact to \"wall\""},
    Meaning{
        {"k_theta", "k_theta_over_k_phi", "k_theta_N_m"},
        [](const Parameters& p) { return p.bending != Bending::rod || p.section == Section::oval; },
        "has no effect on round rods, whose k_theta is k_phi; remove it, or set /model/section to \"oval\""}};

// Throws InputError if the experiment varies a quantity that the bristles of some point do not have, or gives
// one that the bristles of no point have.
void check_meaning(const json::Document& d, const Experiment& experiment) {
  const Sweep sweep = sweep_of(experiment).first_values({"bending", "contact", "section"});
  const Json si = d.json().value("si", Json::object());
  for (const Meaning& m : kMeanings) {
    std::size_t have = 0;
    for (std::size_t i = 0; i < sweep.size(); ++i) have += m.have(sweep.point(i).setup.parameters);
    for (const std::string name : m.quantities) {
      const bool of_a_round_rod = name == "k_theta_over_k_phi" && si.value(name, 0.0) == 1;
      const bool given = (si.contains(name) && !of_a_round_rod) || d.chosen(JsonPointer("/model") / name);
      const JsonPointer at = place_of(d, name);
      if ((have == 0 && given) || (have < sweep.size() && sweep.varies(name)))
        d.fail(at.to_string(), (at.back() == name ? "" : name + " ") + m.why);
    }
  }
}

// Throws InputError if chi is to peak at V_s and has no maximum there: it has one for A > 1 only; near 1 it
// would be a step at u = 0, which no integrator resolves.
void check_chi(const json::Document& d, const Experiment& experiment) {
  constexpr double least = 1.001;
  const Sweep sweep = sweep_of(experiment).first_values({"A"});
  if (!sweep.C_peaks_at_V_s) return;
  for (std::size_t i = 0; i < sweep.size(); ++i)
    if (const double A = sweep.point(i).setup.parameters.A; A < least)
      d.fail(place_of(d, "A").to_string(),
             fmt::format("{} has no maximum of chi at V_s; allowed: at least {}, or a number for C (0: chi "
                         "rises to 1)",
                         A, least));
}

// Checks at every point that the slab is a whole number of lattice spacings wide and that rows still enter
// after t_1.
void check_lattice(const json::Document& d, const Experiment& experiment) {
  constexpr double most = 1e7;  // bristles, which memory holds
  const Sweep sweep =
      sweep_of(experiment)
          .first_values({"L_x", "L_y", "spacing", "L_x_m", "L_y_m", "spacing_m", "r0_m", "rows", "sampling"});
  const bool used = sweep.on_lattice();
  if (sweep.record.slab_force && !used) d.fail("/record", "slab_force needs \"sampling\": \"lattice\"");
  for (const char* key : {"seed", "rows", "t_1"})
    if (!used && (d.json()["orientation"].contains(key) || sweep.varies(key)))
      d.fail(std::string("/orientation/") + key, "is allowed with \"sampling\": \"lattice\" only");
  if (used)
    for (const char* quantity : {"L_y", "L_y_m", "spacing", "spacing_m", "r0_m"})
      for (const std::string& varied : experiment.ranges.quantities())
        if (varied == quantity)
          d.fail(place_of(d, varied).to_string(),
                 "cannot vary with \"sampling\": \"lattice\", as L_y is a whole number of spacings; use "
                 "quadrature");
  for (std::size_t i = 0; used && i < sweep.size(); ++i) {
    const Setup point = sweep.point(i).setup;
    const Parameters& p = point.parameters;
    const double across = p.L_y / p.spacing;
    if (std::abs(across - std::round(across)) > 1e-6 || across < 0.5)
      d.fail("/model/L_y", fmt::format("{} is {:.6g} times the spacing {}; a lattice needs a whole number",
                                       p.L_y, across, p.spacing));
    if (const double bristles = across * double(point.orientation.rows); bristles > most)
      d.fail("/orientation/rows",
             fmt::format("{} rows of {:.0f} bristles are {:.3g} bristles; allowed: at most {:.0e}",
                         point.orientation.rows, across, bristles, most));
    if (point.orientation.rows == 0)
      d.fail("/orientation/rows", "is missing; a lattice needs the number of rows that enter");
    if (lattice_end(point) <= lattice_start(point))
      d.fail(
          "/orientation/rows",
          fmt::format(
              "the {} rows have entered by t_2 = {}, but averaging begins at t_1 = {} [2 L_x]; use more rows",
              point.orientation.rows, lattice_end(point), lattice_start(point)));
  }
}

// Checks at every point that no bristle of the brush deviates to an impossible value.
void check_scatter(const json::Document& d, const Experiment& experiment) {
  std::vector<std::string> names;
  for (const ScatteredProperty& one : kScattered)
    names.push_back(sweep::kScatterPrefix + std::string(one.name));
  std::vector<std::string> with_angle = names;
  with_angle.push_back("phi_0_deg");
  const Sweep sweep = sweep_of(experiment).first_values(with_angle);
  for (std::size_t at = 0; at < sweep.size(); ++at) {
    const auto [parameters, orientation, integrator, scatter, evaluations] = sweep.point(at).setup;
    if (scatter.any() && sweep.record.bristles)
      d.fail("/record", "bristles of a brush with scatter are in units of their own; remove \"bristles\"");
    for (std::size_t i = 0; i < kScattered.size(); ++i) {
      const bool is_angle = std::string_view(kScattered[i].name) == "phi_0_deg";
      const double most = is_angle ? M_PI / 2 / parameters.phi_0 - 1 : 1;
      if (reach(scatter, i) < most) continue;
      d.fail(place_of(d, names[i]).to_string(),
             fmt::format("{} is too wide: the {} could reach {}; allowed: less than {:.4g}", scatter.width[i],
                         kScattered[i].description, is_angle ? "90 degrees" : "zero",
                         most * scatter.width[i] / reach(scatter, i)));
    }
  }
}

}  // namespace

void check_points(const json::Document& d, const Experiment& e) {
  check_lattice(d, e);
  check_meaning(d, e);
  check_gap(d, e);
  check_chi(d, e);
  check_scatter(d, e);
}

void check_clearance(const json::Document& d, const Experiment& experiment) {
  const Sweep& all = experiment.sweep;
  const bool has_radius = all.base.si.contains("R_m") || all.varies("R_m") || all.varies("R") ||
                          d.chosen(JsonPointer("/model/R"));
  if (!experiment.ranges.empty() || !has_radius) return;
  const Sweep sweep = all.first_values(kGeometry);
  for (std::size_t i = 0; i < sweep.size(); ++i) {
    const sweep::PointInput point = sweep.point(i);
    const Parameters& p = point.setup.parameters;
    constexpr double rounding = 1e-9;  // shafts may touch
    if (clearance(p) >= -rounding) continue;
    const SiScales si = sweep::si_scales(point);
    const bool in_mm = std::isfinite(si.length);
    const auto length = [&](double value) {
      return in_mm ? fmt::format("{:.4g} mm", 1e3 * si.length * value) : fmt::format("{:.4g} r_0", value);
    };
    d.fail(
        place_of(d, "spacing").to_string(),
        fmt::format("shafts overlap{}: their spacing, {}, is less than their diameter 2 R, {}; give a larger "
                    "spacing or thinner shafts",
                    sweep.size() > 1 ? " at " + sweep.place(i) : "", length(p.spacing), length(2 * p.R)));
  }
}

std::vector<std::string> shaft_warnings(const json::Document& d, const Experiment& experiment) {
  // Shear, which the stiffnesses leave out, makes a shaft of the radius 0.1 r_0 2 % softer (S. P.
  // Timoshenko).
  const Sweep sweep = sweep_of(experiment).first_values(kGeometry);
  std::vector<std::string> out;
  // Warns once, of the first point for which is_true() holds, and names the place that sets the quantity.
  const auto warn_if = [&](const std::string& quantity, const auto& is_true, const auto& text) {
    const JsonPointer at = place_of(d, quantity);
    for (std::size_t i = 0; i < sweep.size(); ++i)
      if (const Parameters p = sweep.point(i).setup.parameters; is_true(p)) {
        out.push_back(fmt::format("{}: {}: {}", d.origin(at), at.to_string(), text(p)));
        return;
      }
  };
  warn_if(
      "R", [](const Parameters& p) { return p.R > 0.1; },
      [](const Parameters& p) {
        return fmt::format(
            "{:.4g} r_0 is thick; the formulas of a slender rod (stiffnesses, strain at the root) "
            "are accurate up to 0.1 r_0",
            p.R);
      });
  return out;
}

}  // namespace bristle::experiment
