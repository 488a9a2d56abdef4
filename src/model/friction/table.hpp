#pragma once

#include "model/parameters.hpp"

#include <vector>

namespace bristle {

// The modulation of a friction law as a piecewise polynomial, for engines that need it and its slope quickly.
// modulation(V_R) = t q(t) with t = V_R/(V_R + V_s), and q is a cubic in each of equal intervals of t. The
// absolute error of q is below kModulationError, or its relative error below 1e-12; the number of intervals
// follows from it.
constexpr double kModulationError = 1e-10;
constexpr int kFewestIntervals = 64, kMostIntervals = 1 << 16;

class ModulationTable {
 public:
  // Throws std::runtime_error if the law's modulation is too steep for the largest number of intervals.
  ModulationTable(FrictionLaw law, const FrictionConstants<double>& constants, double V_s);
  // The table of the law "custom" for passages with these constants, whose speeds are in units of V0.
  explicit ModulationTable(const FrictionConstants<double>& custom);
  // A law that is defined by its table, with t = V_R/(V_R + V_s) for any V_s. coefficients: as coefficients(), of
  // the intervals and of one more, which begins at t = 1.
  ModulationTable(double V_s, std::vector<double> coefficients);

  double V_s() const { return V_s_; }
  double intervals() const { return intervals_; }
  // Four coefficients per interval, in ascending powers of the position in the interval, from 0 to 1.
  const double* coefficients() const { return coefficients_.data(); }

  double at(double V_R) const;     // the modulation
  double slope(double V_R) const;  // its derivative by V_R

  bool serves(FrictionLaw law, const FrictionConstants<double>& constants, double V_s) const {
    return law == law_ && constants == constants_ && (constants.table || V_s == V_s_);
  }

 private:
  // A place in the table: t, the position u in its interval, and the coefficients of q there.
  struct Entry {
    double t, u;
    const double* c;
  };
  Entry entry(double V_R) const;
  double exact(double t) const;
  bool build(int intervals);

  FrictionLaw law_{};
  FrictionConstants<double> constants_;
  double V_s_, intervals_ = 0;
  std::vector<double> coefficients_;
};

}  // namespace bristle
