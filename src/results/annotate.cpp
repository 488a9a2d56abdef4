#include "results/annotate.hpp"

#include "bristle/ensemble/lattice.hpp"
#include "sweep/si.hpp"
#include "bristle/model/friction/laws.hpp"
#include "results/digest.hpp"
#include "results/version.hpp"
#include "results/writer.hpp"
#include "util/sha.hpp"
#include "util/units.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <algorithm>

namespace bristle::results {
namespace {

constexpr const char* kPaper =
    "N. Menga, F. Bottiglione, G. Carbone: Exploiting surface textures dynamics for dry friction control, "
    "Nonlinear Dynamics (2022)";

// Returns a value with symbol and unit as mathtext, with powers of ten: "$m = 10^{-4}$ kg".
std::string quantity(const sweep::SiQuantity& q, double value) {
  const ReadableUnit readable = readable_unit(q.units, value);
  std::string units = readable.name;
  if (const auto power = units.find('^'); power != units.npos)
    units = fmt::format("{}$^{}$", units.substr(0, power), units.substr(power + 1));
  std::string number = fmt::format("{:.4g}", value / readable.size);
  if (const auto e = number.find('e'); e != std::string::npos) {
    const std::string mantissa = number.substr(0, e);
    number = fmt::format("{}10^{{{}}}", mantissa == "1" ? "" : mantissa + R"( \times )",
                         std::stoi(number.substr(e + 1)));
  }
  const bool dimensionless = std::string(q.units) == "1";
  return fmt::format("${} = {}${}{}", q.symbol, number, dimensionless ? "" : " ", dimensionless ? "" : units);
}

std::vector<std::string> si_parts(const Experiment& e) {
  std::vector<std::string> parts;
  for (const sweep::SiQuantity& q : sweep::si_quantities())
    if (!e.sweep.varies(q.name) && e.sweep.base.si.contains(q.name))
      parts.push_back(quantity(q, e.sweep.base.si.at(q.name)));
  return parts;
}

// Adds k_theta, except for round rods, whose k_phi replaces it.
void add_k_theta(const Experiment& e, std::vector<std::string>& parts) {
  const Parameters& p = e.sweep.base.setup.parameters;
  const bool of_rods = p.section == Section::oval || e.sweep.varies("section");
  if (e.sweep.varies("k_theta") || (p.bending == Bending::rod && !e.sweep.varies("bending") && !of_rods))
    return;
  const std::string symbol = sweep::find_sweepable("k_theta")->symbol;
  parts.push_back(fmt::format("${} = {:.6g}$", symbol, p.k_theta));
  if (e.sweep.varies("bending") && !of_rods)
    parts.back() += fmt::format(" (rods: ${}$)", sweep::find_sweepable("k_phi")->symbol);
}

std::vector<std::string> dimensionless_parts(const Experiment& e) {
  const Parameters& p = e.sweep.base.setup.parameters;
  std::vector<std::string> parts;
  const auto add = [&](const char* name, double value) {
    if (!e.sweep.varies(name))
      parts.push_back(fmt::format("${} = {:.6g}$", sweep::find_sweepable(name)->symbol, value));
  };
  add("k_r", p.k_r);
  add_k_theta(e, parts);
  add("k_phi", p.k_phi);
  if (const auto nominal = e.sweep.base.nominal_friction) add("nominal_friction", *nominal);
  else if (p.friction != FrictionLaw::nss) add("mu_c", p.mu_c);
  const Loading& load = e.sweep.base.loading;
  if (load.z_0) add("z_0", *load.z_0);
  else add("R_n", load.R_n);
  return parts;
}

// Returns the values that are fixed in the sweep, as mathtext for the caption of the figure.
std::string caption(const Experiment& e) {
  std::vector<std::string> parts;
  if (!e.sweep.varies("friction"))
    parts.emplace_back(with_law(e.sweep.base.setup.parameters.friction, [](auto law) { return law.title; }));
  if (!e.sweep.varies("bending") && e.sweep.base.setup.parameters.bending == Bending::rod)
    parts.emplace_back("rods");
  if (!e.sweep.varies("contact") && e.sweep.base.setup.parameters.contact == Contact::hertz)
    parts.emplace_back("Hertz contact");
  for (std::string& part : e.sweep.base.si.empty() ? dimensionless_parts(e) : si_parts(e))
    parts.push_back(std::move(part));
  if (e.tier != "full") parts.push_back(e.tier + " tier: a subset of the points");
  return fmt::format("{}", fmt::join(parts, ", "));
}

// Adds constants for plots of the lattice's forces, if they are the same at all points: t_1 of Eq. (A4), in
// units of r0/V0, and N_c0/L_y, in units of 1/r0.
void add_slab_force(std::vector<Attribute>& out, const Experiment& e) {
  if (!e.sweep.record.slab_force || e.sweep.varies("L_x") || e.sweep.varies("spacing")) return;
  const Setup& setup = e.sweep.base.setup;
  out.push_back({"slab_force/t", "t_1", lattice_start(setup)});
  out.push_back({"slab_force/R_n", "N_c0_per_L_y", bristles_per_width(setup.parameters)});
}

// Adds the attributes of the CF conventions that tell where the numbers come from, which differ between equal
// runs.
void add_origin(std::vector<Attribute>& out, const Experiment& e,
                const std::map<std::string, std::string>& provenance) {
  out.push_back({"/", "Conventions", "CF-1.10"});
  out.push_back({"/", "references", kPaper});
  if (const auto institution = e.document->find("institution"); institution != e.document->end())
    out.push_back({"/", "institution", institution->get<std::string>()});
  if (provenance.empty()) return;
  const auto entry = [&](const char* name) {
    const auto found = provenance.find(name);
    return found == provenance.end() ? "unknown" : found->second;
  };
  out.push_back(
      {"/", "source", fmt::format("numerical model, bristle {} ({})", entry("version"), entry("commit"))});
  // Lines that other programs add to the history remain.
  out.push_back({"/", "history", fmt::format("{}: {}", entry("finished"), entry("command_line")), true});
}

}  // namespace

void annotate(const std::string& path, const Experiment& experiment,
              const std::map<std::string, std::string>& provenance) {
  const std::string document = experiment.document->dump(1);
  std::vector<Attribute> attributes = {{"/", "schema_version", kResultSchema},
                                       {"/", "numerics_version", kNumericsVersion},
                                       {"/", "name", experiment.name},
                                       {"/", "title", experiment.title},
                                       {"/", "figure", experiment.figure},
                                       {"/", "caption", caption(experiment)},
                                       {"/", "tier", experiment.tier},
                                       {"/", "experiment", document},
                                       {"/", "experiment_sha256", sha256_of(document)},
                                       {"/", "inputs_sha256", inputs_sha256(*experiment.document)}};
  add_slab_force(attributes, experiment);
  add_origin(attributes, experiment, provenance);
  write_attributes(path, attributes);
}

}  // namespace bristle::results
