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

// Number of points with each status, which points have no values and why, and where pinned bristles carry
// much of the friction, for the messages after a run.
class Summary {
 public:
  // path: of the result, for messages
  Summary(const Experiment& experiment, std::string path) : experiment_(experiment), path_(std::move(path)) {}
  void add(const results::PointRecord& record, std::size_t index);
  void add(const std::string& analysis) { analysis_ += analysis; }
  const std::string& analysis() const { return analysis_; }  // of a sample, in lines
  // The numbers of points by status.
  std::string text() const;
  // What the brushes do, in lines, see results::Phases.
  std::string phases() const { return phases_.text(); }
  // Names the failed points on standard error. Throws RunError if there are no others.
  void report_failures() const;
  // For each status of points without values: an example, the cause and the remedy, on standard error.
  void report_points_without_values() const;
  // If pinned bristles carry more than a tenth of R_x anywhere: at how many points, on standard error.
  void report_pinned_bristles() const;
  // At how many points the model is beyond each of its limits, on standard error.
  void report_validity() const;

 private:
  struct Example {
    std::size_t index;
    double incomplete_theta_0;  // rad
  };
  std::string cause_and_remedy(PointStatus status, const Example& example) const;

  const Experiment& experiment_;
  std::string path_, analysis_;
  std::vector<long> counts_ = std::vector<long>(words<PointStatus>().size(), 0);
  std::size_t points_ = 0;
  std::vector<std::string> failures_;
  std::map<PointStatus, Example> first_;  // of each status without values
  results::Phases phases_;                // of all points and nodes
  std::size_t pinned_ = 0;                // points at which pinned bristles carry more than a tenth of R_x
  double largest_pinned_share_ = 0;
  std::array<std::size_t, kValidity.size()> exceeding_{};  // number of points
};

}  // namespace bristle::run
