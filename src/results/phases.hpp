#pragma once

#include "bristle/ensemble/phase.hpp"
#include "bristle/model/lift_off.hpp"
#include "sweep/sweep.hpp"

#include <array>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace bristle::results {

// Returns what messages call a phase: "in contact", "bouncing" or "between contact and bouncing".
std::string name_of(BrushPhase phase);

// Returns a dimensionless load R_n/N_c0 in words: in newtons if the point has SI units, else "R_n = 2".
std::string load_text(const sweep::PointInput& point, double R_n);
// Returns how much the brush of an unreachable point carries: the greatest load R_n at the gap z_0 (both
// dimensionless; NaN: unknown), beside the load of the point `asked`, in newtons and metres if it has them.
std::string carried_text(const sweep::PointInput& asked, double R_n, double z_0);

// Counts what brushes do, contact or bouncing, and compares their loads with lift-off loads, and their
// friction with the friction of rigid bristles (docs/lift-off.md).
class Phases {
 public:
  // Adds points. variable returns the values of a variable at these points; empty if the result lacks the
  // variable.
  void add(const std::function<std::vector<double>(const std::string&)>& variable);
  // Returns lines for the terminal that say what there is to control, how many points are in which phase,
  // where lift-off is expected, and why the formula of lift-off says nothing at some points; empty if no
  // point has a known phase.
  std::string text() const;

 private:
  // Smallest and largest value.
  struct Range {
    double from = INFINITY, to = -INFINITY;
    void add(double value);
    std::string text() const;
  };
  std::string friction_text() const;
  std::string lift_off_text() const;

  static constexpr std::size_t kPhases = 4;
  std::array<std::size_t, kPhases> points_{}, tested_{};   // number by phase; tested: where lift-off is known
  std::size_t bouncing_below_ = 0, in_contact_above_ = 0;  // numbers of tested points
  std::map<LiftOffDomain, std::size_t> outside_;
  Range local_friction_;  // R_rigid/R_n
  Range R_x_norm_;
  Range lift_off_, lift_off_in_N_;
};

}  // namespace bristle::results
