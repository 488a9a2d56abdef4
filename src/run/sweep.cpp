#include "run/sweep.hpp"

#include "run/worker.hpp"
#include "util/error.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <map>
#include <mutex>
#include <new>
#include <set>
#include <system_error>
#include <thread>
#include <utility>

namespace bristle::run {
namespace {

using Clock = std::chrono::steady_clock;
constexpr double kSlowSeconds = 60, kSlowFactor = 10;

// Distributes the points in their order and passes the reports to the sink, one at a time.
class SweepQueue : public PointQueue {
 public:
  using Sink = std::function<void(PointReport&&)>;
  SweepQueue(const std::vector<std::size_t>& points, const Sink& sink, const std::function<bool()>& stop,
             const SweepObserver& observer)
      : points_(points), sink_(sink), stop_(stop), observer_(observer) {}

  std::optional<std::size_t> next() override {
    const std::lock_guard lock(mutex_);
    if (update_stopped() || started_ == points_.size()) return {};
    active_[points_[started_]] = Clock::now();
    return points_[started_++];
  }

  bool all_started() override {
    const std::lock_guard lock(mutex_);
    return started_ == points_.size();
  }

  void deliver(PointReport&& report) override {
    const std::lock_guard lock(mutex_);
    if (error_) return;
    active_.erase(report.index);
    sink_(std::move(report));
    ++delivered_;
  }

  bool stopped(std::size_t passages) override {
    const std::lock_guard lock(mutex_);
    observer_.passages(passages);
    report_slow_points();
    return update_stopped();
  }

  // Ends the sweep on all threads; complete() then throws the error.
  void fail(std::exception_ptr error) {
    const std::lock_guard lock(mutex_);
    if (!error_) error_ = std::move(error);
  }

  bool complete() const {
    if (error_) std::rethrow_exception(error_);
    return delivered_ == points_.size();
  }

 private:
  // Reports each active point once that has taken longer than a minute and ten times the mean of the others.
  void report_slow_points() {
    const auto seconds_since = [now = Clock::now()](Clock::time_point then) {
      return std::chrono::duration<double>(now - then).count();
    };
    const double mean =
        seconds_since(begin_) * double(most_active_) / double(std::max<std::size_t>(1, delivered_));
    most_active_ = std::max(most_active_, active_.size());
    for (const auto& [index, start] : active_)
      if (const double seconds = seconds_since(start); seconds > kSlowSeconds &&
                                                       (delivered_ == 0 || seconds > kSlowFactor * mean) &&
                                                       named_.insert(index).second)
        observer_.slow(index, seconds);
  }

  bool update_stopped() { return stopped_ = stopped_ || error_ || stop_(); }

  const std::vector<std::size_t>& points_;
  const Sink& sink_;
  const std::function<bool()>& stop_;
  std::mutex mutex_;
  std::size_t started_ = 0, delivered_ = 0;
  bool stopped_ = false;
  std::exception_ptr error_;
  const SweepObserver& observer_;
  const Clock::time_point begin_ = Clock::now();
  std::map<std::size_t, Clock::time_point> active_;  // points by index, with their start
  std::size_t most_active_ = 1;                      // at the same time
  std::set<std::size_t> named_;                      // slow points that have been reported
};

}  // namespace

int all_cores() { return int(std::max(1u, std::thread::hardware_concurrency())); }

bool run_sweep(const Experiment& experiment, const std::vector<std::size_t>& points, int threads,
               const std::function<void(PointReport&&)>& sink, const std::function<bool()>& stop,
               const SweepObserver& observer) {
  SweepQueue queue(points, sink, stop, observer);
  PassagePool pool(threads);
  const std::size_t share = (points.size() + std::size_t(threads) - 1) / std::size_t(threads);
  const auto run_thread = [&] {
    try {
      run_worker(experiment, queue, pool, share);
    } catch (const std::bad_alloc&) {
      queue.fail(std::make_exception_ptr(
          RunError(fmt::format("not enough memory for {} threads; give fewer with --threads", threads))));
    } catch (...) {
      queue.fail(std::current_exception());
    }
  };
  std::vector<std::thread> workers;
  workers.reserve(std::size_t(threads));
  try {
    for (int i = 1; i < threads; ++i) workers.emplace_back(run_thread);
  } catch (const std::system_error& e) {  // the numbers do not depend on how many there are
    fmt::print(stderr, "bristle: {} of {} threads could be started: {}\n", workers.size() + 1, threads,
               e.what());
  }
  run_thread();
  for (std::thread& worker : workers) worker.join();
  return queue.complete();
}

}  // namespace bristle::run
