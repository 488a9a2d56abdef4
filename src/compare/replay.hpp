#pragma once

#include "results/reader.hpp"
#include "json/json.hpp"

#include <string>

namespace bristle::compare {

// Builds the commands that compute single points of a result again, with the same bits, from the experiment
// that is stored in the result. Reads once what the commands share.
class ReplayCommands {
 public:
  explicit ReplayCommands(const results::ResultReader& result);

  // Returns the command of the point with this index.
  std::string of_point(std::size_t index) const;
  // Returns the commands of all points of the sweep in row-major order, as a JSON array.
  Json of_all_points() const;

 private:
  std::size_t points_ = 0;  // number of points of the sweep
  std::string begin_;       // start of the command, before the number of the point
};

}  // namespace bristle::compare
