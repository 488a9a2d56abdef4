#pragma once

#include <vector>

namespace bristle {

enum class Distribution {
  uniform,
  von_mises
};
enum class Sampling {
  quadrature,
  list
};

// The distribution of the undeformed azimuths theta_0 over the lattice. Angles in rad.
struct Orientation {
  Distribution distribution = Distribution::uniform;
  double mean = 0, concentration = 0;  // von Mises
  Sampling sampling = Sampling::quadrature;
  bool full_circle = false;     // do not use the mirror symmetry even where it holds
  double rtol = 1e-3;           // of the ensemble means
  std::vector<double> theta_0;  // Sampling::list, equally weighted
};

// Probability density of theta_0, per rad.
double density(const Orientation& orientation, double theta_0);

// theta_0 -> -theta_0 leaves the distribution unchanged, so that [0, pi] suffices and R_y = 0.
bool mirror_symmetric(const Orientation& orientation);

}  // namespace bristle
