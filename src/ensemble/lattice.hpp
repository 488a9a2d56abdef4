#pragma once

#include "ensemble/ensemble.hpp"

namespace bristle {

// Force on the slab over time, means over intervals of a quarter of a row's time spacing/V0 from t = 0: an
// impact shorter than that counts with its impulse. Forces per N_c0; N_c over N_c0; dimensionless.
struct SlabForce {
  double interval = 0;
  std::vector<double> R_n, R_x, R_y, N_c;
};

// Standard deviation of R_n(t) over its mean, with its standard error. Rows enter at equal times, so R_n(t)
// has a part of that period that stays however large the lattice is; means over a row's time are free of it.
struct Fluctuation {
  double value = 0, error = 0;
};

// Time mean over t_1..t_2 of the force on the slab, with its standard error.
struct LatticeMean {
  ObservableArray mean{}, error{};
  Fluctuation fluctuation, fluctuation_of_rows;  // of R_n(t), and of its means over a row's time
  std::vector<Passage> passages;                 // row by row
  long incomplete = 0;                           // passages without an exit; > 0: the means mean nothing
  double incomplete_theta_0 = 0;                 // the first of them, rad
  SlabForce force;
};

// Appendix A at the gap z_0: rows of L_y/spacing bristles enter every spacing/V0, with random azimuths keyed
// by seed and bristle. Forces and N_c are means over the time t_1..t_2, the gammas and what else belongs to a
// passage are means over the bristles. Bristles are independent, so the standard errors follow from the
// scatter of the single bristles' contributions; times at which the same bristle acts are not counted as
// independent.
LatticeMean lattice_mean(const Setup& setup, double z_0, const PassageRunner& run);

// t_1 and t_2 of Eq. (A4), in units of r0/V0: orientation.t_1 or, if that is negative, 2 L_x; and the time at
// which the last row has entered.
double lattice_start(const Setup& setup);
double lattice_end(const Setup& setup);

// N_c0/L_y: rigid bristles in contact per unit of the slab's width (dimensionless).
double bristles_per_width(const Parameters& parameters);

}  // namespace bristle
