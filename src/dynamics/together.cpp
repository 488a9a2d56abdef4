#include "dynamics/together.hpp"

#include <boost/coroutine2/coroutine.hpp>
#include <boost/coroutine2/protected_fixedsize_stack.hpp>
#include <list>

namespace bristle {
namespace {

// A job that stops wherever it needs passages.
class Waiting {
 public:
  using Routine = boost::coroutines2::coroutine<const std::vector<PassageTask>*>;

  explicit Waiting(const Job& job)
      : routine_(boost::coroutines2::protected_fixedsize_stack(kJobStackBytes),
                 [this, &job](Routine::push_type& wait) {
                   job([this, &wait](const std::vector<PassageTask>& tasks) {
                     results_.clear();
                     if (!tasks.empty()) wait(&tasks);
                     return std::move(results_);
                   });
                 }) {}

  // What it waits for; null once it is done.
  const std::vector<PassageTask>* tasks() { return routine_ ? routine_.get() : nullptr; }
  void resume(std::vector<Passage>&& results) {
    results_ = std::move(results);
    routine_();
  }

 private:
  std::vector<Passage> results_;
  Routine::pull_type routine_;
};

void run_in_turn(const std::vector<Job>& jobs, const PassageRunner& run) {
  for (const Job& job : jobs) job(run);
}

}  // namespace

void run_together(const std::vector<Job>& jobs, const PassageRunner& run) {
#ifdef __SANITIZE_ADDRESS__
  return run_in_turn(jobs, run);  // the sanitizer knows nothing of the jobs' own stacks
#endif
  if (jobs.size() < 2) return run_in_turn(jobs, run);
  std::list<Waiting> waiting;
  for (const Job& job : jobs) waiting.emplace_back(job);
  while (true) {
    waiting.remove_if([](Waiting& job) { return job.tasks() == nullptr; });
    if (waiting.empty()) return;
    std::vector<PassageTask> all;
    for (Waiting& job : waiting) all.insert(all.end(), job.tasks()->begin(), job.tasks()->end());
    const std::vector<Passage> results = run(all);
    auto from = results.begin();
    for (Waiting& job : waiting) {
      const auto to = from + long(job.tasks()->size());
      job.resume({from, to});
      from = to;
    }
  }
}

}  // namespace bristle
