#pragma once

#include "bristle/ensemble/validity.hpp"
#include "experiment/experiment.hpp"
#include "results/phases.hpp"
#include "results/record.hpp"

#include <array>
#include <map>
#include <string>
#include <vector>

namespace bristle::run {

// Collects, for the messages after a run, the number of points with each status, which points have no values
// and why, and where pinned bristles carry much of the friction.
class Summary {
 public:
  // Creates a summary without points. path: the path of the result, for messages
  Summary(const Sweep& sweep, std::string path) : sweep_(sweep), path_(std::move(path)) {}
  void add(const results::PointRecord& record, std::size_t index);
  void add(const std::string& analysis) { analysis_ += analysis; }
  const std::string& analysis() const { return analysis_; }  // lines about a sample
  // Returns the numbers of points by status.
  std::string text() const;
  // Returns lines that say what the brushes do, see results::Phases.
  std::string phases() const { return phases_.text(); }
  // Names the failed points on standard error. Throws RunError if all points failed.
  void report_failures() const;
  // Writes to standard error an example, the cause and the remedy for each status of points without values.
  void report_points_without_values() const;
  // Writes to standard error at how many points pinned bristles carry more than a tenth of R_x, if there are
  // any.
  void report_pinned_bristles() const;
  // Writes to standard error at how many points the model is beyond each of its limits.
  void report_validity() const;

 private:
  struct Example {
    std::size_t index;
    double incomplete_theta_0;  // rad
    double R_n_largest, z_0;    // the greatest load of an unreachable point, and its gap
  };
  // Returns the point with this index as an example, from the values of its record.
  static Example example_of(const results::PointRecord& record, std::size_t index);
  std::string cause_and_remedy(PointStatus status, const Example& example) const;

  const Sweep& sweep_;
  std::string path_, analysis_;
  std::vector<long> counts_ = std::vector<long>(words<PointStatus>().size(), 0);
  std::size_t points_ = 0;
  std::vector<std::string> failures_;
  std::map<PointStatus, Example> first_;  // first point of each status without values
  results::Phases phases_;                // phases of all points
  std::size_t pinned_ = 0;                // points at which pinned bristles carry more than a tenth of R_x
  double largest_pinned_share_ = 0;
  std::size_t judged_ = 0;  // points with a value, to which the limits of the model apply
  std::array<std::size_t, kValidity.size()> exceeding_{};  // number of points beyond each limit
};

}  // namespace bristle::run
