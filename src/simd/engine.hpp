#pragma once

#include "simd/kernels.hpp"
#include "dynamics/passage.hpp"

#include <deque>
#include <functional>
#include <memory>
#include <vector>

namespace bristle {

// Integrates passages one per lane, as the queue gives them: a lane that is done takes the next at once.
// Stiff bristles go on to a second set of lanes and an implicit method. A passage's numbers do not depend on
// what else is under way, on the lane or on the instruction set. One engine per thread.
class LaneEngine {
 public:
  using Done = std::function<void(std::size_t ticket, Passage&&)>;

  // kernels: see select_kernels(). done is called from advance() for each passage that ended.
  LaneEngine(const Kernels& kernels, Done done);
  ~LaneEngine();

  void submit(const PassageTask& task, std::size_t ticket);
  // Steps until at least one passage has ended; false if there is none.
  bool advance();

  // Steps that the lanes tried, and those of passages that have ended or changed their method: the rest had
  // none.
  struct Usage {
    double made = 0, useful = 0;
  };
  Usage usage() const;

 private:
  class Set;

  Set& set_for(const PassageTask& task, bool implicit);

  const Kernels& kernels_;
  Done done_;
  std::vector<std::unique_ptr<Set>> sets_;
  double useful_ = 0;
  std::size_t ended_ = 0;  // in this advance()
};

}  // namespace bristle
