#include "bristle/dynamics/jobs.hpp"

#include "bristle/sanitizer.hpp"

#include <array>
#include <boost/context/protected_fixedsize_stack.hpp>
#include <boost/coroutine2/coroutine.hpp>
#include <list>

namespace bristle {
namespace {

namespace context = boost::context;

// Size of a job's stack: several times what the equilibrium, the quadrature and a passage of the reference
// engine need.
constexpr std::size_t kStackBytes = 256 << 10;

// Stacks of jobs that have ended on this thread, for its next jobs: the system needs some 20 microseconds to
// map and unmap one.
struct FreeStacks {
  std::array<context::stack_context, 32> stacks;
  std::size_t count = 0;

  ~FreeStacks() {
    while (count > 0) context::protected_fixedsize_stack(kStackBytes).deallocate(stacks[--count]);
  }
};
thread_local FreeStacks free_stacks;

// A stack allocator of Boost.Context.
struct ReusedStack {
  context::stack_context allocate() const {
    if (free_stacks.count > 0) return free_stacks.stacks[--free_stacks.count];
    return context::protected_fixedsize_stack(kStackBytes).allocate();
  }
  void deallocate(context::stack_context& stack) const {
    if (free_stacks.count < free_stacks.stacks.size()) free_stacks.stacks[free_stacks.count++] = stack;
    else context::protected_fixedsize_stack(kStackBytes).deallocate(stack);
  }
};

}  // namespace

struct SuspendedJob::Routine {
  using Coroutine = boost::coroutines2::coroutine<const std::vector<PassageTask>*>;

  explicit Routine(Job job_to_run)
      : job(std::move(job_to_run)), coroutine(ReusedStack(), [this](Coroutine::push_type& suspend) {
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
