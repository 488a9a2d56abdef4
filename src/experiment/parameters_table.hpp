#pragma once

#include "ensemble/point.hpp"

#include <functional>
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

// A choice of the model block: one of some words.
struct Choice {
  const char* name;
  const char* description;
  std::vector<std::string> options;
  std::function<int(const Parameters&)> get;  // index into options
  std::function<void(Parameters&, int)> set;
};

const std::vector<Choice>& choices_table();

}  // namespace bristle
