#pragma once

#include "bristle/ensemble/ensemble.hpp"
#include "bristle/quantity.hpp"

namespace bristle {

// Forces on the slab over time from t = 0, averaged over intervals of a quarter of spacing/V0, the time
// between rows. An impact that is shorter than an interval contributes its impulse. Forces are per N_c0 and
// N_c is over N_c0; dimensionless.
struct SlabForce {
  double interval = 0;
  std::vector<double> R_n, R_x, R_y, N_c;
};

// Time mean over t_1..t_2 of the force on the slab, with its standard error.
struct LatticeMean {
  ObservableArray mean{}, error{};
  // Standard deviations over the mean, with standard errors: of R_n(t) (fluctuation), and of the means of
  // R_n(t) over the time between rows (fluctuation_of_rows). Rows enter at equal time intervals, so that
  // R_n(t) has a component with that period, however large the lattice is; the means do not have it.
  Quantity fluctuation, fluctuation_of_rows;
  std::vector<Passage> passages;  // row by row
  long incomplete = 0;            // passages without an exit; if > 0, the means are invalid
  double incomplete_theta_0 = 0;  // azimuth of the first incomplete passage, rad
  SlabForce force;
};

// Computes the means of Appendix A at the gap z_0: rows of L_y/spacing bristles enter every spacing/V0, with
// random azimuths and deviations keyed by seed and index of the bristle. Forces and N_c are means over the
// time t_1..t_2; the gammas and the other properties of a passage are means over the bristles. Bristles are
// independent, so the standard errors follow from the scatter of their contributions; the instants at which
// one bristle acts do not count as independent.
LatticeMean lattice_mean(const Setup& setup, double z_0, const PassageRunner& run);

// Returns t_1 of Eq. (A4), in units of r0/V0: orientation.t_1 or, if that is negative, 2 L_x.
double lattice_start(const Setup& setup);
// Returns t_2 of Eq. (A4), in units of r0/V0: the time at which the last row has entered.
double lattice_end(const Setup& setup);

// Returns N_c0/L_y, the number of rigid bristles in contact per unit of the slab's width (dimensionless).
double bristles_per_width(const Parameters& parameters);

}  // namespace bristle
