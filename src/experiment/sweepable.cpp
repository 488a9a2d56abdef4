#include "experiment/sweepable.hpp"

#include "experiment/parameters_table.hpp"
#include "experiment/si_units.hpp"
#include "experiment/words.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace bristle::experiment {
namespace {

Sweepable of_model(const ParameterEntry& entry) {
  const std::string units = std::string(entry.name) == "phi_0_deg" ? "degree" : "1";
  const auto set = [entry](PointInput& p, double value) {
    p.setup.parameters.*entry.member = value * entry.unit;
  };
  return {entry.name, entry.symbol, entry.description, units, set, {}};
}

std::vector<Sweepable> all() {
  using P = PointInput;
  std::vector<Sweepable> out;
  for (const ParameterEntry& entry : parameters_table()) out.push_back(of_model(entry));
  const auto number = [&](const char* name, const char* symbol, const char* description, auto set,
                          const char* units = "1") {
    out.push_back({name, symbol, description, units, set, {}});
  };
  number("R_n", R"(\tilde{R}_n/N_{c,0})", "target normal load per bristle",
         [](P& p, double v) { p.loading.R_n = v; });
  number("z_0", R"(\tilde{z}_0)", "gap between slab and ground", [](P& p, double v) { p.loading.z_0 = v; });
  number(
      "mean_deg", R"(\langle\theta_0\rangle)", "von Mises: mean azimuth",
      [](P& p, double v) { p.setup.orientation.mean = v * M_PI / 180; }, "degree");
  number("concentration", R"(\kappa)", "von Mises: concentration",
         [](P& p, double v) { p.setup.orientation.concentration = v; });
  number("seed", "seed", "seed of the lattice's azimuths",
         [](P& p, double v) { p.setup.orientation.seed = std::uint64_t(v); });
  number("rows", "n_\\mathrm{rows}", "rows of the lattice that enter the slab",
         [](P& p, double v) { p.setup.orientation.rows = long(v); });

  for (const SiQuantity& q : si_quantities())
    number(
        q.name, q.symbol, q.description, [key = std::string(q.name)](P& p, double v) { p.si[key] = v; },
        q.units);

  const auto choice = [&](const char* name, const char* description, std::vector<std::string> options,
                          auto set) {
    out.push_back({name, name, description, "1", set, options});
  };
  for (const Choice& c : choices_table())
    choice(c.name, c.description, c.options, [c](P& p, double v) { c.set(p.setup.parameters, int(v)); });
  choice("path", "path on which the load is reached", words<LoadPath>(),
         [](P& p, double v) { p.loading.path = LoadPath(int(v)); });
  choice("sampling", "sampling of theta_0 for the ensemble mean", {"quadrature", "lattice"},
         [](P& p, double v) { p.setup.orientation.sampling = Sampling(int(v)); });
  return out;
}

}  // namespace

std::string Sweepable::text(double value) const {
  return options.empty() ? fmt::format("{:.6g}", value) : options.at(std::size_t(value));
}

const std::vector<Sweepable>& sweepables() {
  static const std::vector<Sweepable> table = all();
  return table;
}

const Sweepable* find_sweepable(const std::string& name) {
  const auto& table = sweepables();
  const auto found =
      std::find_if(table.begin(), table.end(), [&](const Sweepable& s) { return s.name == name; });
  return found == table.end() ? nullptr : &*found;
}

}  // namespace bristle::experiment
