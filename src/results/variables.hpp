#pragma once

#include "bristle/ensemble/derived.hpp"
#include "experiment/experiment.hpp"
#include "results/tables.hpp"

#include <functional>
#include <string>
#include <vector>

namespace bristle::results {

// The errors that are written beside a variable: none; its error, as <name>_err; or also, for the gap of a
// load, the part of the error due to the deviation of the load from its target, as load_error/<name>.
enum class Errors {
  none,
  estimated,
  with_load
};

// A variable of the result file, with one value per sweep point.
struct ResultVariable : Column {
  std::function<Quantity(const PointResult&)> of;
  Errors errors;
  bool may_be_missing = false;  // the variable is not defined at some points with values
  std::string why_missing = "it is not defined there (docs/results-format.md)";  // in words
};
// Returns the variables of a result of this sweep.
std::vector<ResultVariable> result_variables(const Sweep& sweep);

}  // namespace bristle::results
