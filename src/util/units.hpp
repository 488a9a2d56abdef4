#pragma once

#include <string>

namespace bristle {

// A unit for people, in units of the one that it replaces: {"mm", 1e-3} for "m".
struct ReadableUnit {
  std::string name;
  double size = 1;
};

// Returns the unit in which a value, given in `units`, is read most easily: 0.001 m is 1 mm, and 5e7 Pa are
// 50 MPa. Values outside the table and other units keep theirs.
ReadableUnit readable_unit(const std::string& units, double value);

// Returns the JSON key of a quantity without the unit at its end: "R" for "R_m".
std::string without_unit(const std::string& key, const std::string& units);

}  // namespace bristle
