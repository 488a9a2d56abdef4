#pragma once

#include <cstdint>
#include <vector>

namespace bristle {

enum class Distribution {
  uniform,
  von_mises
};
enum class Sampling {
  quadrature,
  lattice,  // Appendix A: rows of bristles with random azimuths, see lattice.hpp
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
  std::uint64_t seed = 0;       // Sampling::lattice: of the random azimuths
  long rows = 0;                // that enter, one every spacing/V0
  double t_1 = 0;  // time from which means are taken, in units of r0/V0; the end is that of the rows
};

// Probability density of theta_0, per rad.
double density(const Orientation& orientation, double theta_0);

// The azimuth (rad) of the bristle of this index in a lattice of this seed: the same whatever else is drawn.
double random_azimuth(const Orientation& orientation, std::uint64_t index);

// theta_0 -> -theta_0 leaves the distribution unchanged, so that [0, pi] suffices and R_y = 0.
bool mirror_symmetric(const Orientation& orientation);

}  // namespace bristle
