// CPU time of experiments whose points share passages, over that of the same experiments without sharing:
// JSON on standard output. usage: bench_sharing EXPERIMENT.json...
#include "design/design.hpp"
#include "experiment/experiment.hpp"
#include "run/task.hpp"
#include "util/error.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <ctime>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace bristle {
namespace {

constexpr int kPairs = 3;

// Returns the CPU seconds in which one thread computes the experiment anew.
double seconds(const Experiment& experiment, const std::string& output, std::size_t memo_bytes) {
  const run::RunOptions options{
      .output = output, .threads = 1, .force = true, .quiet = true, .memo_bytes = memo_bytes};
  const std::clock_t start = std::clock();
  if (!experiment.ranges.empty()) design::run_design(experiment, options);
  else run::run_experiment(experiment, options);
  return double(std::clock() - start) / CLOCKS_PER_SEC;
}

Json measure(const std::string& path, const std::string& folder) {
  fmt::print(stderr, "{} ...\n", path);
  const Experiment experiment = experiment::load_experiment(path, {});
  const std::string output = folder + "/r.h5";
  std::vector<double> ratios, shared;
  for (int pair = 0; pair < kPairs; ++pair) {
    std::array<double, 2> times;  // with sharing, without
    for (const bool alone : {pair % 2 == 0, pair % 2 != 0})
      times[alone] = seconds(experiment, output, alone ? 0 : run::kMemoBytes);
    shared.push_back(times[0]);
    ratios.push_back(times[0] / times[1]);
  }
  const auto median = [](std::vector<double> values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
  };
  Json out = {{"name", experiment.name},
              {"title", experiment.title},
              {"cpu_seconds", median(shared)},
              {"ratio", median(ratios)},
              {"ratios", ratios}};
  for (const sweep::Axis& axis : experiment.sweep.axes)
    if (axis.name == "R_n" || axis.name == "R_n_N") out["loads"] = axis.values.size();
  return out;
}

}  // namespace
}  // namespace bristle

int main(int argc, char** argv) {
  std::string folder = (std::filesystem::temp_directory_path() / "bristle-XXXXXX").string();
  if (!mkdtemp(folder.data())) return 1;
  bristle::Json rows = bristle::Json::array();
  int code = 0;
  try {
    for (int i = 1; i < argc; ++i) rows.push_back(bristle::measure(argv[i], folder));
    fmt::print("{}\n", rows.dump(1));
  } catch (const std::exception& e) {
    fmt::print(stderr, "{}\n", e.what());
    code = 1;
  }
  std::filesystem::remove_all(folder);
  return code;
}
