#pragma once

#include "experiment/document.hpp"
#include "experiment/experiment.hpp"

#include <vector>

namespace bristle {

// A quantity of an experiment's si block.
struct SiQuantity {
  const char* name;  // with its unit, as the key in JSON
  const char* symbol;
  const char* description;
  const char* units;
  std::vector<const char*> replaces;  // the dimensionless values that follow from it
};
const std::vector<SiQuantity>& si_quantities();

// Reads the document's si block into input.si. Throws InputError if what follows from it is swept, too, or if
// it leaves something out.
void read_si_units(const Document& document, const std::vector<Axis>& axes, PointInput& input);

// Replaces dimensionless values by those that follow from input.si, if there is any. Scales: length r0, force
// m V0^2/r0, torsional stiffness and energy m V0^2, stress m V0^2/r0^3. A shaft of radius R and Young's
// modulus E bends as a cantilever: k_theta = k_phi = 3 pi E R^4/(4 r0) (the paper, section 3).
void apply_si_units(PointInput& input);

// Newtons per dimensionless force; not-a-number without SI units.
double force_unit(const PointInput& input);

}  // namespace bristle
