#pragma once

#include "bristle/words.hpp"

#include <cmath>
#include <cstdint>
#include <vector>

namespace bristle {

enum class Distribution {
  uniform,
  von_mises
};
template <>
inline Words words<Distribution>() {
  static constexpr const char* list[] = {"uniform", "von_mises"};
  return list;
}
enum class Sampling {
  quadrature,
  lattice,  // Appendix A: rows of bristles with random azimuths, see lattice.hpp
  list
};
template <>
inline Words words<Sampling>() {
  static constexpr const char* list[] = {"quadrature", "lattice", "list"};
  return list;
}

// The distribution of the undeformed azimuths theta_0 over the lattice. Angles in rad.
struct Orientation {
  Distribution distribution = Distribution::uniform;
  double mean = 0, concentration = 0;  // Distribution::von_mises
  Sampling sampling = Sampling::quadrature;
  bool full_circle = false;     // do not use the mirror symmetry even if it holds
  double rtol = 1e-3;           // requested relative accuracy of the ensemble means
  std::vector<double> theta_0;  // Sampling::list, equally weighted
  std::uint64_t seed = 0;       // Sampling::lattice: seed of the random azimuths
  long rows = 0;                // Sampling::lattice: number of rows; one enters every spacing/V0
  double t_1 =
      0;  // Sampling::lattice: start of the time means, r0/V0 (negative: 2 L_x); they end with the last row
};

// Probability density of theta_0, per rad.
class Density {
 public:
  explicit Density(const Orientation& orientation);
  double operator()(double theta_0) const;

 private:
  double mean_, concentration_, peak_;
};

// Returns the standard deviation of a narrow distribution, rad; infinity for the uniform one.
double standard_deviation(const Orientation& orientation);

// Returns the azimuth (rad) of the bristle with this index. It depends on the seed and the index only.
double random_azimuth(const Orientation& orientation, std::uint64_t index);

// Returns whether theta_0 -> -theta_0 leaves the distribution unchanged: then [0, pi] suffices and R_y = 0.
bool mirror_symmetric(const Orientation& orientation);

// Returns the angle from the head-on bristle, which points exactly against the motion, to the azimuth
// theta_0: -pi to pi, rad.
inline double from_head_on(double theta_0) { return std::remainder(theta_0 - M_PI, 2 * M_PI); }
// Angle from the head-on bristle within which bristles contribute most to friction, rad.
constexpr double kHeadOn = M_PI / 6;

}  // namespace bristle
