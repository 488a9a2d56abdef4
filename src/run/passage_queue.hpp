#pragma once

#include "bristle/dynamics/passage.hpp"

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>

namespace bristle::run {

// Collects the passages that one point waits for. Any threads deliver the passages, each once; the thread of
// the point takes them when the request is complete.
class PassageRequest {
 public:
  void expect(std::size_t count) {
    passages_.assign(count, {});
    outstanding_ = count;
    complete_ = count == 0;
  }
  bool complete() const { return complete_.load(std::memory_order_acquire); }
  std::vector<Passage> take() { return std::move(passages_); }

 private:
  friend class PassageQueue;

  // Stores a passage. Returns true for the last one, whose thread then calls set_complete().
  bool deliver(std::size_t index, Passage&& passage) {
    passages_[index] = std::move(passage);
    return outstanding_.fetch_sub(1, std::memory_order_acq_rel) == 1;
  }
  // Lets the thread of the point take the passages. The request may have ended its life afterwards.
  void set_complete() { complete_.store(true, std::memory_order_release); }

  std::vector<Passage> passages_;
  std::atomic<std::size_t> outstanding_ = 0;
  std::atomic<bool> complete_ = true;
};

// Some of the passages of a request, to be computed by one thread.
struct PassageChunk {
  const std::vector<PassageTask>* tasks;
  std::size_t first, last;  // first is included, last is not
  PassageRequest* request;
};

// Queues the passages that the points of a sweep wait for, for all threads. All functions may be called from
// several threads.
class PassageQueue {
 public:
  explicit PassageQueue(std::size_t threads) : threads_(threads) {}

  // Adds the passages of a request. tasks and request must live until the request is complete or no thread
  // takes chunks any more.
  void add(const std::vector<PassageTask>& tasks, PassageRequest& request);
  // Delivers a computed passage of a chunk to its request. The last one completes the request.
  void deliver(PassageRequest& request, std::size_t index, Passage&& passage);
  // Returns the next chunk for a thread that has `passages` passages; none if the thread has enough, or if it
  // has any while another thread has none.
  std::optional<PassageChunk> take(std::size_t passages);
  // Waits until there is a chunk or done() holds, but only for a moment.
  void wait(const std::function<bool()>& done);
  // Wakes the waiting threads. Call it when the result of done() may have changed, for example because a
  // passage completed a request.
  void notify();

 private:
  const std::size_t threads_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<PassageChunk> chunks_;
  std::size_t waiting_ = 0;  // threads without passages
};

}  // namespace bristle::run
