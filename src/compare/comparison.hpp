#pragma once

namespace bristle::compare {

// The difference of two numbers in units of a tolerance: 0 if they are equal; infinite if one of them is not
// finite or the tolerance is 0; NaN if the tolerance is NaN (unknown).
double in_tolerances(double a, double b, double tolerance);

}  // namespace bristle::compare
