#pragma once

#include "bristle/dynamics/passage.hpp"
#include "sweep/sweep.hpp"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace bristle::run {

// Bound of the memory of a memo's passages, some 150,000. A point takes about 700 of them, and a thread
// solves 24 points at a time. The points of one brush are solved one after the other, so that a memo which is
// full has forgotten passages of other brushes; with ten threads or more, also of brushes that are still
// being solved. More memory takes more time to fill than it saves. The names of shared brushes come in
// addition, some 300 bytes each.
constexpr std::size_t kMemoBytes = std::size_t(64) << 20;

// All that the results of the passages of one request depend on, bit for bit: of each task the number of
// its brush and its own numbers. Empty if the passages are not to be remembered.
using RequestKey = std::vector<std::uint64_t>;
struct RequestKeyHash {
  std::size_t operator()(const RequestKey& key) const;
};

// Remembers the passages of brushes that several points of a run share, such as points that differ in the
// load or the path alone. Passages are remembered by request, because points that ask for one passage of a
// gap ask for all others of their request, too. The passages depend on the key of the request only, so that
// no number depends on what a memo holds. A full memo forgets the requests that have been used least
// recently.
class PassageMemo {
 public:
  // Creates an empty memo. A memo of 0 bytes remembers nothing.
  explicit PassageMemo(std::size_t bytes = kMemoBytes);
  ~PassageMemo();

  // Finds the brushes that at least two of these points have: from now on, their passages are remembered.
  // Points at given gaps share passages only if their gaps are equal. Returns the points, with the points of
  // one brush one after the other. Call it while no other thread uses the memo.
  std::vector<std::size_t> share(const Sweep& sweep, const std::vector<std::size_t>& points);

  // Returns the key of a request; an empty one if its passages are not to be remembered.
  RequestKey key_of(const std::vector<PassageTask>& tasks, Engine engine) const;

  // Returns the passages of a request if the memo has them. Several threads may call this function and the
  // following ones.
  std::optional<std::vector<Passage>> find(const RequestKey& key);
  void store(const RequestKey& key, const std::vector<Passage>& passages);
  // Returns the passages of the tasks. Lets `compute` compute them if the memo does not have them.
  std::vector<Passage> run(const std::vector<PassageTask>& tasks, Engine engine,
                           const PassageRunner& compute);
  std::size_t size() const;  // number of remembered passages

 private:
  struct Store;

  const std::size_t most_;                        // greatest number of bytes
  std::map<std::string, std::uint64_t> brushes_;  // shared brushes, and their numbers in keys
  // Laws of brushes, which are told apart by the addresses of their tables.
  std::vector<std::shared_ptr<const ModulationTable>> laws_;
  std::unique_ptr<Store> store_;
};

}  // namespace bristle::run
