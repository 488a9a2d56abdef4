#pragma once

#include "bristle/model/parameters.hpp"

#include <vector>

namespace bristle {

// The modulation of a friction law as a piecewise polynomial, for engines that need it and its slope quickly.
// modulation(u) = t q(t) with t = u/(1 + u) and u = V_R/V_scale, and q is a cubic in each of many equal
// intervals of t. The number of intervals is chosen so that the absolute error of q is below
// kModulationError, or its relative error below 1e-12. A table serves bristles of any V_scale.
constexpr double kModulationError = 1e-10;
constexpr int kFewestIntervals = 64, kMostIntervals = 1 << 16;

class ModulationTable {
 public:
  // Builds the table of a law. Throws std::runtime_error if the law's modulation is too steep for the largest
  // number of intervals. For the law "custom", copies the table in constants.
  ModulationTable(FrictionLaw law, const FrictionConstants<double>& constants);
  // Makes a table that defines a law, for any V_scale. coefficients has four coefficients for each interval,
  // in the order of coefficients(), and four for one more interval, which begins at t = 1.
  ModulationTable(double V_scale, std::vector<double> coefficients);

  // Returns V_scale of a law that is defined by its table, in the unit of the speeds of the law.
  double V_scale() const { return V_scale_; }
  double intervals() const { return intervals_; }
  // Returns four coefficients per interval, in ascending powers of the position in the interval, from 0 to 1.
  const double* coefficients() const { return coefficients_.data(); }

  double at(double u) const;     // returns the modulation
  double slope(double u) const;  // returns the derivative of the modulation by u

  bool serves(FrictionLaw law, const FrictionConstants<double>& constants) const {
    return law == law_ && constants == constants_;
  }

 private:
  // A place in the table: t, the position in its interval, and the coefficients of q there.
  struct Entry {
    double t, position;
    const double* c;
  };
  Entry entry(double u) const;
  double exact(double t) const;
  bool build(int intervals);

  FrictionLaw law_{};
  FrictionConstants<double> constants_;
  double V_scale_ = 1, intervals_ = 0;
  std::vector<double> coefficients_;
};

}  // namespace bristle
