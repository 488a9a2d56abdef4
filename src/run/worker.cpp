#include "run/worker.hpp"

#include "dynamics/jobs.hpp"
#include "experiment/si_units.hpp"
#include "simd/dispatch.hpp"
#include "simd/engine.hpp"
#include "util/sanitizer.hpp"

#include <algorithm>
#include <list>
#include <new>
#include <utility>

namespace bristle::run {
namespace {

// Enough points to keep the lanes full while most of the points wait for the last passages of a batch.
constexpr std::size_t kMaxActivePoints = 24;

results::PointRecord solve(const Experiment& experiment, const results::PointLayout& format,
                           std::size_t index, const PassageRunner& run) {
  const experiment::PointInput input = experiment.point(index);
  if (input.loading.trace)
    return results::record_of(format, trace_curve(input.setup, *input.loading.trace, run));
  Recorded recorded;
  PointResult result = solve_point(input.setup, input.loading, run, experiment.record, &recorded);
  result.force_unit = experiment::force_unit(input);
  return results::record_of(format, result, recorded);
}

// An error within a point becomes its status, so that it does not cost the other points.
PointReport report_of(const Experiment& experiment, const results::PointLayout& format, std::size_t index,
                      const PassageRunner& run) {
  try {
    return {index, solve(experiment, format, index, run)};
  } catch (const std::bad_alloc&) {
    throw;  // the other points may be the cause
  } catch (const std::exception& e) {
    return {index, results::failed_record(format, e.what())};
  }
}

// A point that is being solved, suspended until the requested passages have been computed.
class SuspendedPoint {
 public:
  SuspendedPoint(const Experiment& experiment, const results::PointLayout& format, std::size_t index)
      : job_([this, &experiment, &format, index](const PassageRunner& run) {
          report_ = report_of(experiment, format, index, run);
        }) {
    prepare();
  }

  // The requested passages; null once the point is solved.
  const std::vector<PassageTask>* waiting_for() const { return job_.waiting_for(); }
  PassageRequest& request() { return request_; }
  bool ready() const { return request_.complete(); }
  void resume() {
    job_.resume(request_.take());
    prepare();
  }
  PointReport&& report() { return std::move(report_); }

 private:
  void prepare() { request_.expect(waiting_for() ? waiting_for()->size() : 0); }

  PointReport report_{};
  SuspendedJob job_;
  PassageRequest request_;
};

// Solves several points at a time with one SIMD engine. Once all points of the sweep have been started, the
// threads share the passages of those that are not yet solved.
class FastWorker {
 public:
  FastWorker(const Experiment& experiment, PointQueue& queue, PassagePool& pool, std::size_t share)
      : experiment_(experiment),
        format_(experiment),
        queue_(queue),
        pool_(pool),
        max_active_(std::min(kMaxActivePoints, share)),
        engine_(best_kernels(),
                [this](std::size_t ticket, Passage&& passage) { receive(ticket, std::move(passage)); }) {
    pool_.keep(points_);
    pool_.join();
  }

  void run() {
    bool joined = true;
    while (true) {
      if (joined && !start_points()) {
        pool_.leave();
        joined = false;
      }
      while (const auto chunk = pool_.take(submitted()))
        submit(*chunk->tasks, chunk->first, chunk->last, *chunk->request);
      const bool advanced = engine_.advance();
      if (queue_.stopped(std::exchange(computed_, 0))) return;
      if (!advanced && !pool_.wait([this] { return any_ready(); })) return;
      for (auto it = points_->begin(); it != points_->end();) {
        const auto point = it++;
        if (!point->ready()) continue;
        point->resume();
        submit_or_deliver(point);
      }
    }
  }

 private:
  using Points = std::list<SuspendedPoint>;
  struct Ticket {
    PassageRequest* request;
    std::size_t index;  // of the passage within the request
  };

  // Starts points up to the limit. Returns false if no point is active.
  bool start_points() {
    while (points_->size() < max_active_) {
      const auto index = queue_.next();
      if (!index) break;
      points_->emplace_back(experiment_, format_, *index);
      submit_or_deliver(std::prev(points_->end()));
    }
    return !points_->empty();
  }

  void submit_or_deliver(Points::iterator point) {
    const std::vector<PassageTask>* tasks = point->waiting_for();
    if (!tasks) {
      queue_.deliver(point->report());
      points_->erase(point);
      return;
    }
    std::size_t own = tasks->size();
    if (pool_.threads() > 1 && queue_.all_started()) own = submitted() > 0 ? 0 : pool_.chunk_size(own);
    submit(*tasks, 0, std::min(own, tasks->size()), point->request());
    if (own < tasks->size()) pool_.share(*tasks, own, point->request());
  }

  void submit(const std::vector<PassageTask>& tasks, std::size_t first, std::size_t last,
              PassageRequest& request) {
    for (std::size_t i = first; i < last; ++i) {
      std::size_t ticket = tickets_.size();
      if (free_.empty()) {
        tickets_.emplace_back();
      } else {
        ticket = free_.back();
        free_.pop_back();
      }
      tickets_[ticket] = {&request, i};
      engine_.submit(tasks[i], ticket);
    }
  }

  // The number of passages in the engine.
  std::size_t submitted() const { return tickets_.size() - free_.size(); }

  void receive(std::size_t ticket, Passage&& passage) {
    const auto [request, index] = tickets_[ticket];
    free_.push_back(ticket);
    ++computed_;
    if (request->deliver(index, std::move(passage)) && pool_.threads() > 1) pool_.notify();
  }

  bool any_ready() const { return std::ranges::any_of(*points_, &SuspendedPoint::ready); }

  const Experiment& experiment_;
  const results::PointLayout format_;
  PointQueue& queue_;
  PassagePool& pool_;
  const std::size_t max_active_;
  const std::shared_ptr<Points> points_ = std::make_shared<Points>();
  SimdEngine engine_;
  std::vector<Ticket> tickets_;
  std::vector<std::size_t> free_;  // tickets to reuse
  std::size_t computed_ = 0;       // passages that the queue has not counted
};

struct Stopped {};

void solve_sequentially(const Experiment& experiment, PointQueue& queue, Engine engine) {
  const results::PointLayout format(experiment);
  const PassageRunner run = [&queue, runner = make_runner(engine)](const std::vector<PassageTask>& tasks) {
    std::vector<Passage> passages = runner(tasks);
    if (queue.stopped(tasks.size())) throw Stopped{};
    return passages;
  };
  try {
    while (const auto index = queue.next()) queue.deliver(report_of(experiment, format, *index, run));
  } catch (const Stopped&) {
  }
}

}  // namespace

void run_worker(const Experiment& experiment, PointQueue& queue, PassagePool& pool, std::size_t share) {
  if (!kSanitized && experiment.engine == Engine::fast) FastWorker(experiment, queue, pool, share).run();
  else solve_sequentially(experiment, queue, experiment.engine);
}

}  // namespace bristle::run
