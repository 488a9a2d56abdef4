#include "run/sweep.hpp"

#include "run/worker.hpp"

#include <condition_variable>
#include <exception>
#include <map>
#include <mutex>
#include <thread>

namespace bristle {
namespace {

// Points differ in cost by more than ten: this many may be ahead of the first that is not done.
constexpr std::size_t kAhead = 512;

// Hands out the points in ascending order and gives the reports on in that order.
class Points : public PointQueue {
 public:
  Points(std::size_t count, const std::function<void(PointReport&&)>& sink, const std::function<bool()>& stop)
      : count_(count), sink_(sink), stop_(stop) {}

  std::optional<std::size_t> next(bool wait) override {
    std::unique_lock lock(mutex_);
    const auto may_go = [this] { return ended() || started_ < delivered_ + kAhead; };
    if (wait) changed_.wait(lock, may_go);
    if (ended() || !may_go()) return {};
    return started_++;
  }

  void deliver(PointReport&& report) override {
    const std::lock_guard lock(mutex_);
    const std::size_t index = report.index;
    early_.emplace(index, std::move(report));
    while (!early_.empty() && early_.begin()->first == delivered_) {
      sink_(std::move(early_.begin()->second));
      early_.erase(early_.begin());
      ++delivered_;
    }
    changed_.notify_all();
  }

  bool stopped() override {
    const std::lock_guard lock(mutex_);
    return halted();
  }

  // A thread that goes may have been the one that others wait for.
  void leave() {
    const std::lock_guard lock(mutex_);
    changed_.notify_all();
  }

  // Ends the sweep for all threads.
  void fail(std::exception_ptr error) {
    const std::lock_guard lock(mutex_);
    if (!error_) error_ = error;
  }

  bool complete() const {
    if (error_) std::rethrow_exception(error_);
    return delivered_ == count_;
  }

 private:
  bool halted() { return stopped_ = stopped_ || error_ || stop_(); }
  bool ended() { return halted() || started_ == count_; }

  const std::size_t count_;
  const std::function<void(PointReport&&)>& sink_;
  const std::function<bool()>& stop_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::map<std::size_t, PointReport> early_;
  std::size_t started_ = 0, delivered_ = 0;
  bool stopped_ = false;
  std::exception_ptr error_;
};

}  // namespace

bool run_sweep(const Experiment& experiment, int threads, const std::function<void(PointReport&&)>& sink,
               const std::function<bool()>& stop) {
  Points points(experiment.points(), sink, stop);
  const std::size_t share = (experiment.points() + std::size_t(threads) - 1) / std::size_t(threads);
  const auto work = [&] {
    try {
      bristle::work(experiment, points, share);
    } catch (...) {
      points.fail(std::current_exception());
    }
    points.leave();
  };
  std::vector<std::thread> workers;
  for (int i = 1; i < threads; ++i) workers.emplace_back(work);
  work();
  for (std::thread& worker : workers) worker.join();
  return points.complete();
}

}  // namespace bristle
