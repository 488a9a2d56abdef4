#pragma once

#include "bristle/dynamics/passage.hpp"
#include "bristle/model/si_scales.hpp"

#include <array>
#include <string_view>

namespace bristle {

// Averages of Appendix A: over time for what acts on the slab, over the bristles for a property of a passage.
// The integrals over time are the members of PathSample.
enum class Average {
  over_time,
  over_passages
};

// Variants of an observable that hold for the bristles that are not pinned at the pole.
enum class Unpinned {
  none,
  contribution,  // contribution of the unpinned bristles to the mean, and share of the pinned ones
  mean           // mean over the unpinned bristles
};

// Returns the standard deviation of F_n over the time of a passage, divided by the mean of F_n; 0 for a
// passage without load.
double load_spread(const Passage& passage);
// Returns the angle (rad) for which 1 - cos(angle) equals versed.
double angle_of_versed(double versed);
// Returns the strain at the root of a cantilever with the shaft's radius whose bending angle is `bending`
// (rad): the tip's force F bends it by F r0^2/(3 E I), and the strain is F r0 R/(E I). Dimensionless.
double root_strain(const Parameters& p, double bending);

// Returns the axial force at which a cantilever with a free end buckles by Euler, pi^2 E I/(4 r0^2) = pi^2
// k_phi/12, where k_phi = 3 E I/r0 is the polar stiffness of a straight shaft. Dimensionless.
inline double euler_load(const Parameters& p) { return M_PI * M_PI * p.k_phi / 12; }

// Unit of the variant <name>_in_<suffix> of an observable in SI units.
struct SiUnit {
  const char *suffix, *units;
  double SiScales::*scale;
};
inline constexpr SiUnit kNewton{"N", "N", &SiScales::force}, kMetre{"m", "m", &SiScales::length},
    kPascal{"Pa", "Pa", &SiScales::stress}, kJoulePerMetre{"J_per_m", "J m-1", &SiScales::force};

// Describes a quantity that is averaged over theta_0, for ensemble, lattice and results. The variables in
// result files, with their errors, follow from its row. Dimensionless; forces per N_c0.
struct ObservableRow {
  const char *name, *long_name, *symbol, *equation;
  double (*value)(const Passage& passage, const Parameters&);  // contribution of one passage to the mean
  Average average;
  bool controlled;  // refined until its error is within orientation.rtol
  Unpinned unpinned = Unpinned::none;
  const SiUnit* si = nullptr;  // null: no variant in SI units
};

inline constexpr std::array kObservables = {
    ObservableRow{"R_n", "normal load per bristle", R"(\tilde{R}_n/N_{c,0})", "Eq. (19)",
                  [](const Passage& p, const Parameters& in) { return p.end[component::NORMAL] / in.L_x; },
                  Average::over_time, true, Unpinned::contribution, &kNewton},
    ObservableRow{
        "R_x", "friction force per bristle along the motion", R"(\tilde{R}_x/N_{c,0})", "Eq. (19)",
        [](const Passage& p, const Parameters& in) { return p.end[component::FRICTION_X] / in.L_x; },
        Average::over_time, true, Unpinned::contribution, &kNewton},
    ObservableRow{
        "R_y", "friction force per bristle across the motion", R"(\tilde{R}_y/N_{c,0})", "Eq. (19)",
        [](const Passage& p, const Parameters& in) { return p.end[component::FRICTION_Y] / in.L_x; },
        Average::over_time, true, Unpinned::none, &kNewton},
    ObservableRow{"N_c_ratio", "bristles in contact over rigid bristles in contact", R"(N_c/N_{c,0})",
                  "Eq. (A2)", [](const Passage& p, const Parameters& in) { return p.contact_time / in.L_x; },
                  Average::over_time, true},
    ObservableRow{"gamma_1", "modulation of friction by the sliding speed", R"(\tilde{\gamma}_1)", "Eq. (24)",
                  [](const Passage& p, const Parameters&) { return p.gamma_1; }, Average::over_passages, true,
                  Unpinned::mean},
    ObservableRow{"gamma_2", "alignment of friction with the motion", R"(\tilde{\gamma}_2)", "Eq. (25)",
                  [](const Passage& p, const Parameters&) { return p.gamma_2; }, Average::over_passages, true,
                  Unpinned::mean},
    ObservableRow{"gamma_3", "reduction of the contact area by load fluctuations", R"(\tilde{\gamma}_3)",
                  "Eq. (26)", [](const Passage& p, const Parameters&) { return p.gamma_3; },
                  Average::over_passages, true, Unpinned::mean},
    ObservableRow{
        "pinned_fraction", "fraction of bristles pinned upright at the pole", R"(f_\mathrm{pinned})", "",
        [](const Passage& p, const Parameters&) { return p.outcome == Outcome::pinned ? 1.0 : 0.0; },
        Average::over_passages, false},
    ObservableRow{"energy_residual", "mean error of the energy budget over the dissipated or initial energy",
                  R"(\epsilon_E)", "Eqs. (13, 17, 18)",
                  [](const Passage& p, const Parameters&) { return p.energy_residual; },
                  Average::over_passages, false},
    ObservableRow{"stuck_share", "share of the contact time with V_R below V_s", R"(f_\mathrm{stuck})", "",
                  [](const Passage& p, const Parameters&) { return p.path[STUCK_TIME] / p.contact_time; },
                  Average::over_passages, false},
    ObservableRow{"off_slab_share", "share of the contact time with the tip off the slab",
                  R"(f_\mathrm{off})", "",
                  [](const Passage& p, const Parameters&) { return p.path[OFF_SLAB_TIME] / p.contact_time; },
                  Average::over_passages, false},
    ObservableRow{"impacts", "impacts on the slab per passage", R"(N_\mathrm{impacts})", "",
                  [](const Passage& p, const Parameters&) { return p.path[IMPACTS]; }, Average::over_passages,
                  false},
    ObservableRow{"F_n_spread", "standard deviation of F_n over the passage, over its mean",
                  R"(\sigma(F_n)/\bar{F}_n)", "Eq. (3)",
                  [](const Passage& p, const Parameters&) { return load_spread(p); }, Average::over_passages,
                  false},
    ObservableRow{"F_n_peak", "largest normal force of the passage", R"(F_{n,\max})", "Eq. (3)",
                  [](const Passage& p, const Parameters&) { return p.path[LOAD_PEAK]; },
                  Average::over_passages, false, Unpinned::none, &kNewton},
    ObservableRow{
        "hertz_pressure_peak", "largest contact pressure of the passage, by Hertz", R"(p_{\max})", "Eq. (16)",
        [](const Passage& p, const Parameters& in) { return hertz_pressure(in, p.path[LOAD_PEAK]); },
        Average::over_passages, false, Unpinned::none, &kPascal},
    ObservableRow{"stretch_peak", "largest elongation of the bristle in the passage", R"((r - 1)_{\max})",
                  "Eq. (13)", [](const Passage& p, const Parameters&) { return p.path[STRETCH_PEAK]; },
                  Average::over_passages, false},
    ObservableRow{"compression_peak", "largest shortening of the bristle in the passage", R"((1 - r)_{\max})",
                  "Eq. (13)", [](const Passage& p, const Parameters&) { return p.path[COMPRESSION_PEAK]; },
                  Average::over_passages, false, Unpinned::none, &kMetre},
    ObservableRow{"axial_over_euler",
                  "largest axial force of the passage over the load at which a shaft buckles",
                  R"(k_r (1 - r)_{\max}/F_{\mathrm{Euler}})", "docs/limitations.md",
                  [](const Passage& p, const Parameters& in) {
                    return in.k_r * p.path[COMPRESSION_PEAK] / euler_load(in);
                  },
                  Average::over_passages, false},
    ObservableRow{"bending_peak", "largest angle between the bristle and the undeformed one",
                  R"(\gamma_{\max})", "",
                  [](const Passage& p, const Parameters&) { return angle_of_versed(p.path[BENDING_PEAK]); },
                  Average::over_passages, false},
    ObservableRow{"root_strain", "largest strain by bending at the root of the bristle, as a cantilever",
                  R"(\epsilon_{\mathrm{root}})", "docs/model.md",
                  [](const Passage& p, const Parameters& in) {
                    return root_strain(in, angle_of_versed(p.path[BENDING_PEAK]));
                  },
                  Average::over_passages, false},
    ObservableRow{"tip_travel", "largest distance of the tip from its start along the motion",
                  R"((x - x_0)_{\max})", "Eq. (A2)",
                  [](const Passage& p, const Parameters&) { return p.path[TRAVEL_PEAK]; },
                  Average::over_passages, false, Unpinned::none, &kMetre},
    ObservableRow{"sliding_work",
                  "work of friction on the sliding tip, per bristle and length of the slab's path",
                  R"(W_\mathrm{slide})", "Eq. (5)",
                  [](const Passage& p, const Parameters& in) { return p.path[SLIDING_WORK] / in.L_x; },
                  Average::over_passages, false, Unpinned::none, &kJoulePerMetre},
    ObservableRow{"entry_work", "work of pressing a bristle under the edge, over the slab's length",
                  R"(E_0/\tilde{L}_x)", "docs/model.md",
                  [](const Passage& p, const Parameters& in) { return p.entry_energy / in.L_x; },
                  Average::over_passages, false, Unpinned::none, &kNewton},
    ObservableRow{
        "untouched_fraction", "fraction of the bristles that the slab does not touch",
        R"(f_\mathrm{untouched})", "",
        [](const Passage& p,
           const Parameters&) { return p.path[OFF_SLAB_TIME] < (1 - 1e-9) * p.contact_time ? 0.0 : 1.0; },
        Average::over_passages, false},
};

// Index of an observable: a row of kObservables, a contribution by outcome, or WEIGHT.
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
                            ENERGY_RESIDUAL = observable("energy_residual"),
                            IMPACT_COUNT = observable("impacts");

// Returns the number of contributions by outcome: of the bristles that are not pinned or, with pinned_too, of
// the pinned ones.
constexpr std::size_t count_unpinned(bool pinned_too) {
  std::size_t count = 0;
  for (const ObservableRow& row : kObservables)
    count += pinned_too ? row.unpinned == Unpinned::contribution : row.unpinned != Unpinned::none;
  return count;
}
// Returns the index of a contribution by outcome to the row k. The indices follow the rows of kObservables:
// first the contributions of the bristles that are not pinned, then of the pinned ones, for the rows that
// have them.
constexpr Observable split_index(Observable k, bool pinned) {
  Observable index = kObservables.size() + (pinned ? count_unpinned(false) : 0);
  for (Observable i = 0; i < k; ++i)
    index += pinned ? kObservables[i].unpinned == Unpinned::contribution
                    : kObservables[i].unpinned != Unpinned::none;
  return index;
}
// Returns the index of the contribution of the unpinned bristles to the row k, which must have one.
constexpr Observable unpinned(Observable k) { return split_index(k, false); }
// Returns the index of the contribution of the pinned bristles to the row k, which must have one.
constexpr Observable pinned(Observable k) { return split_index(k, true); }

// Integral of the density of theta_0: 1 up to the error of the quadrature.
inline constexpr Observable WEIGHT = kObservables.size() + count_unpinned(false) + count_unpinned(true);
inline constexpr std::size_t OBSERVABLES = WEIGHT + 1;
using ObservableArray = std::array<double, OBSERVABLES>;

// Returns the contribution of one passage to the means.
ObservableArray observables(const Passage& passage, const Parameters& parameters);
// Sets the contributions of pinned and unpinned bristles from the contribution of a passage with this
// outcome.
void split_by_outcome(ObservableArray& contribution, Outcome outcome);

}  // namespace bristle
