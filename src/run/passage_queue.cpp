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
  request.key_ = memo_ ? memo_->key_of(tasks, engine_) : RequestKey();
  const std::lock_guard lock(mutex_);
  if (!request.key_.empty() && comes_without_chunks(request)) return;
  for (std::size_t first = 0; first < tasks.size(); first += size)
    chunks_.push_back({&tasks, first, std::min(first + size, tasks.size()), &request});
  changed_.notify_all();
}

// Returns whether the passages need not be computed for this request: the memo has them, and they are
// delivered, or they are delivered when they have been computed for another request.
bool PassageQueue::comes_without_chunks(PassageRequest& request) {
  if (auto known = memo_->find(request.key_)) {
    request.deliver_all(*std::move(known));
    return true;
  }
  const auto [others, is_new] = in_flight_.try_emplace(request.key_);
  if (!is_new) others->second.push_back(&request);
  return !is_new;
}

void PassageQueue::deliver(PassageRequest& request, std::size_t index, Passage&& passage) {
  if (!request.deliver(index, std::move(passage))) return;
  if (!request.key_.empty()) {
    memo_->store(request.key_, request.passages_);
    std::vector<PassageRequest*> others;
    {
      const std::lock_guard lock(mutex_);
      others = std::move(in_flight_.extract(request.key_).mapped());
    }
    for (PassageRequest* const other : others) other->deliver_all(request.passages_);
  }
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
