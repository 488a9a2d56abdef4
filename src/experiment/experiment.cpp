#include "experiment/experiment.hpp"

#include "experiment/overrides.hpp"
#include "experiment/pointer.hpp"
#include "experiment/point_checks.hpp"
#include "experiment/schema.hpp"
#include "experiment/friction_law.hpp"
#include "experiment/si_units.hpp"
#include "util/error.hpp"
#include "bristle/random.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace bristle::experiment {
namespace {

using json::Document;
using sweep::Axis, sweep::PointInput, sweep::kSample;

constexpr double kDegree = M_PI / 180;

Parameters read_model(const Document& d) {
  const Json& model = d.json()["model"];
  Parameters p;
  for (const Choice& choice : choices())
    if (model.contains(choice.name))
      choice.set(p, int(std::ranges::find(choice.words, model[choice.name].get<std::string>()) -
                        choice.words.begin()));
  for (const Parameter& one : kParameters)
    if (model.contains(one.name) && model[one.name].is_number())
      p.*one.member = model[one.name].get<double>() * one.unit;
  return p;
}

// Returns the azimuths of a list in degrees, or a number of azimuths drawn from the distribution; rad.
std::vector<double> read_azimuths(const Document& d, const Json& json, Orientation o) {
  const bool uniform = o.distribution == Distribution::uniform;
  std::vector<double> out;
  if (json.is_array()) {
    if (!uniform)
      d.fail(
          "/orientation/theta_0_deg",
          "is a list, and the distribution is von_mises; allowed: {\"random\": N, \"seed\": S}, which draws "
          "azimuths from the distribution, or a list with \"distribution\": \"uniform\"");
    for (const double degrees : json) out.push_back(degrees * kDegree);
    return out;
  }
  o.seed = json["seed"];
  for (std::uint64_t i = 0; i < json["random"]; ++i)
    out.push_back(uniform ? 2 * M_PI * double(split_mix(o.seed + i * kSplitMixStep) >> 11) * 0x1p-53
                          : random_azimuth(o, i));
  return out;
}

Orientation read_orientation(const Document& d) {
  const Json& json = d.json()["orientation"];
  Orientation o;
  o.distribution = from_word<Distribution>(json["distribution"]);
  o.sampling = from_word<Sampling>(json["sampling"]);
  o.mean = json.value("mean_deg", 0.0) * kDegree;
  o.concentration = json.value("concentration", 0.0);
  o.full_circle = json.value("full_circle", false);
  o.rtol = json.value("rtol", o.rtol);
  o.seed = json.value("seed", o.seed);
  o.rows = json.value("rows", o.rows);
  o.t_1 = json.value("t_1", -1.0);
  if (o.distribution == Distribution::von_mises && !json.contains("concentration"))
    d.fail("/orientation/concentration",
           "is missing; a von Mises distribution needs concentration and mean_deg");
  if (o.sampling == Sampling::list) {
    if (!json.contains("theta_0_deg"))
      d.fail("/orientation/theta_0_deg", "is missing; sampling by list needs the azimuths in degrees");
    o.theta_0 = read_azimuths(d, json["theta_0_deg"], o);
  } else if (json.contains("theta_0_deg")) {
    d.fail("/orientation/theta_0_deg", "is allowed with \"sampling\": \"list\" only");
  }
  return o;
}

IntegratorOptions read_integrator(const Document& d) {
  const Json& json = d.json()["integrator"];
  IntegratorOptions options;
  options.rtol = json["rtol"];
  options.atol = json["atol"];
  options.max_evaluations = json.value("max_evaluations", options.max_evaluations);
  return options;
}

Scatter read_scatter(const Document& d) {
  const json::Node block(d, "/scatter");
  Scatter scatter;
  scatter.bristles = block.get("bristles", scatter.bristles);
  for (std::size_t i = 0; i < kScattered.size(); ++i) {
    const json::Node property = block[kScattered[i].name];
    if (!property.exists()) continue;
    scatter.uniform[i] = property.has("uniform");
    scatter.width[i] = property.value().front();
  }
  return scatter;
}

Recording read_recording(const Document& d, const Orientation& orientation) {
  const Json& json = d.json();
  Recording record;
  for (const Json& what : json.value("record", Json::array())) {
    record.bristles = record.bristles || what == "bristles";
    record.slab_force = record.slab_force || what == "slab_force";
    if (what != "trajectories") continue;
    if (json.contains("trajectories"))
      for (const double degrees : json["trajectories"]["theta_0_deg"])
        record.trajectories.push_back(degrees * kDegree);
    else record.trajectories = orientation.theta_0;
    if (record.trajectories.empty())
      d.fail("/trajectories", "is missing; recording trajectories needs {\"theta_0_deg\": [...]}");
  }
  return record;
}

Loading read_loading(const Document& d, const std::vector<Axis>& axes) {
  const Json& json = d.json()["load"];
  const auto in_si = [&](const char* key) { return d.json().contains("si") && d.json()["si"].contains(key); };
  const auto given_by = [&](const char* name, const char* si_name) {
    return json.contains(name) || varies(axes, name) || in_si(si_name) || varies(axes, si_name);
  };
  const bool by_pressure = in_si("pressure_Pa") || varies(axes, "pressure_Pa");
  if (by_pressure && (in_si("R_n_N") || varies(axes, "R_n_N")))
    d.fail(
        in_si("pressure_Pa") ? "/si/pressure_Pa" : "/sweep/pressure_Pa",
        "is given, and so is R_n_N; both are the load: remove one of them (a null removes an inherited key)");
  const bool by_load = given_by("R_n", "R_n_N") || by_pressure, by_gap = given_by("z_0", "z_0_m");
  if (!by_load && !by_gap) {
    if (d.json().contains("si"))
      d.fail("/si",
             "the load is missing: none of R_n_N, pressure_Pa and z_0_m is given, here or in the sweep");
    d.fail("/load", "neither R_n nor z_0 is given, here or in the sweep");
  }
  if (by_load && by_gap) {
    std::vector<std::string> given;
    for (const char* name : {"R_n", "z_0"})
      if (json.contains(name)) given.push_back(fmt::format("/load/{}", name));
    for (const char* name : {"R_n_N", "pressure_Pa", "z_0_m"})
      if (in_si(name)) given.push_back(fmt::format("/si/{}", name));
    for (const char* name : {"R_n", "R_n_N", "pressure_Pa", "z_0", "z_0_m"})
      if (varies(axes, name)) given.push_back(fmt::format("/sweep/{}", name));
    d.fail("/load", fmt::format("R_n and z_0 are both given: {}; keep one (a null removes an inherited key)",
                                fmt::join(given, ", ")));
  }
  Loading loading;
  if (by_gap) loading.z_0 = json.value("z_0", 0.0);
  loading.R_n = json.value("R_n", 0.0);
  loading.path = from_word<LoadPath>(json.value("path", "loading"));
  return loading;
}

std::optional<double> read_nominal_friction(const Document& d, const std::vector<Axis>& axes,
                                            const PointInput& input) {
  const Json& load = d.json()["load"];
  const char* place =
      load.contains("nominal_friction") ? "/load/nominal_friction" : "/sweep/nominal_friction";
  if (!load.contains("nominal_friction") && !varies(axes, "nominal_friction")) return {};
  if (input.loading.z_0) d.fail(place, "needs a target load R_n, which it multiplies");
  for (const char* name : {"mu_c", "tau_f", "tau_f_Pa"})
    if (varies(axes, name) || input.si.contains(name) || d.chosen(JsonPointer("/model") / name))
      d.fail(
          place,
          fmt::format("is given, and so is {}; both are the strength of friction: remove one of them", name));
  return load.value("nominal_friction", 1.0);
}

// Returns the name of a swept number along which the gap of a load may jump; empty if none is given.
std::string read_jump_axis(const Document& d, const Experiment& e) {
  std::string name = d.json().value("locate_jumps", "");
  if (name.empty()) return name;
  const std::size_t number = e.sweep.axis_number(name);
  const Axis* axis = number < e.sweep.axes.size() ? &e.sweep.axes[number] : nullptr;
  if (!axis || !axis->quantity().options.empty() || !axis->columns.empty())
    d.fail("/locate_jumps",
           fmt::format(
               "\"{}\" is not a number that the sweep varies; allowed: a number in /sweep{}", name,
               d.inherits(JsonPointer("/locate_jumps"))
                   ? "; a file that this one extends asks for these jumps: \"locate_jumps\": null does not"
                   : ""));
  if (e.sweep.base.loading.z_0) d.fail("/locate_jumps", "needs a load R_n: at a given gap, no gap jumps");
  return name;
}

Experiment read(const Document& d) {
  experiment_schema().check(d);
  const Json& json = d.json();
  Experiment e;
  Json document = json;
  document.erase("tiers");
  e.document = std::make_shared<const Json>(std::move(document));
  e.source = std::make_shared<const Document>(d);
  e.path = d.path();
  e.name = json["name"];
  e.title = json.value("title", e.name);
  e.figure = json.value("figure", "");
  e.sweep.axes = read_axes(d);
  e.ranges = read_ranges(d);
  if (!e.ranges.empty() && !e.sweep.varies(kSample))
    e.sweep = e.sweep.with({kSample, {0, 1}, e.ranges.bounds()});
  const Json& model = json["model"];
  e.sweep.C_peaks_at_V_s = !model.contains("C") || model["C"].is_string();
  if (e.sweep.varies("C") && model.contains("C") && model["C"].is_string())
    d.fail("/model/C", "is swept; its value here must be a number");
  e.sweep.engine = from_word<Engine>(json["integrator"].value("engine", "fast"));
  e.sweep.base.setup = {read_model(d), read_orientation(d), read_integrator(d), read_scatter(d)};
  const OwnLaw law = read_friction_law(d, e.sweep.axes);
  e.sweep.friction_law = law.table;
  e.sweep.base.setup.parameters.custom_friction.table = e.sweep.friction_law.get();
  if (e.sweep.friction_law) e.sweep.friction_law_text = json["friction_law"].dump();
  e.sweep.base.friction_law_in_si = law.in_si;
  e.sweep.base.setup.max_evaluations_per_point =
      json["integrator"].value("max_evaluations_per_point", e.sweep.base.setup.max_evaluations_per_point);
  e.sweep.base.loading = read_loading(d, e.sweep.axes);
  read_si_units(d, e.sweep.axes, e.sweep.base);
  e.sweep.base.nominal_friction = read_nominal_friction(d, e.sweep.axes, e.sweep.base);
  apply_si_units(e.sweep.base);
  apply_nominal_friction(e.sweep.base);
  e.sweep.record = read_recording(d, e.sweep.base.setup.orientation);
  e.locate_jumps = read_jump_axis(d, e);
  check_overrides(d);
  check_points(d, e);
  e.warnings = si_warnings(d, e);
  std::ranges::move(shaft_warnings(d, e), std::back_inserter(e.warnings));
  std::ranges::move(idle_changes(d, e.sweep), std::back_inserter(e.warnings));
  for (const std::string& name : axes_without_effect(e.sweep)) {
    const bool is_axis = e.sweep.axis_number(name) < e.sweep.axes.size();
    const JsonPointer at = JsonPointer("/sweep") / (is_axis ? name : kSample);
    e.warnings.push_back(fmt::format(
        "{}: {}: {}has no effect with these choices of friction, load and orientation: points that differ in "
        "it alone are the same",
        d.origin(at), at.to_string(), is_axis ? "" : name + " "));
  }
  return e;
}

bool is_valid(const Document& document, const ReadBlocks& read_blocks) {
  try {
    const Experiment experiment = read(document);
    check_clearance(document, experiment);
    read_blocks(experiment);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

// Reads the document of a tier. Messages tell how to replace the tier if it is inherited and only its patch
// is wrong.
Experiment read_tier(const Document& document, const std::string& tier, const ReadBlocks& read_blocks) {
  try {
    Experiment experiment = read(document);
    check_clearance(document, experiment);
    read_blocks(experiment);
    return experiment;
  } catch (const InputError& e) {
    const std::string remedy = document.remedy_of_inherited_tier(tier);
    if (remedy.empty() || !is_valid(document.with_tier("none"), read_blocks)) throw;
    throw InputError(fmt::format("{}; {}", e.what(), remedy));
  }
}

}  // namespace

Experiment load_experiment(const std::string& path, const json::DocumentOptions& options,
                           const ReadBlocks& read_blocks) {
  const Document document = Document::load(path, {with_pointers(options.set), options.tier});
  Experiment experiment = read_tier(document, options.tier, read_blocks);
  experiment.tier = options.tier;
  experiment.has_study_tier = document.has_tier("study");
  // A mistake in another tier stops only those who ask for that tier.
  for (const char* tier : {"smoke", "study", "full"})
    if (tier != options.tier) try {
        read_tier(document.with_tier(tier), tier, read_blocks);
      } catch (const MissingFile&) {  // a table, which the tier that was asked for does not need
      } catch (const InputError& e) {
        experiment.warnings.push_back(fmt::format("the tier {} cannot be computed: {}", tier, e.what()));
      }
  return experiment;
}

Experiment made_experiment(const Json& document) { return read(Document::made(document)); }

Experiment stored_experiment(const Json& document, const std::string& tier, const std::string& source,
                             const std::vector<std::string>& set) {
  Experiment experiment = read(Document::stored(document, source, with_pointers(set)));
  experiment.tier = tier;
  return experiment;
}

}  // namespace bristle::experiment
