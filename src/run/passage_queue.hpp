#pragma once

#include "bristle/dynamics/passage.hpp"

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
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

// The passages that the points of a sweep wait for, for all threads. All functions may be called from several
// threads.
class PassageQueue {
 public:
  explicit PassageQueue(std::size_t threads) : threads_(threads) {}

  // Both must live until the request is complete or no thread takes chunks any more.
  void add(const std::vector<PassageTask>& tasks, PassageRequest& request);
  // The next chunk for a thread that has this many passages. None if it has enough, or if it has any while
  // another thread has none.
  std::optional<PassageChunk> take(std::size_t passages);
  // Waits until there is a chunk, or done() holds; or for a moment.
  void wait(const std::function<bool()>& done);
  // To be called when what done() depends on has changed: a passage completed a request, for example.
  void notify();

 private:
  const std::size_t threads_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<PassageChunk> chunks_;
  std::size_t waiting_ = 0;  // threads without passages
};

}  // namespace bristle::run
