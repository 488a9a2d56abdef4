#include "bristle/simd/runner.hpp"

#include "bristle/simd/dispatch.hpp"
#include "bristle/simd/engine.hpp"

namespace bristle {
namespace {

std::vector<Passage> run_reference(const std::vector<PassageTask>& tasks) {
  std::vector<Passage> out;
  for (const PassageTask& task : tasks) out.push_back(run_passage(task));
  return out;
}

}  // namespace

PassageRunner make_runner(Engine engine) {
  if (engine == Engine::reference) return run_reference;
  return [&kernels = best_kernels()](const std::vector<PassageTask>& tasks) {
    std::vector<Passage> out(tasks.size());
    SimdEngine simd(kernels,
                    [&out](std::size_t ticket, Passage&& passage) { out[ticket] = std::move(passage); });
    for (std::size_t i = 0; i < tasks.size(); ++i) simd.submit(tasks[i], i);
    while (simd.advance()) {
    }
    return out;
  };
}

}  // namespace bristle
