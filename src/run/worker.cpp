#include "run/worker.hpp"

#include "simd/engine.hpp"
#include "dynamics/together.hpp"
#include "experiment/si_units.hpp"
#include "util/sanitizer.hpp"

#include <boost/coroutine2/coroutine.hpp>
#include <boost/coroutine2/protected_fixedsize_stack.hpp>
#include <list>

namespace bristle {
namespace {

namespace coroutines = boost::coroutines2;

// Enough points that the lanes are full while most of them wait for the last passages of a batch.
constexpr std::size_t kPointsUnderWay = 24;

PointReport solve(const Experiment& experiment, std::size_t index, const PassageRunner& run) {
  const PointInput input = experiment.point(index);
  if (input.loading.trace)
    return {index, record_of(experiment, trace_curve(input.interface, *input.loading.trace, run))};
  Recorded recorded;
  PointResult result = solve_point(input.interface, input.loading, run, experiment.record, &recorded);
  result.force_unit = force_unit(input);
  return {index, record_of(experiment, result, recorded)};
}

// Passages that a point waits for.
struct Batch {
  const std::vector<PassageTask>* tasks;
  std::vector<Passage> results;
  std::size_t missing;
};

// A point that is being solved; it stops wherever it needs passages.
class Solving {
 public:
  using Routine = coroutines::coroutine<Batch*>;

  Solving(const Experiment& experiment, std::size_t index)
      : routine_(coroutines::protected_fixedsize_stack(kJobStackBytes),
                 [this, &experiment, index](Routine::push_type& wait) {
                   const PassageRunner run = [&wait](const std::vector<PassageTask>& tasks) {
                     Batch batch{&tasks, std::vector<Passage>(tasks.size()), tasks.size()};
                     if (!tasks.empty()) wait(&batch);
                     return std::move(batch.results);
                   };
                   report_ = solve(experiment, index, run);
                 }) {}

  // The batch it waits for; none once it is solved.
  Batch* waits_for() { return routine_ ? routine_.get() : nullptr; }
  void resume() { routine_(); }
  PointReport&& report() { return std::move(report_); }

 private:
  PointReport report_{};
  Routine::pull_type routine_;
};

class LaneWorker {
 public:
  LaneWorker(const Experiment& experiment, PointQueue& queue, std::size_t share)
      : experiment_(experiment),
        queue_(queue),
        under_way_(std::min(kPointsUnderWay, share)),
        engine_(best_kernels(),
                [this](std::size_t ticket, Passage&& passage) { receive(ticket, std::move(passage)); }) {}

  void work() {
    while (start_points() && !queue_.stopped()) {
      engine_.advance();
      for (auto it = points_.begin(); it != points_.end();) {
        const auto point = it++;
        if (Batch* batch = point->waits_for(); batch && batch->missing > 0) continue;
        point->resume();
        submit_or_deliver(point);
      }
    }
  }

 private:
  using Points = std::list<Solving>;
  struct Ticket {
    Batch* batch;
    std::size_t place;
  };

  // False if none is left.
  bool start_points() {
    while (points_.size() < under_way_) {
      const auto index = queue_.next();
      if (!index) break;
      points_.emplace_back(experiment_, *index);
      submit_or_deliver(std::prev(points_.end()));
    }
    return !points_.empty();
  }

  void submit_or_deliver(Points::iterator point) {
    Batch* batch = point->waits_for();
    if (!batch) {
      queue_.deliver(point->report());
      points_.erase(point);
      return;
    }
    for (std::size_t i = 0; i < batch->tasks->size(); ++i) {
      std::size_t ticket = tickets_.size();
      if (free_.empty()) {
        tickets_.emplace_back();
      } else {
        ticket = free_.back();
        free_.pop_back();
      }
      tickets_[ticket] = {batch, i};
      engine_.submit((*batch->tasks)[i], ticket);
    }
  }

  void receive(std::size_t ticket, Passage&& passage) {
    const auto [batch, place] = tickets_[ticket];
    free_.push_back(ticket);
    batch->results[place] = std::move(passage);
    --batch->missing;
  }

  const Experiment& experiment_;
  PointQueue& queue_;
  const std::size_t under_way_;
  LaneEngine engine_;
  Points points_;
  std::vector<Ticket> tickets_;
  std::vector<std::size_t> free_;
};

struct Stopped {};

void work_one_by_one(const Experiment& experiment, PointQueue& queue, Engine engine) {
  const PassageRunner run = [&queue, runner = make_runner(engine)](const std::vector<PassageTask>& tasks) {
    if (queue.stopped()) throw Stopped{};
    return runner(tasks);
  };
  try {
    while (const auto index = queue.next()) queue.deliver(solve(experiment, *index, run));
  } catch (const Stopped&) {
  }
}

}  // namespace

void work(const Experiment& experiment, PointQueue& queue, std::size_t share) {
  // Sanitizers know nothing of the points' own stacks. The results are the same without.
  constexpr bool together = !kSanitized;
  if (together && experiment.engine == Engine::fast) LaneWorker(experiment, queue, share).work();
  else work_one_by_one(experiment, queue, experiment.engine);
}

}  // namespace bristle
