#pragma once

#include "experiment/document.hpp"
#include "experiment/experiment.hpp"

namespace bristle {

// Replaces dimensionless values by those of the document's si block, if it has one. Scales: length r0,
// force m V0^2/r0, torsional stiffness m V0^2, stress m V0^2/r0^3. Throws InputError if a quantity is also
// swept.
void apply_si_units(const Document& document, PointInput& input);

}  // namespace bristle
