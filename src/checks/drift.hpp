#pragma once

#include "checks/reference.hpp"

namespace bristle {

// A value that is not what the reference says.
struct Drift {
  std::string variable;
  std::size_t point;      // index in the file
  double reference, now;  // NaN: no value; for flags the codes
  double units;  // of the tolerance; infinite for flags, and where one side has no value or no tolerance
};

struct DriftReport {
  std::vector<std::string> notes;     // what a reader should know, no failure
  std::vector<std::string> failures;  // what has no place and no size: variables, axes, verdicts
  std::vector<Drift> drifts;          // worst first
  std::size_t points = 0, points_in_file = 0, values = 0;  // compared

  std::size_t above(double units) const;  // drifts beyond so many tolerances
  bool failed() const { return !failures.empty() || above(1) > 0; }
};

// now is what was computed; it may hold more points. Every NaN, infinity, variable, shape, flag or verdict
// that is not the reference's is a failure; numbers may differ by the reference's tolerance.
DriftReport drift(const Reference& reference, const Reference& now);

// For people: the worst five drifts, and those above half a tolerance as far as they are not too many, with
// the commands that compute their points again.
std::string drift_text(const DriftReport& report, const ResultReader& result, const std::string& reference);

// For programs: the counts, the worst five, failures and notes.
Json drift_json(const DriftReport& report, const ResultReader& result, const std::string& reference);

// How many points the result's sweep has; a traced curve is one.
std::size_t sweep_points(const ResultReader& result);

// The command that computes one point of a result anew, alone, to the same bits.
std::string replay_command(const ResultReader& result, std::size_t point);

// That of every point of the sweep, the last axis fastest.
Json replay_json(const ResultReader& result);

}  // namespace bristle
