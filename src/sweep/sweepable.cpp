#include "sweep/sweepable.hpp"

#include "sweep/si.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace bristle::sweep {
namespace {

Sweepable of_model(const Parameter& one) {
  const auto set = [one](PointInput& p, double value) { p.setup.parameters.*one.member = value * one.unit; };
  return {one.name, one.symbol, one.description, one.unit == 1 ? "1" : "degree", set, {}};
}

std::vector<Sweepable> all() {
  using P = PointInput;
  std::vector<Sweepable> out;
  for (const Parameter& one : kParameters) out.push_back(of_model(one));
  const auto number = [&](const char* name, const char* symbol, const char* description, auto set,
                          const char* units = "1") {
    out.push_back({name, symbol, description, units, set, {}});
  };
  number("R_n", R"(\tilde{R}_n/N_{c,0})", "target normal load per bristle",
         [](P& p, double v) { p.loading.R_n = v; });
  number("nominal_friction", R"(R_\mathrm{rigid}/R_n)", "friction of rigid bristles over their load",
         [](P& p, double v) { p.nominal_friction = v; });
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
  for (std::size_t i = 0; i < kScattered.size(); ++i)
    out.push_back({kScatterPrefix + std::string(kScattered[i].name),
                   fmt::format(R"(\sigma({0})/{0})", kScattered[i].symbol),
                   fmt::format("scatter of the {} within the brush, relative", kScattered[i].description),
                   "1",
                   [i](P& p, double v) { p.setup.scatter.width[i] = v; },
                   {}});

  for (const SiQuantity& q : si_quantities())
    number(
        q.name, q.symbol, q.description, [key = std::string(q.name)](P& p, double v) { p.si[key] = v; },
        q.units);

  const auto choice = [&](const char* name, const char* description, Words words, auto set) {
    out.push_back({name, name, description, "1", set, texts(words)});
  };
  for (const Choice& c : choices())
    choice(c.name, c.description, c.words, [c](P& p, double v) { c.set(p.setup.parameters, int(v)); });
  choice("path", "path on which the load is reached", words<LoadPath>(),
         [](P& p, double v) { p.loading.path = LoadPath(int(v)); });
  choice("sampling", "sampling of theta_0 for the ensemble mean", words<Sampling>().first(2),
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

}  // namespace bristle::sweep
