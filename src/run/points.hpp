#pragma once

#include "results/journal.hpp"

#include <string>
#include <vector>

namespace bristle::run {

// Points of an experiment and their keys in journals.
class KeyedPoints {
 public:
  // Computes the keys of the points. points: in ascending order
  KeyedPoints(const Sweep& sweep, std::vector<std::size_t> points);
  const std::vector<std::size_t>& points() const { return points_; }
  const std::string& key(std::size_t point) const;
  const results::Layout& layout() const { return layout_; }

  std::vector<std::size_t> missing_in(const results::Journal& journal) const;
  // Returns the points that no journal in the folder of the result has.
  std::vector<std::size_t> missing_beside(const std::string& result) const;
  // Copies points that this journal lacks from the other journals in its folder. Throws InputError if two
  // journals have a point with different numbers.
  void adopt_into(results::Journal& journal) const;

 private:
  const Sweep& sweep_;
  const results::Layout layout_;
  std::vector<std::size_t> points_;  // ascending
  std::vector<std::string> keys_;
};

// Throws InputError if points are missing. The message names the points, their shards, the command that
// computes them, and the journals of shards that have no point of the experiment. arguments: of the command
// line of this run, from which the command is made
void require_complete(const Sweep& sweep, const std::vector<std::size_t>& missing, const std::string& result,
                      const std::vector<std::string>& arguments);

// Returns the command of a run with `option` in place of --shard, --complete and --force. arguments: of the
// run's command line
std::string command_with(const std::vector<std::string>& arguments, const std::string& option);

}  // namespace bristle::run
