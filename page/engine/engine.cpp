// The page's engine: one call, JSON in and JSON out. Everything from the experiment to the numbers of a point
// is the program's code.
#include "bristle/ensemble/derived.hpp"
#include "bristle/ensemble/phase.hpp"
#include "bristle/ensemble/validity.hpp"
#include "bristle/model/error.hpp"
#include "bristle/simd/runner.hpp"
#include "experiment/experiment.hpp"
#include "experiment/point_checks.hpp"
#include "results/phases.hpp"
#include "results/variables.hpp"
#include "sweep/si.hpp"
#include "util/error.hpp"
#include "passages.hpp"

#include <cstdlib>
#include <nlohmann/json.hpp>

namespace bristle::page {
namespace {

// JSON has no NaN: dump() writes null.
Json value_and_error(const Quantity& quantity) { return Json::array({quantity.value, quantity.error}); }

// The variables of a result, and the friction coefficient, which results have in SI units only.
std::vector<results::ResultVariable> variables_of(const Sweep& sweep) {
  std::vector<results::ResultVariable> variables = results::result_variables(sweep);
  if (sweep.base.si.empty())
    variables.push_back({{"friction_coefficient", "friction over normal load", R"(R_x/R_n)", "Eq. (19)"},
                         friction_coefficient,
                         results::Errors::estimated});
  return variables;
}

Json solved(const Sweep& sweep, std::size_t index) {
  const sweep::PointInput input = sweep.point(index);
  Recorded recorded;
  PointResult result;
  try {
    result = solve_point(input.setup, input.loading, make_runner(sweep.engine), sweep.record, &recorded);
  } catch (const ModelError& e) {
    return {{"status", word(PointStatus::failed)}, {"failure", e.what()}};
  }
  result.parameters = input.setup.parameters;
  result.si = sweep::si_scales(input);
  Json values, exceeded = Json::array();
  for (const results::ResultVariable& variable : variables_of(sweep))
    values[variable.name] = value_and_error(variable.of(result));
  for (const ValidityRow& row : kValidity)
    if (exceeds(row, result) == Exceeds::yes) exceeded.push_back(row.name);
  return {{"status", word(result.status)},
          {"phase", word(phase_of(result))},
          {"lift_off_unknown", outside_of(lift_off_domain(result.parameters))},
          {"exceeded", exceeded},
          {"carried", result.status == PointStatus::unreachable
                          ? results::carried_text(input, result.R_n_largest.value, result.z_0_of_R_n_largest)
                          : ""},
          {"values", values},
          {"passages", passages_of(recorded, result)}};
}

// The points and axes of an experiment, and the names, units and meanings of their numbers.
Json described(const Experiment& experiment) {
  Json axes = Json::array(), variables = Json::array();
  for (const sweep::Axis& axis : experiment.sweep.axes)
    axes.push_back({{"name", axis.name}, {"values", axis.values}});
  for (const results::ResultVariable& variable : variables_of(experiment.sweep))
    variables.push_back(
        {{"name", variable.name}, {"units", variable.units}, {"meaning", variable.long_name}});
  return {{"points", experiment.sweep.size()},
          {"axes", axes},
          {"warnings", experiment.warnings},
          {"dimensionless", sweep::values_from_si(experiment.sweep.point(0))},
          {"variables", variables}};
}

// Answers a question {"experiment": ..., "point": index}: the numbers of the point or, without one, a
// description of the experiment. What is not allowed is answered by {"error": message}.
std::string answer(const char* question) {
  try {
    const Json asked = parse_json(question);
    const Experiment experiment = experiment::made_experiment(asked.at("experiment"));
    check_clearance(*experiment.source, experiment);
    if (!asked.contains("point")) return described(experiment).dump();
    const std::size_t index = asked["point"];
    if (index >= experiment.sweep.size()) throw InputError("point: the experiment has fewer points");
    return solved(experiment.sweep, index).dump();
  } catch (const std::exception& e) {
    return Json{{"error", e.what()}}.dump(-1, ' ', false, Json::error_handler_t::replace);
  }
}

}  // namespace
}  // namespace bristle::page

// Answers a question, a text that ends with a zero byte in memory that malloc() returned. Returns such a
// text; the caller frees both.
extern "C" char* bristle_answer(const char* question) {
  const std::string text = bristle::page::answer(question);
  char* out = static_cast<char*>(std::malloc(text.size() + 1));
  text.copy(out, text.size());
  out[text.size()] = 0;
  return out;
}
