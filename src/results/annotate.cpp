#include "results/annotate.hpp"

#include "ensemble/lattice.hpp"
#include "experiment/si_units.hpp"
#include "model/friction/laws.hpp"
#include "results/digest.hpp"
#include "results/hdf5.hpp"
#include "results/version.hpp"
#include "util/sha.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <algorithm>

namespace bristle::results {
namespace {

constexpr const char* kPaper =
    "N. Menga, F. Bottiglione, G. Carbone: Exploiting surface textures dynamics for dry friction control, "
    "Nonlinear Dynamics (2022)";

// A value with symbol and unit as mathtext, with powers of ten: "$m = 10^{-4}$ kg".
std::string quantity(const experiment::SiQuantity& q, double value) {
  std::string number = fmt::format("{:.4g}", value);
  if (const auto e = number.find('e'); e != std::string::npos) {
    const std::string mantissa = number.substr(0, e);
    number = fmt::format("{}10^{{{}}}", mantissa == "1" ? "" : mantissa + R"( \times )",
                         std::stoi(number.substr(e + 1)));
  }
  const bool dimensionless = std::string(q.units) == "1";
  return fmt::format("${} = {}${}{}", q.symbol, number, dimensionless ? "" : " ",
                     dimensionless ? "" : q.units);
}

std::vector<std::string> si_parts(const Experiment& e) {
  std::vector<std::string> parts;
  for (const experiment::SiQuantity& q : experiment::si_quantities())
    if (!e.sweep.varies(q.name) && e.sweep.base.si.contains(q.name))
      parts.push_back(quantity(q, e.sweep.base.si.at(q.name)));
  return parts;
}

// Adds k_theta, which a round rod does not have beside k_phi.
void add_k_theta(const Experiment& e, std::vector<std::string>& parts) {
  const Parameters& p = e.sweep.base.setup.parameters;
  const bool of_rods = p.section == Section::oval || e.sweep.varies("section");
  if (e.sweep.varies("k_theta") || (p.bending == Bending::rod && !e.sweep.varies("bending") && !of_rods))
    return;
  const std::string symbol = experiment::find_sweepable("k_theta")->symbol;
  parts.push_back(fmt::format("${} = {:.6g}$", symbol, p.k_theta));
  if (e.sweep.varies("bending") && !of_rods)
    parts.back() += fmt::format(" (rods: ${}$)", experiment::find_sweepable("k_phi")->symbol);
}

std::vector<std::string> dimensionless_parts(const Experiment& e) {
  const Parameters& p = e.sweep.base.setup.parameters;
  std::vector<std::string> parts;
  const auto add = [&](const char* name, double value) {
    if (!e.sweep.varies(name))
      parts.push_back(fmt::format("${} = {:.6g}$", experiment::find_sweepable(name)->symbol, value));
  };
  add("k_r", p.k_r);
  add_k_theta(e, parts);
  add("k_phi", p.k_phi);
  if (const auto nominal = e.sweep.base.nominal_friction) add("nominal_friction", *nominal);
  else if (p.friction != FrictionLaw::nss) add("mu_c", p.mu_c);
  const Loading& load = e.sweep.base.loading;
  if (load.z_0) add("z_0", *load.z_0);
  else if (!load.trace) add("R_n", load.R_n);
  return parts;
}

// The values that are fixed in the sweep, as mathtext for the caption of the figure.
std::string caption(const Experiment& e) {
  std::vector<std::string> parts;
  if (!e.sweep.varies("friction"))
    parts.emplace_back(with_law(e.sweep.base.setup.parameters.friction, [](auto law) { return law.title; }));
  for (std::string& part : e.sweep.base.si.empty() ? dimensionless_parts(e) : si_parts(e))
    parts.push_back(std::move(part));
  if (e.tier != "full") parts.push_back(e.tier + " tier: a subset of the points");
  return fmt::format("{}", fmt::join(parts, ", "));
}

// Constants for plots of the lattice's forces, if all points have the same: t_1 of Eq. (A4), in units of
// r0/V0, and N_c0/L_y, in units of 1/r0.
void annotate_slab_force(hid_t file, const Experiment& e) {
  if (!h5::exists(file, "slab_force") || e.sweep.varies("L_x") || e.sweep.varies("spacing")) return;
  const Setup& setup = e.sweep.base.setup;
  h5::write_attribute(h5::open_dataset(file, "slab_force/t"), "t_1", lattice_start(setup));
  h5::write_attribute(h5::open_dataset(file, "slab_force/R_n"), "N_c0_per_L_y",
                      bristles_per_width(setup.parameters));
}

// The attributes of the CF conventions that tell where the numbers come from. They differ between equal runs.
void annotate_origin(hid_t file, const Experiment& e) {
  h5::write_attribute(file, "Conventions", "CF-1.10");
  h5::write_attribute(file, "references", kPaper);
  if (const auto institution = e.document->find("institution"); institution != e.document->end())
    h5::write_attribute(file, "institution", institution->get<std::string>());
  if (!h5::exists(file, "provenance")) return;
  const h5::Handle provenance = h5::open_group(file, "provenance");
  const auto entry = [&](const char* name) {
    return h5::has_attribute(provenance, name) ? h5::read_text_attribute(provenance, name) : "unknown";
  };
  h5::write_attribute(file, "source",
                      fmt::format("numerical model, bristle {} ({})", entry("version"), entry("commit")));
  // Other programs add lines to the history, which remain.
  if (!h5::has_attribute(file, "history"))
    h5::write_attribute(file, "history", fmt::format("{}: {}", entry("finished"), entry("command_line")));
}

}  // namespace

void annotate(const std::string& path, const Experiment& experiment) {
  h5::Handle file = h5::open_file(path, true);
  const std::string document = experiment.document->dump(1);
  h5::write_attribute(file, "schema_version", kResultSchema);
  h5::write_attribute(file, "numerics_version", kNumericsVersion);
  h5::write_attribute(file, "name", experiment.name);
  h5::write_attribute(file, "title", experiment.title);
  h5::write_attribute(file, "figure", experiment.figure);
  h5::write_attribute(file, "caption", caption(experiment));
  h5::write_attribute(file, "tier", experiment.tier);
  h5::write_attribute(file, "experiment", document);
  h5::write_attribute(file, "experiment_sha256", sha256_of(document));
  h5::write_attribute(file, "inputs_sha256", inputs_sha256(*experiment.document));
  annotate_slab_force(file, experiment);
  annotate_origin(file, experiment);
  file.close("closing " + path);
}

}  // namespace bristle::results
