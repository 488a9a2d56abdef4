#include "experiment/canonical.hpp"

#include "experiment/parameters_table.hpp"
#include "experiment/si_units.hpp"
#include "experiment/words.hpp"

#include <nlohmann/json.hpp>

namespace bristle::experiment {
namespace {

using Object = nlohmann::json;  // sorted keys; numbers in the shortest form that reads back exactly

// These fail when a member is added: without the member in canonical(), different points would be treated as
// equal.
static_assert(sizeof(Parameters) == 24 * sizeof(double));
static_assert(sizeof(Orientation) == 11 * sizeof(double));
static_assert(sizeof(IntegratorOptions) == 4 * sizeof(double));
static_assert(sizeof(Setup) ==
              sizeof(Parameters) + sizeof(Orientation) + sizeof(IntegratorOptions) + sizeof(double));
static_assert(sizeof(Loading) == 8 * sizeof(double));
static_assert(sizeof(Recording) == 4 * sizeof(double));

Object canonical(const Parameters& p) {
  Object out;
  for (const ParameterEntry& entry : parameters_table()) out[entry.name] = p.*entry.member;
  for (const Choice& choice : choices_table())
    out[choice.name] = choice.options.at(std::size_t(choice.get(p)));
  return out;
}

Object canonical(const Orientation& o) {
  return {{"distribution", word(o.distribution)},
          {"mean", o.mean},
          {"concentration", o.concentration},
          {"sampling", word(o.sampling)},
          {"full_circle", o.full_circle},
          {"rtol", o.rtol},
          {"theta_0", o.theta_0},
          {"seed", o.seed},
          {"rows", o.rows},
          {"t_1", o.t_1}};
}

Object canonical(const IntegratorOptions& i) {
  return {
      {"rtol", i.rtol}, {"atol", i.atol}, {"method", word(i.method)}, {"max_evaluations", i.max_evaluations}};
}

Object canonical(const Loading& l) {
  if (l.z_0) return {{"z_0", *l.z_0}};
  if (l.trace) return {{"to", l.trace->to}, {"resolution", l.trace->resolution}, {"nodes", l.trace->nodes}};
  return {{"R_n", l.R_n}, {"path", word(l.path)}};
}

Object canonical(const Recording& r) {
  return {{"bristles", r.bristles}, {"slab_force", r.slab_force}, {"trajectories", r.trajectories}};
}

}  // namespace

std::string canonical_point(const Experiment& experiment, std::size_t index) {
  const PointInput point = experiment.point(index);
  Object out = {{"model", canonical(point.setup.parameters)},
                {"orientation", canonical(point.setup.orientation)},
                {"integrator", canonical(point.setup.integrator)},
                {"engine", word(experiment.engine)},
                {"max_evaluations_per_point", point.setup.max_evaluations_per_point},
                {"load", canonical(point.loading)},
                {"record", canonical(experiment.record)}};
  if (!point.si.empty()) out["force_unit"] = force_unit(point);
  return out.dump();
}

}  // namespace bristle::experiment
