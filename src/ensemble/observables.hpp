#pragma once

#include "dynamics/passage.hpp"

#include <array>
#include <string_view>

namespace bristle {

// Appendix A averages over time what acts on the slab, and over the bristles what is a property of a passage.
// The integrals over time are those of PathSample.
enum class Average {
  over_time,
  over_passages
};

// The variants of an observable for the bristles that are not pinned at the pole.
enum class Unpinned {
  none,
  contribution,  // their contribution to the mean, and the share of the pinned bristles
  mean           // the mean over them
};

// What ensemble, lattice and results need to know of a quantity that is averaged over theta_0. From its row
// follow its variables in result files, with errors. Dimensionless; forces per N_c0.
struct ObservableRow {
  const char *name, *long_name, *symbol, *equation;
  double (*value)(const Passage& passage, double L_x);  // its contribution to the mean
  Average average;
  bool controlled;  // refined until its error is within orientation.rtol
  Unpinned unpinned = Unpinned::none;
  bool is_force = false;  // in an experiment in SI units there is a variable in newtons, too
};

inline constexpr std::array kObservables = {
    ObservableRow{"R_n", "normal load per bristle", R"(\tilde{R}_n/N_{c,0})", "Eq. (19)",
                  [](const Passage& p, double L_x) { return p.end[NORMAL] / L_x; }, Average::over_time, true,
                  Unpinned::contribution, true},
    ObservableRow{"R_x", "friction force per bristle along the motion", R"(\tilde{R}_x/N_{c,0})", "Eq. (19)",
                  [](const Passage& p, double L_x) { return p.end[FRICTION_X] / L_x; }, Average::over_time,
                  true, Unpinned::contribution, true},
    ObservableRow{"R_y", "friction force per bristle across the motion", R"(\tilde{R}_y/N_{c,0})", "Eq. (19)",
                  [](const Passage& p, double L_x) { return p.end[FRICTION_Y] / L_x; }, Average::over_time,
                  true, Unpinned::none, true},
    ObservableRow{"N_c_ratio", "bristles in contact over those of rigid bristles", R"(N_c/N_{c,0})",
                  "Eq. (A2)", [](const Passage& p, double L_x) { return p.contact_time / L_x; },
                  Average::over_time, true},
    ObservableRow{"gamma_1", "modulation of friction by the sliding speed", R"(\tilde{\gamma}_1)", "Eq. (24)",
                  [](const Passage& p, double) { return p.gamma_1; }, Average::over_passages, true,
                  Unpinned::mean},
    ObservableRow{"gamma_2", "alignment of friction with the motion", R"(\tilde{\gamma}_2)", "Eq. (25)",
                  [](const Passage& p, double) { return p.gamma_2; }, Average::over_passages, true,
                  Unpinned::mean},
    ObservableRow{"gamma_3", "reduction of the contact area by load fluctuations", R"(\tilde{\gamma}_3)",
                  "Eq. (26)", [](const Passage& p, double) { return p.gamma_3; }, Average::over_passages,
                  true, Unpinned::mean},
    ObservableRow{"pinned_fraction", "fraction of bristles pinned upright at the pole",
                  R"(f_\mathrm{pinned})", "",
                  [](const Passage& p, double) { return p.outcome == Outcome::pinned ? 1.0 : 0.0; },
                  Average::over_passages, false},
    ObservableRow{"energy_residual", "mean error of the energy budget over the dissipated or initial energy",
                  R"(\epsilon_E)", "Eqs. (13, 17, 18)",
                  [](const Passage& p, double) { return p.energy_residual; }, Average::over_passages, false},
};

// Index of an observable: of a row, of a contribution by outcome, or WEIGHT.
using Observable = std::size_t;

consteval Observable observable(std::string_view name) {
  Observable k = 0;
  while (name != kObservables[k].name) ++k;
  return k;
}
inline constexpr Observable R_N = observable("R_n"), R_X = observable("R_x"), R_Y = observable("R_y"),
                            N_C_RATIO = observable("N_c_ratio"), GAMMA_1 = observable("gamma_1"),
                            GAMMA_2 = observable("gamma_2"), GAMMA_3 = observable("gamma_3"),
                            PINNED_FRACTION = observable("pinned_fraction"),
                            ENERGY_RESIDUAL = observable("energy_residual");

// After the rows: the contributions of the bristles that are not pinned, then those of the pinned ones, of
// the rows that have them.
constexpr std::size_t count_unpinned(bool pinned_too) {
  std::size_t count = 0;
  for (const ObservableRow& row : kObservables)
    count += pinned_too ? row.unpinned == Unpinned::contribution : row.unpinned != Unpinned::none;
  return count;
}
constexpr Observable split_index(Observable k, bool pinned) {
  Observable index = kObservables.size() + (pinned ? count_unpinned(false) : 0);
  for (Observable i = 0; i < k; ++i)
    index += pinned ? kObservables[i].unpinned == Unpinned::contribution
                    : kObservables[i].unpinned != Unpinned::none;
  return index;
}
// Require that the row has such contributions.
constexpr Observable unpinned(Observable k) { return split_index(k, false); }
constexpr Observable pinned(Observable k) { return split_index(k, true); }

// Integral of the density of theta_0: 1 up to the error of the quadrature.
inline constexpr Observable WEIGHT = kObservables.size() + count_unpinned(false) + count_unpinned(true);
inline constexpr std::size_t OBSERVABLES = WEIGHT + 1;
using ObservableArray = std::array<double, OBSERVABLES>;

// Contribution of one passage to the means, for a slab of length L_x.
ObservableArray observables(const Passage& passage, double L_x);
// Sets the contributions of pinned and of other bristles according to those of the passage.
void split_by_outcome(ObservableArray& contribution, Outcome outcome);

}  // namespace bristle
