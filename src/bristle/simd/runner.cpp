#include "bristle/simd/runner.hpp"

#include "bristle/simd/dispatch.hpp"
#include "bristle/simd/engine.hpp"

#include <memory>
#include <utility>

namespace bristle {
namespace {

std::vector<Passage> run_reference(const std::vector<PassageTask>& tasks) {
  std::vector<Passage> out;
  for (const PassageTask& task : tasks) out.push_back(run_passage(task));
  return out;
}

// The engine and the passages of its batch.
struct Batch {
  std::vector<Passage> passages;
  SimdEngine simd{best_kernels(),
                  [this](std::size_t ticket, Passage&& passage) { passages[ticket] = std::move(passage); }};
};

}  // namespace

PassageRunner make_runner(Engine engine) {
  if (engine == Engine::reference) return run_reference;
  // The engine is kept for the next batch, because it has the tables of friction laws. It is not kept after
  // an exception, which leaves passages in it.
  return [kept = std::make_shared<std::unique_ptr<Batch>>()](const std::vector<PassageTask>& tasks) {
    std::unique_ptr<Batch> batch = std::move(*kept);
    if (!batch) batch = std::make_unique<Batch>();
    batch->passages.resize(tasks.size());
    for (std::size_t i = 0; i < tasks.size(); ++i) batch->simd.submit(tasks[i], i);
    while (batch->simd.advance()) {
    }
    std::vector<Passage> out = std::exchange(batch->passages, {});
    *kept = std::move(batch);
    return out;
  };
}

}  // namespace bristle
