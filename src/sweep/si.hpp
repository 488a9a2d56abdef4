#pragma once

#include "bristle/model/material.hpp"
#include "sweep/sweepable.hpp"

#include <string>
#include <vector>

namespace bristle::sweep {

// A quantity of an experiment's si block. From its row follow the key of the block, its limits, its axis in
// sweeps, and the attributes of that axis.
struct SiQuantity {
  const char* name;         // JSON key, which includes the unit
  const char* symbol;       // LaTeX
  const char* description;  // attribute of result files
  const char* units;
  Bounds limits;
  std::vector<const char*> replaces;  // the dimensionless values that are computed from it
  // The value divided by this scale is the only value that it replaces. Null: apply_si_units() computes the
  // values.
  double SiScales::*scale = nullptr;
  const char* remark = nullptr;  // after the description of the key
};
const std::vector<SiQuantity>& si_quantities();

// Replaces dimensionless values by values computed from input.si; without SI quantities does nothing. The
// shaft of radius R and Young's modulus E bends like a cantilever: k_phi = 3 pi E R^4/(4 r0) (section 3 of
// the paper), and k_theta, too, unless k_theta_over_k_phi is given.
void apply_si_units(PointInput& input);

// Returns the dimensionless values that are computed from input.si, as "name = value".
std::vector<std::string> values_from_si(const PointInput& input);

// Returns the dimensionless values, as "name = value", that no SI quantity replaces although one could: they
// stay what they are, whatever the material.
std::vector<std::string> values_not_in_si(const PointInput& input);

// Returns the scales of a point; NaN without SI quantities.
SiScales si_scales(const PointInput& input);

}  // namespace bristle::sweep
