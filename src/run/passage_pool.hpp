#pragma once

#include "dynamics/passage.hpp"

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>

namespace bristle::run {

// The passages that one point waits for. Any threads deliver them, each once; the thread of the point takes
// them when all have been delivered.
class PassageRequest {
 public:
  void expect(std::size_t count) {
    passages_.assign(count, {});
    outstanding_ = count;
  }
  bool complete() const { return outstanding_.load(std::memory_order_acquire) == 0; }
  // Returns true for the last passage. The request may have ended its life when this returns.
  bool deliver(std::size_t index, Passage&& passage) {
    passages_[index] = std::move(passage);
    return outstanding_.fetch_sub(1, std::memory_order_acq_rel) == 1;
  }
  std::vector<Passage> take() { return std::move(passages_); }

 private:
  std::vector<Passage> passages_;
  std::atomic<std::size_t> outstanding_ = 0;
};

// Some of the passages of a request, to be computed by one thread.
struct PassageChunk {
  const std::vector<PassageTask>* tasks;
  std::size_t first, last;  // without last
  PassageRequest* request;
};

// Passages that the threads of a sweep share once there are fewer points than keep all threads busy. All
// functions may be called from several threads.
class PassagePool {
 public:
  explicit PassagePool(int threads) : threads_(std::size_t(threads)) {}
  std::size_t threads() const { return threads_; }

  // Number of passages in each chunk of a request of this size: whole sets of lanes.
  std::size_t chunk_size(std::size_t tasks) const;
  // Offers the passages from first on to all threads.
  void share(const std::vector<PassageTask>& tasks, std::size_t first, PassageRequest& request);
  // The next chunk for a thread that has this many passages. None if it has enough, or if it has any while
  // another thread has none.
  std::optional<PassageChunk> take(std::size_t passages);

  // A thread joins before it starts its first point, and leaves when it has solved its last one.
  void join();
  void leave();
  // Waits until there is a chunk, a request for which done() holds, or no thread with points; or for a
  // moment. Returns false if no thread has points.
  bool wait(const std::function<bool()>& done);
  // To be called when a passage completed a request.
  void notify();
  // Keeps what shared requests refer to until the end of the pool, because a thread that stops early does not
  // wait for those that compute its passages.
  void keep(std::shared_ptr<void> object);

 private:
  const std::size_t threads_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<PassageChunk> chunks_;
  std::size_t solving_ = 0;  // threads with points
  std::size_t waiting_ = 0;  // threads without passages
  std::vector<std::shared_ptr<void>> kept_;
};

}  // namespace bristle::run
