#pragma once

#include "ensemble/point.hpp"

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace bristle {

// What a point of the sweep is computed from.
struct PointInput {
  Setup setup;
  Loading loading;
  std::map<std::string, double> si{};  // SI units by their names in JSON, see si_units.hpp
};

// Something that a sweep may vary, and how result files label its axis.
struct Sweepable {
  std::string name, symbol, description, units;
  std::function<void(PointInput&, double)> set;
  std::vector<std::string> options;  // the words of a choice, whose value is an index; empty for a number

  // The value for messages: a word, or six digits of a number.
  std::string text(double value) const;
};

// The model's numbers and choices, the load, and the orientation's numbers and sampling.
const std::vector<Sweepable>& sweepables();

// Null if there is none of that name.
const Sweepable* find_sweepable(const std::string& name);

}  // namespace bristle
