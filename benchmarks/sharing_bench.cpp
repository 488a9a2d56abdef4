// CPU time and memory of experiments whose points share passages, and of the same experiments without
// sharing: JSON on standard output. usage: bench_sharing EXPERIMENT.json...
#include "design/design.hpp"
#include "experiment/experiment.hpp"
#include "results/reader.hpp"
#include "run/task.hpp"
#include "util/error.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace bristle {
namespace {

constexpr int kPairs = 3;

struct Used {
  double seconds;
  long megabytes;
  std::string digest;  // of the numbers
};

// Computes the experiment anew by one thread of a process of its own. Returns what that process used.
Used used(const Experiment& experiment, const std::string& output, std::size_t memo_bytes) {
  const run::RunOptions options{
      .output = output, .threads = 1, .force = true, .quiet = true, .memo_bytes = memo_bytes};
  const pid_t process = fork();
  if (process == 0) {
    try {
      if (!experiment.ranges.empty()) design::run_design(experiment, options);
      else run::run_experiment(experiment, options);
      _exit(0);
    } catch (const std::exception& e) {
      fmt::print(stderr, "{}\n", e.what());
      _exit(1);
    }
  }
  int status = 0;
  rusage usage{};
  if (process < 0 || wait4(process, &status, 0, &usage) != process || status != 0)
    throw RunError(experiment.name + ": the run failed");
  const auto seconds = [](const timeval& t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); };
  return {seconds(usage.ru_utime) + seconds(usage.ru_stime), usage.ru_maxrss / 1024,
          results::ResultReader(output).text("payload_sha256")};
}

Json measure(const std::string& path, const std::string& folder) {
  fmt::print(stderr, "{} ...\n", path);
  const Experiment experiment = experiment::load_experiment(path, {});
  const std::string output = folder + "/r.h5";
  std::vector<double> ratios, shared;
  std::array<Used, 2> pair;  // with sharing, without
  for (int i = 0; i < kPairs; ++i) {
    for (const bool alone : {i % 2 == 0, i % 2 != 0})
      pair[alone] = used(experiment, output, alone ? 0 : run::kMemoBytes);
    if (pair[0].digest != pair[1].digest) throw RunError(path + ": sharing changes numbers");
    shared.push_back(pair[0].seconds);
    ratios.push_back(pair[0].seconds / pair[1].seconds);
  }
  const auto median = [](std::vector<double> values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
  };
  return {{"name", experiment.name},      {"title", experiment.title}, {"cpu_seconds", median(shared)},
          {"ratio", median(ratios)},      {"ratios", ratios},          {"MB", pair[0].megabytes},
          {"MB_alone", pair[1].megabytes}};
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
