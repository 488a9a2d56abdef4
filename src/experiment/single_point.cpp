#include "experiment/experiment.hpp"
#include "experiment/sample.hpp"
#include "util/grid.hpp"

#include <nlohmann/json.hpp>

namespace bristle::experiment {
namespace {

// Returns the value of an axis or a column as in an experiment file: a word of a choice, or a number.
Json json_value(const sweep::Axis& axis, std::size_t index) {
  const sweep::Sweepable& what = axis.quantity();
  return what.options.empty() ? Json(axis.values[index]) : Json(what.text(axis.values[index]));
}

Json json_of(const sweep::Axis& axis, std::size_t index) {
  if (axis.columns.empty()) return {{"values", Json::array({json_value(axis, index)})}};
  Json columns = Json::array(), row = Json::array();
  for (const sweep::Axis& column : axis.columns) {
    columns.push_back(column.name);
    row.push_back(json_value(column, index));
  }
  return {{"table", {{"columns", columns}, {"rows", Json::array({row})}}}};
}

}  // namespace

Json document_of_point(const Experiment& experiment, std::size_t index) {
  Json document = *experiment.document;
  for (const char* of_many : {"sweep", "checks", "checks_for_each", "analysis", "locate_jumps", "design"})
    document.erase(of_many);
  const std::vector<std::size_t> at = unravel(index, experiment.sweep.shape());
  for (std::size_t d = 0; d < at.size(); ++d)
    document["sweep"][experiment.sweep.axes[d].name] = json_of(experiment.sweep.axes[d], at[d]);
  return document;
}

}  // namespace bristle::experiment
