#pragma once

#include "results/journal.hpp"

#include <string>
#include <vector>

namespace bristle::run {

// Points of an experiment and their keys in journals.
class KeyedPoints {
 public:
  // points: ascending
  KeyedPoints(const Sweep& sweep, std::vector<std::size_t> points);
  const std::vector<std::size_t>& points() const { return points_; }
  const std::string& key(std::size_t point) const;
  const results::Layout& layout() const { return layout_; }

  std::vector<std::size_t> missing_in(const results::Journal& journal) const;
  // The points that no journal in the folder of the result has.
  std::vector<std::size_t> missing_beside(const std::string& result) const;
  // Copies points that are missing in the journal from the other journals in its folder. Throws InputError if
  // two journals have a point with different numbers.
  void adopt_into(results::Journal& journal) const;

 private:
  const Sweep& sweep_;
  const results::Layout layout_;
  std::vector<std::size_t> points_;  // ascending
  std::vector<std::string> keys_;
};

// Throws InputError if points are missing: which ones, of which shards, and the command that computes them,
// made of that of this run. Names the journals of shards that have no point of the experiment.
void require_complete(const Experiment& experiment, const std::vector<std::size_t>& missing,
                      const std::string& result, const std::vector<std::string>& arguments);

// Returns the command of a run with this option in place of --shard and --complete. arguments: of the run's
// command line
std::string command_with(const std::vector<std::string>& arguments, const std::string& option);

}  // namespace bristle::run
