#pragma once

#include "interface/point.hpp"

#include <string>
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

// Names that a sweep may use: the model's numbers, R_n and z_0.
std::vector<std::string> sweepable_parameters();

// Symbol (LaTeX, without $) and description of a sweepable parameter.
struct AxisLabel {
  std::string symbol, description, units;
};
AxisLabel axis_label(const std::string& name);

}  // namespace bristle
