#include "kernel_speed.hpp"

#include "sample.hpp"

#include <sys/ptrace.h>
#include <sys/user.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <map>
#include <numeric>
#include <utility>

extern "C" const char __executable_start;  // defined by the linker

namespace bristle::bench {
namespace {

constexpr int kRepeats = 25;    // the shortest time counts: other programs only lengthen it
constexpr int kKeptBlocks = 1;  // whose instructions are counted, which takes ten microseconds each

// Calls the kernel, measures the calls with full blocks, and keeps some of the blocks, each with its friction
// table, which the engine deletes. Every repetition makes the same calls; the shortest time of each counts.
struct FullBlocks {
  static inline Events (*steps)(Block&) = nullptr;
  static inline std::size_t call = 0;
  static inline std::vector<double> times, lane_steps;
  static inline std::vector<Block> kept;
  static inline std::deque<ModulationTable> tables;

  static Events run(Block& block) {
    if (block.occupied != (1u << kLanes) - 1) return steps(block);
    if (call == times.size()) {
      times.push_back(INFINITY);
      lane_steps.push_back(0);
      if (call % 32 == 0 && kept.size() < kKeptBlocks) {
        kept.push_back(block);
        kept.back().modulation = &tables.emplace_back(*block.modulation);
      }
    }
    const auto before = block.lane_steps;
    Events events;
    times[call] = std::min(times[call], seconds([&] { events = steps(block); }));
    lane_steps[call++] = double(block.lane_steps - before);
    return events;
  }
};

double shortest(const std::function<void()>& work) {
  double least = INFINITY;
  for (int i = 0; i < kRepeats; ++i) least = std::min(least, seconds(work));
  return least;
}

// Of the processor's clock, s: dependent additions take one cycle each.
double cycle() {
  constexpr long kAdditions = 4'000'000;
  return shortest([] {
           unsigned long sum = 1, term = 1;
           for (long i = 0; i < kAdditions; ++i) asm volatile("add %1, %0" : "+r"(sum) : "r"(term));
         }) /
         kAdditions;
}

// Executes work in a child process, instruction by instruction.
std::map<std::uintptr_t, long> instructions(const std::function<void()>& work) {
  std::map<std::uintptr_t, long> counts;
  const pid_t child = fork();
  if (child == 0) {
    ptrace(PTRACE_TRACEME, 0, nullptr, nullptr);
    raise(SIGSTOP);
    work();
    _exit(0);
  }
  int status = 0;
  user_regs_struct registers;
  while (waitpid(child, &status, 0) == child && WIFSTOPPED(status)) {
    if (ptrace(PTRACE_GETREGS, child, nullptr, &registers) != 0) break;
    ++counts[registers.rip - std::uintptr_t(&__executable_start)];
    if (ptrace(PTRACE_SINGLESTEP, child, nullptr, nullptr) != 0) break;
  }
  return counts;
}

}  // namespace

nlohmann::ordered_json kernel_speed(const Kernels& kernels, Bending bending, const Rates& rates) {
  const Bristles bristles(1024, 1.8, bending);
  Kernels timed = kernels;
  auto& steps_of_lanes = has_pole(bending) ? timed.far_steps : timed.rod_steps;
  FullBlocks::times.clear();
  FullBlocks::lane_steps.clear();
  FullBlocks::kept.clear();
  FullBlocks::steps = std::exchange(steps_of_lanes, FullBlocks::run);
  double one_cycle = cycle();
  for (int i = 0; i < kRepeats; ++i) {
    FullBlocks::call = 0;
    run_lanes(timed, bristles.at(1e-5));
  }
  one_cycle = std::min(one_cycle, cycle());
  const auto sum = [](const std::vector<double>& v) { return std::accumulate(v.begin(), v.end(), 0.0); };
  const double lane_step = sum(FullBlocks::times) / sum(FullBlocks::lane_steps);
  constexpr long kOperations = 100'000;
  const auto cycles_per = [&](double (*repeat)(long)) {
    volatile double used;
    return shortest([&] { used = repeat(kOperations); }) / (kOperations * Rates::kChains) / one_cycle;
  };
  double steps = 0;
  for (Block block : FullBlocks::kept) {
    const auto before = block.lane_steps;
    FullBlocks::steps(block);
    steps += double(block.lane_steps - before) / kernels.width;
  }
  nlohmann::ordered_json counts;
  for (const auto& [address, count] : instructions([&] {
         for (Block block : FullBlocks::kept) FullBlocks::steps(block);
       }))
    counts[std::to_string(address)] = count;
  return {{"clock_GHz", 1e-9 / one_cycle},
          {"ns_per_lane_step", 1e9 * lane_step},
          {"cycles_per_lane_step", lane_step / one_cycle},
          {"cycles_per_multiply_add", cycles_per(rates.multiply_adds)},
          {"cycles_per_division", cycles_per(rates.divisions)},
          {"width", kernels.width},
          {"vector_steps", steps},
          {"instructions", counts}};
}

}  // namespace bristle::bench
