#pragma once

#include "bristle/dynamics/passage.hpp"
#include "bristle/simd/kernels.hpp"

#include <deque>
#include <functional>
#include <memory>
#include <vector>

namespace bristle {

// Integrates passages, one per SIMD lane. A lane whose passage has ended takes the next one from the queue.
// Bristles near the pole move to a second set of lanes, with other events and tolerances. The numbers of a
// passage do not depend on other passages, on the lane or on the instruction set. One engine per thread.
class SimdEngine {
 public:
  using Done = std::function<void(std::size_t ticket, Passage&&)>;

  // Creates an engine without passages. kernels: see simd/dispatch.hpp. advance() calls done for each passage
  // that ended.
  SimdEngine(const Kernels& kernels, Done done);
  ~SimdEngine();

  void submit(const PassageTask& task, std::size_t ticket);
  // Steps until at least one passage has ended. Returns false if there is no passage.
  bool advance();

  // Utilisation of the lanes: steps attempted in all lanes, including empty ones, and steps of passages that
  // have ended or changed their lane set.
  struct Usage {
    double lane_steps = 0, passage_steps = 0;
  };
  Usage usage() const;

 private:
  class LaneSet;

  LaneSet& lane_set_for(const PassageTask& task, bool near_pole);
  void remove_idle_sets();

  const Kernels& kernels_;
  Done done_;
  std::vector<std::unique_ptr<LaneSet>> sets_;
  double passage_steps_ = 0, lane_steps_ = 0;  // lane_steps_: of the sets that were removed
  std::size_t ended_ = 0;                      // passages that ended during this advance()
};

}  // namespace bristle
