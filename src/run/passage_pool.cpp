#include "run/passage_pool.hpp"

#include "simd/block.hpp"

#include <algorithm>
#include <chrono>

namespace bristle::run {
namespace {

constexpr std::size_t kMaxChunk = 64;
// Passages with which a thread keeps its lanes full, those far from the pole as well as those near it.
constexpr std::size_t kEnough = 128;
// After which a waiting thread looks whether the sweep has been stopped.
constexpr std::chrono::milliseconds kMoment(100);

}  // namespace

std::size_t PassagePool::chunk_size(std::size_t tasks) const {
  const std::size_t share = (tasks + threads_ - 1) / threads_;
  return std::min(kMaxChunk, (share + std::size_t(kLanes) - 1) / std::size_t(kLanes) * std::size_t(kLanes));
}

void PassagePool::share(const std::vector<PassageTask>& tasks, std::size_t first, PassageRequest& request) {
  const std::size_t size = chunk_size(tasks.size());
  const std::lock_guard lock(mutex_);
  for (; first < tasks.size(); first += size)
    chunks_.push_back({&tasks, first, std::min(first + size, tasks.size()), &request});
  changed_.notify_all();
}

std::optional<PassageChunk> PassagePool::take(std::size_t passages) {
  const std::lock_guard lock(mutex_);
  if (chunks_.empty() || passages >= (waiting_ > 0 ? 1 : kEnough)) return {};
  const PassageChunk chunk = chunks_.front();
  chunks_.pop_front();
  return chunk;
}

void PassagePool::join() {
  const std::lock_guard lock(mutex_);
  ++solving_;
}

void PassagePool::leave() {
  const std::lock_guard lock(mutex_);
  if (--solving_ == 0) changed_.notify_all();
}

bool PassagePool::wait(const std::function<bool()>& done) {
  std::unique_lock lock(mutex_);
  ++waiting_;
  changed_.wait_for(lock, kMoment, [&] { return !chunks_.empty() || solving_ == 0 || done(); });
  --waiting_;
  return solving_ > 0;
}

void PassagePool::notify() {
  const std::lock_guard lock(mutex_);
  changed_.notify_all();
}

void PassagePool::keep(std::shared_ptr<void> object) {
  const std::lock_guard lock(mutex_);
  kept_.push_back(std::move(object));
}

}  // namespace bristle::run
