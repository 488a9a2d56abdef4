#pragma once

#include "bristle/ensemble/point.hpp"

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace bristle::sweep {

// Input of one point of the sweep.
struct PointInput {
  Setup setup;
  Loading loading;
  std::map<std::string, double> si{};  // SI quantities by JSON key, see si.hpp
  bool friction_law_in_si = false;     // the speeds of the experiment's own law are in m/s
  // R_rigid/R_n at the target load: with a value, it replaces the strength of the friction law.
  std::optional<double> nominal_friction{};
};

// The widths of the scatter have the names of kScattered behind this.
constexpr const char* kScatterPrefix = "scatter_";

// A quantity or choice that a sweep may vary, with the labels of its axis in result files.
struct Sweepable {
  std::string name, symbol, description, units;
  std::function<void(PointInput&, double)> set;
  std::vector<std::string> options;  // words of a choice, whose value is an index; empty for a number

  // Returns the value for messages: a word, or a number with six digits.
  std::string text(double value) const;
};

// Returns the numbers and choices of the model, SI quantities, the load, numbers and sampling of the
// orientation, and widths of the scatter within a brush.
const std::vector<Sweepable>& sweepables();

// Returns the quantity or choice of this name; null for an unknown name.
const Sweepable* find_sweepable(const std::string& name);

}  // namespace bristle::sweep
