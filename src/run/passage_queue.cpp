#include "run/passage_queue.hpp"

#include "bristle/simd/block.hpp"

#include <algorithm>
#include <chrono>

namespace bristle::run {
namespace {

constexpr std::size_t kMaxChunk = 64;
// Number of passages with which a thread keeps its lanes full, both for passages far from the pole and for
// passages near it.
constexpr std::size_t kEnough = 128;
// Time after which a waiting thread checks whether the sweep has been stopped.
constexpr std::chrono::milliseconds kMoment(100);

// Returns the number of passages in each chunk of a request of `tasks` passages: whole sets of lanes.
std::size_t chunk_size(std::size_t tasks, std::size_t threads) {
  constexpr std::size_t lanes = kLanes;
  const std::size_t share = (tasks + threads - 1) / threads;
  return std::min(kMaxChunk, (share + lanes - 1) / lanes * lanes);
}

}  // namespace

void PassageQueue::add(const std::vector<PassageTask>& tasks, PassageRequest& request) {
  const std::size_t size = chunk_size(tasks.size(), threads_);
  const std::lock_guard lock(mutex_);
  for (std::size_t first = 0; first < tasks.size(); first += size)
    chunks_.push_back({&tasks, first, std::min(first + size, tasks.size()), &request});
  changed_.notify_all();
}

void PassageQueue::deliver(PassageRequest& request, std::size_t index, Passage&& passage) {
  if (!request.deliver(index, std::move(passage))) return;
  request.set_complete();
  notify();
}

std::optional<PassageChunk> PassageQueue::take(std::size_t passages) {
  const std::lock_guard lock(mutex_);
  if (chunks_.empty() || passages >= (waiting_ > 0 ? 1 : kEnough)) return {};
  const PassageChunk chunk = chunks_.front();
  chunks_.pop_front();
  return chunk;
}

void PassageQueue::wait(const std::function<bool()>& done) {
  std::unique_lock lock(mutex_);
  ++waiting_;
  changed_.wait_for(lock, kMoment, [&] { return !chunks_.empty() || done(); });
  --waiting_;
}

void PassageQueue::notify() {
  const std::lock_guard lock(mutex_);
  changed_.notify_all();
}

}  // namespace bristle::run
