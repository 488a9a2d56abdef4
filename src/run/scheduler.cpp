#include "run/scheduler.hpp"

#include "bristle/dynamics/jobs.hpp"
#include "sweep/si.hpp"
#include "bristle/model/error.hpp"
#include "run/passage_queue.hpp"
#include "run/slow_points.hpp"
#include "bristle/simd/dispatch.hpp"
#include "bristle/simd/engine.hpp"
#include "util/error.hpp"
#include "util/text.hpp"
#include "bristle/sanitizer.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <exception>
#include <list>
#include <new>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>

namespace bristle::run {
namespace {

// Points that a thread solves at a time: enough to keep the lanes full while most points wait for the last
// passages of a batch.
constexpr std::size_t kMaxActivePoints = 24;

// A point that is being solved with its own stack, suspended until the passages that it waits for have been
// computed.
struct ActivePoint {
  explicit ActivePoint(const std::function<PointReport(const PassageRunner&)>& solve)
      : solving([this, solve](const PassageRunner& run) { report = solve(run); }) {}
  PointReport report{};
  SuspendedJob solving;
  PassageRequest request;
};

// Computes points of a sweep on several threads: distributes them in their order, and passes the reports to
// the sink, one at a time.
class Scheduler {
 public:
  using Sink = std::function<void(PointReport&&)>;
  Scheduler(const Sweep& sweep, const std::vector<std::size_t>& points, std::size_t threads, const Sink& sink,
            const std::function<bool()>& stop, const SchedulerObserver& observer)
      : sweep_(sweep),
        layout_(results::layout_of(sweep)),
        points_(points),
        threads_(threads),
        sink_(sink),
        stop_(stop),
        observer_(observer),
        passages_(threads) {}

  // Solves points on the calling thread, until all points of the sweep are solved.
  void run_thread();
  // Returns true if all points have been solved. Throws the exception that ended the sweep. Call it when all
  // threads have ended.
  bool complete() const {
    if (error_) std::rethrow_exception(error_);
    return solved();
  }

 private:
  class Worker;

  std::optional<std::size_t> next_point();
  PointReport solve(std::size_t index, const PassageRunner& run) const;
  void solve_sequentially();
  void deliver(PointReport&& report);
  bool ended(std::size_t passages);
  void fail(std::exception_ptr error);
  bool solved() const { return delivered_ == points_.size(); }
  bool update_stopped() { return stopped_ = stopped_ || error_ || stop_(); }

  const Sweep& sweep_;
  const results::Layout layout_;
  const std::vector<std::size_t> points_;
  const std::size_t threads_;
  const Sink& sink_;
  const std::function<bool()>& stop_;
  const SchedulerObserver& observer_;
  PassageQueue passages_;

  std::atomic<std::size_t> delivered_ = 0;
  std::mutex mutex_;  // protects all that follows
  std::size_t started_ = 0;
  bool stopped_ = false;
  std::exception_ptr error_;
  SlowPoints slow_points_{processor_seconds()};
  // Active points of all threads. The lists live as long as the sweep, because a thread that stops early does
  // not wait for other threads that compute passages of its points.
  std::list<std::list<ActivePoint>> suspended_;
};

std::optional<std::size_t> Scheduler::next_point() {
  const std::lock_guard lock(mutex_);
  if (update_stopped() || started_ == points_.size()) return {};
  slow_points_.begin(points_[started_]);
  return points_[started_++];
}

void Scheduler::deliver(PointReport&& report) {
  const std::lock_guard lock(mutex_);
  if (error_) return;
  slow_points_.end(report.index);
  sink_(std::move(report));
  ++delivered_;
  if (solved()) passages_.notify();
}

// Counts passages that have been computed. Returns true if the thread must end.
bool Scheduler::ended(std::size_t passages) {
  const std::lock_guard lock(mutex_);
  observer_.passages(passages);
  for (const auto& [index, seconds] : slow_points_.found_after(processor_seconds()))
    observer_.slow(index, seconds);
  return update_stopped() || solved();
}

// Ends the sweep on all threads.
void Scheduler::fail(std::exception_ptr error) {
  const std::lock_guard lock(mutex_);
  if (!error_) error_ = std::move(error);
}

// Solves a point. An error within the point becomes its status, so that other points are not lost.
PointReport Scheduler::solve(std::size_t index, const PassageRunner& run) const {
  const auto record = [&] {
    const sweep::PointInput input = sweep_.point(index);
    Recorded recorded;
    PointResult result = solve_point(input.setup, input.loading, run, sweep_.record, &recorded);
    result.parameters = input.setup.parameters;
    result.si = sweep::si_scales(input);
    return results::record_of(layout_, result, recorded);
  };
  try {
    return {index, record()};
  } catch (const std::bad_alloc&) {
    throw;  // the other points may be the cause
  } catch (const ModelError& e) {
    return {index, results::failed_record(layout_, e.what())};
  } catch (const std::exception&) {  // the text would come from a library
    return {index,
            results::failed_record(layout_,
                                   "the computation ended by an error of the program: please report it with "
                                   "this experiment; another engine (/integrator/engine) may give values")};
  }
}

// One thread with its SIMD engine. Several points are active at a time: while one point waits for passages,
// the lanes compute passages of other points. Passages wait in one queue for all threads; a thread resumes
// its own points.
class Scheduler::Worker {
 public:
  explicit Worker(Scheduler& scheduler)
      : scheduler_(scheduler),
        max_active_(std::min(kMaxActivePoints,
                             (scheduler.points_.size() + scheduler.threads_ - 1) / scheduler.threads_)),
        engine_(best_kernels(),
                [this](std::size_t ticket, Passage&& passage) { receive(ticket, std::move(passage)); }) {
    const std::lock_guard lock(scheduler.mutex_);
    points_ = &scheduler.suspended_.emplace_back();
  }

