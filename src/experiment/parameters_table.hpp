#pragma once

#include "interface/point.hpp"

#include <vector>

namespace bristle {

// A number of the experiment's model block: its JSON name, where it lives, its unit's factor, and how
// result files label it.
struct ParameterEntry {
  const char* name;
  double Parameters::*member;
  double unit;  // member = JSON value * unit
  const char* symbol;
  const char* description;
};

const std::vector<ParameterEntry>& parameters_table();

}  // namespace bristle
