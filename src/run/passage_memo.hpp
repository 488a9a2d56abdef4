#pragma once

#include "bristle/dynamics/passage.hpp"
#include "sweep/sweep.hpp"

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace bristle::run {

// Bound of a memo's memory: some 600,000 passages. A point takes about 700 of them, a thread solves 24 points
// at a time, and the points of one brush are solved one after the other: this is enough for 36 threads whose
// points have nothing in common, and more of them only compute some passages again.
constexpr std::size_t kMemoBytes = std::size_t(256) << 20;

// All that the result of a passage depends on, bit for bit: the number of its brush, and the numbers of its
// task.
using PassageKey = std::array<std::uint64_t, 9>;
struct PassageKeyHash {
  std::size_t operator()(const PassageKey& key) const;
};

// Remembers the passages of brushes that several points of a run share, such as points that differ in the
// load or the path alone. The result of a passage depends on its key only, so that no number depends on what
// a memo holds. A full memo forgets the passages that have been used least recently.
class PassageMemo {
 public:
  // Creates an empty memo. A memo of 0 bytes remembers nothing.
  explicit PassageMemo(std::size_t bytes = kMemoBytes);
  ~PassageMemo();

  // Finds the brushes that at least two of these points have: from now on, their passages are remembered.
  // Points at given gaps share passages only if their gaps are equal. Returns the points, with the points of
  // one brush one after the other. Call it while no other thread uses the memo.
  std::vector<std::size_t> share(const Sweep& sweep, const std::vector<std::size_t>& points);

  // Returns the keys of the passages of one request; none if they are not to be remembered.
  std::vector<PassageKey> keys_of(const std::vector<PassageTask>& tasks, Engine engine) const;

  // Returns the passage if the memo has it. Several threads may call this function and the following ones.
  std::optional<Passage> find(const PassageKey& key);
  void store(const PassageKey& key, const Passage& passage);
  // Returns the passages of the tasks. Lets `compute` compute the passages that the memo does not have.
  std::vector<Passage> run(const std::vector<PassageTask>& tasks, Engine engine,
                           const PassageRunner& compute);
  std::size_t size() const;  // number of remembered passages

 private:
  struct Store;

  const std::size_t most_;                        // greatest number of passages
  std::map<std::string, std::uint64_t> brushes_;  // shared brushes, and their numbers in keys
  // Laws of brushes, which are told apart by the addresses of their tables.
  std::vector<std::shared_ptr<const ModulationTable>> laws_;
  std::unique_ptr<Store> store_;
};

}  // namespace bristle::run