  void run() {
    while (!scheduler_.ended(std::exchange(computed_, 0))) {
      start_points();
      while (const auto chunk = scheduler_.passages_.take(tickets_.size() - free_.size())) submit(*chunk);
      if (!engine_.advance())
        scheduler_.passages_.wait([this] { return any_ready() || scheduler_.solved(); });
      for (auto it = points_->begin(); it != points_->end();) {
        const auto point = it++;
        if (point->request.complete()) resume(point);
      }
    }
  }

 private:
  using Points = std::list<ActivePoint>;
  struct Ticket {
    PassageRequest* request;
    std::size_t index;  // index of the passage within the request
  };

  void start_points() {
    while (points_->size() < max_active_) {
      const auto index = scheduler_.next_point();
      if (!index) return;
      points_->emplace_back(
          [this, i = *index](const PassageRunner& run) { return scheduler_.solve(i, run); });
      request_passages(std::prev(points_->end()));
    }
  }

  void resume(Points::iterator point) {
    point->solving.resume(point->request.take());
    request_passages(point);
  }

  // Puts the passages that the point waits for into the queue, or delivers the point if it is solved. Resumes
  // the point as long as its passages are known.
  void request_passages(Points::iterator point) {
    while (const std::vector<PassageTask>* tasks = point->solving.waiting_for()) {
      point->request.expect(tasks->size());
      scheduler_.passages_.add(*tasks, point->request);
      if (!point->request.complete()) return;
      point->solving.resume(point->request.take());
    }
    scheduler_.deliver(std::move(point->report));
    points_->erase(point);
  }

  void submit(const PassageChunk& chunk) {
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      std::size_t ticket = tickets_.size();
      if (free_.empty()) {
        tickets_.emplace_back();
      } else {
        ticket = free_.back();
        free_.pop_back();
      }
      tickets_[ticket] = {chunk.request, i};
      engine_.submit((*chunk.tasks)[i], ticket);
    }
  }

  void receive(std::size_t ticket, Passage&& passage) {
    const auto [request, index] = tickets_[ticket];
    free_.push_back(ticket);
    ++computed_;
    scheduler_.passages_.deliver(*request, index, std::move(passage));
  }

  bool any_ready() const {
    return std::ranges::any_of(*points_, [](const ActivePoint& p) { return p.request.complete(); });
  }

  Scheduler& scheduler_;
  const std::size_t max_active_;
  Points* points_ = nullptr;
  SimdEngine engine_;
  std::vector<Ticket> tickets_;
  std::vector<std::size_t> free_;  // tickets to reuse
  std::size_t computed_ = 0;       // passages that have not been counted
};

struct Stopped {};

void Scheduler::solve_sequentially() {
  const PassageRunner run = [this, runner = make_runner(sweep_.engine)](const auto& tasks) {
    std::vector<Passage> passages = runner(tasks);
    if (ended(tasks.size())) throw Stopped{};
    return passages;
  };
  try {
    while (const auto index = next_point()) deliver(solve(*index, run));
  } catch (const Stopped&) {
  }
}

void Scheduler::run_thread() {
  try {
    if (!kSanitized && sweep_.engine == Engine::fast) Worker(*this).run();
    else solve_sequentially();
  } catch (const std::bad_alloc&) {
    fail(std::make_exception_ptr(
        RunError(fmt::format("not enough memory for {} threads; give fewer with --threads", threads_))));
  } catch (...) {
    fail(std::current_exception());
  }
}

}  // namespace

int all_cores() { return int(std::max(1u, std::thread::hardware_concurrency())); }

bool run_sweep(const Sweep& sweep, const std::vector<std::size_t>& points, int threads,
               const std::function<void(PointReport&&)>& sink, const std::function<bool()>& stop,
               const SchedulerObserver& observer) {
  Scheduler scheduler(sweep, points, std::size_t(threads), sink, stop, observer);
  std::vector<std::thread> others;
  others.reserve(std::size_t(threads));
  try {
    for (int i = 1; i < threads; ++i) others.emplace_back([&] { scheduler.run_thread(); });
  } catch (const std::system_error& e) {  // the numbers do not depend on the number of threads
    write_message(fmt::format("bristle: {} of {} threads could be started: {}\n", others.size() + 1, threads,
                              e.what()));
  }
  scheduler.run_thread();
  for (std::thread& thread : others) thread.join();
  return scheduler.complete();
}

}  // namespace bristle::run
