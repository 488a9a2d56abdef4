#include "dynamics/jobs.hpp"

#include "util/sanitizer.hpp"

#include <boost/coroutine2/coroutine.hpp>
#include <boost/coroutine2/protected_fixedsize_stack.hpp>
#include <list>

namespace bristle {
namespace {

// Several times what the equilibrium, the quadrature and a passage of the reference engine need.
constexpr std::size_t kStackBytes = 256 << 10;

}  // namespace

struct SuspendedJob::Routine {
  using Coroutine = boost::coroutines2::coroutine<const std::vector<PassageTask>*>;

  explicit Routine(Job job_to_run)
      : job(std::move(job_to_run)),
        coroutine(boost::coroutines2::protected_fixedsize_stack(kStackBytes),
                  [this](Coroutine::push_type& suspend) {
                    job([this, &suspend](const std::vector<PassageTask>& tasks) {
                      passages.clear();
                      if (!tasks.empty()) suspend(&tasks);
                      return std::move(passages);
                    });
                  }) {}

  Job job;
  std::vector<Passage> passages;
  Coroutine::pull_type coroutine;
};

SuspendedJob::SuspendedJob(Job job) : routine_(std::make_unique<Routine>(std::move(job))) {}
SuspendedJob::~SuspendedJob() = default;

const std::vector<PassageTask>* SuspendedJob::waiting_for() const {
  return routine_->coroutine ? routine_->coroutine.get() : nullptr;
}

void SuspendedJob::resume(std::vector<Passage> passages) {
  routine_->passages = std::move(passages);
  routine_->coroutine();
}

void run_together(const std::vector<Job>& jobs, const PassageRunner& run) {
  if (kSanitized || jobs.size() < 2) {
    for (const Job& job : jobs) job(run);
    return;
  }
  std::list<SuspendedJob> suspended(jobs.begin(), jobs.end());
  while (true) {
    suspended.remove_if([](const SuspendedJob& job) { return job.waiting_for() == nullptr; });
    if (suspended.empty()) return;
    std::vector<PassageTask> all;
    for (const SuspendedJob& job : suspended)
      all.insert(all.end(), job.waiting_for()->begin(), job.waiting_for()->end());
    const std::vector<Passage> passages = run(all);
    auto from = passages.begin();
    for (SuspendedJob& job : suspended) {
      const auto to = from + long(job.waiting_for()->size());
      job.resume({from, to});
      from = to;
    }
  }
}

}  // namespace bristle
