#include "cli/commands.hpp"

#include "bristle/model/bristle.hpp"
#include "bristle/model/elementary.hpp"
#include "results/csv.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <vector>

namespace bristle::cli {
namespace {

constexpr double kSlowest = 1e-5, kFastest = 10;  // in units of V0
constexpr int kPerDecade = 50;

std::vector<double> speeds() {
  std::vector<double> out = {0};
  for (int i = 0; i <= 6 * kPerDecade; ++i) out.push_back(kSlowest * pow(10, double(i) / kPerDecade));
  out.back() = kFastest;
  return out;
}

}  // namespace

int law_command(const ExperimentOptions& options) {
  const Experiment e = experiment::load_experiment(options.file, options.load);
  std::vector<Parameters> laws;  // of the points, each once, with the first values of the other axes
  for (std::size_t i = 0; i < e.sweep.size() && laws.size() < std::size_t(FrictionLaw::count); ++i) {
    const Parameters p = e.sweep.point(i).setup.parameters;
    if (std::ranges::none_of(laws, [&](const Parameters& known) { return known.friction == p.friction; }))
      laws.push_back(p);
  }
  const bool in_si = e.sweep.base.friction_law_in_si;
  fmt::print(
      "# {}: modulation of each friction law, dimensionless; of custom: mu\n"
      "# V_R: sliding speed, in units of V0\n{}V_R{}",
      e.name,
      laws.size() < e.sweep.size() ? "# A law has the parameters of the first point that uses it.\n" : "",
      in_si ? ",V_R_m_per_s" : "");
  for (const Parameters& p : laws) fmt::print(",{}", word(p.friction));
  for (const double V_R : speeds()) {
    fmt::print("\n{}", results::csv_number(V_R));
    if (in_si) fmt::print(",{}", results::csv_number(V_R * e.sweep.point(0).si.at("V0_m_per_s")));
    for (const Parameters& p : laws) fmt::print(",{}", results::csv_number(modulation(p, V_R)));
  }
  fmt::print("\n");
  return kSuccess;
}

}  // namespace bristle::cli
