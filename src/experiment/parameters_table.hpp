#pragma once

#include "ensemble/point.hpp"

#include <functional>
#include <string>
#include <vector>

namespace bristle::experiment {

// A number of the experiment's model block. Its range is declared in experiment.schema.json; a test compares
// names and descriptions of the two.
struct ParameterEntry {
  const char* name;  // JSON key
  double Parameters::*member;
  double unit;              // member = JSON value * unit
  const char* symbol;       // LaTeX
  const char* description;  // attribute of result files
};

const std::vector<ParameterEntry>& parameters_table();

// A choice of the model block: one of several words.
struct Choice {
  const char* name;
  const char* description;
  std::vector<std::string> options;
  std::function<int(const Parameters&)> get;  // index into options
  std::function<void(Parameters&, int)> set;
};

const std::vector<Choice>& choices_table();

}  // namespace bristle::experiment
