#include "results/sha.hpp"
#include "results/writer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace bristle {
namespace {

// What stays fixed in a sweep, for the figure's caption: mathtext.
std::string caption(const Experiment& e) {
  const Parameters& p = e.base.interface.parameters;
  std::vector<std::string> parts;
  const auto fixed = [&](const char* name) {
    for (const Axis& axis : e.axes)
      if (axis.name == name) return false;
    return true;
  };
  const auto add = [&](const char* name, const char* symbol, double value) {
    if (fixed(name)) parts.push_back(fmt::format("${} = {:.6g}$", symbol, value));
  };
  const bool nss = p.friction == FrictionLaw::nss;
  if (fixed("friction")) parts.push_back(nss ? "nominal shear stress (NSS)" : "Amontons-Coulomb");
  add("k_r", R"(\tilde{k}_r)", p.k_r);
  add("k_theta", R"(\tilde{k}_\theta)", p.k_theta);
  add("k_phi", R"(\tilde{k}_\varphi)", p.k_phi);
  if (!nss) add("mu_c", R"(\mu_c)", p.mu_c);
  const Loading& load = e.base.loading;
  if (load.z_0) add("z_0", R"(\tilde{z}_0)", *load.z_0);
  else if (!load.trace) add("R_n", R"(\tilde{R}_n/N_{c,0})", load.R_n);
  if (e.tier != "full") parts.push_back(e.tier + " tier: a subset of the points");
  return fmt::format("{}", fmt::join(parts, ", "));
}

}  // namespace

void annotate(const std::string& path, const Experiment& experiment, const std::optional<Shard>& shard) {
  h5::Handle file = h5::open_file(path, true);
  const std::string document = experiment.document.dump(1);
  h5::write_attribute(file, "schema_version", shard ? kPartSchema : kResultSchema);
  if (shard) h5::write_attribute(file, "shard", shard_text(*shard));
  h5::write_attribute(file, "numerics_version", kNumericsVersion);
  h5::write_attribute(file, "name", experiment.name);
  h5::write_attribute(file, "title", experiment.title);
  h5::write_attribute(file, "figure", experiment.figure);
  h5::write_attribute(file, "caption", caption(experiment));
  h5::write_attribute(file, "tier", experiment.tier);
  h5::write_attribute(file, "experiment", document);
  h5::write_attribute(file, "experiment_sha256", sha256_of(document));
  h5::write_attribute(file, "inputs_sha256", inputs_sha256(experiment.document));
  file.close("closing " + path);
}

}  // namespace bristle
