#pragma once

#include "bristle/ensemble/ensemble.hpp"
#include "bristle/quantity.hpp"

namespace bristle {

// Forces on the slab over time from t = 0, averaged over intervals of a quarter of spacing/V0, the time
// between rows. A shorter impact contributes its impulse. Forces per N_c0; N_c over N_c0; dimensionless.
struct SlabForce {
  double interval = 0;
  std::vector<double> R_n, R_x, R_y, N_c;
};

// Time mean over t_1..t_2 of the force on the slab, with its standard error.
struct LatticeMean {
  ObservableArray mean{}, error{};
  // Standard deviations over the mean, with their standard errors: of R_n(t), and of its means over the time
  // between rows. Rows enter at equal time intervals, so that R_n(t) has a part with that period, however
  // large the lattice is; the means do not have it.
  Quantity fluctuation, fluctuation_of_rows;
  std::vector<Passage> passages;  // row by row
  long incomplete = 0;            // passages without an exit; if > 0, the means are invalid
  double incomplete_theta_0 = 0;  // azimuth of the first of them, rad
  SlabForce force;
};

// Appendix A at the gap z_0: rows of L_y/spacing bristles enter every spacing/V0, with
// random azimuths keyed by seed and index of the bristle. Forces and N_c are means over
// the time t_1..t_2; the gammas and the other properties of a passage are means over the
// bristles. Bristles are independent, so the standard errors follow from the scatter of
// their contributions. The times at which one bristle acts are not counted as independent.
LatticeMean lattice_mean(const Setup& setup, double z_0, const PassageRunner& run);

// t_1 and t_2 of Eq. (A4), in units of r0/V0. t_1 is orientation.t_1 or, if that is negative, 2 L_x. t_2 is
// the time at which the last row has entered.
double lattice_start(const Setup& setup);
double lattice_end(const Setup& setup);

// N_c0/L_y: rigid bristles in contact per unit of the slab's width (dimensionless).
double bristles_per_width(const Parameters& parameters);

}  // namespace bristle
