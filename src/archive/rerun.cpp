#include "archive/rerun.hpp"

#include "archive/result_facts.hpp"
#include "results/record.hpp"
#include "results/version.hpp"
#include "run/scheduler.hpp"
#include "util/error.hpp"
#include "util/process.hpp"
#include "bristle/random.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <nlohmann/json.hpp>

namespace bristle::archive {
namespace {

struct DrawnPoint {
  std::string file;
  std::size_t index;
};

// Draws count points by a partial Fisher-Yates shuffle of all points with this seed.
std::vector<DrawnPoint> draw_points(const Verification& archive, std::size_t count, std::uint64_t seed) {
  std::vector<DrawnPoint> all;
  for (const auto& [name, result] : archive.results)
    for (std::size_t i = 0; i < result.facts["points"].get<std::size_t>(); ++i) all.push_back({name, i});
  count = std::min(count, all.size());
  for (std::size_t i = 0; i < count; ++i)
    std::swap(all[i], all[i + split_mix(seed + i * kSplitMixStep) % (all.size() - i)]);
  all.resize(count);
  return all;
}

// For one point, which may take minutes.
constexpr Limits kPointLimits{3600, std::size_t(8) << 30};

Json compare_point(const std::string& bytes, const std::string& name, std::size_t index) {
  const results::ResultReader result("the file", bytes);
  const Experiment experiment = experiment::stored_experiment(result.experiment(), result.text("tier"), name);
  if (index >= experiment.sweep.size())
    throw MalformedError(fmt::format("its experiment has {} points, but its datasets have at least {}",
                                     experiment.sweep.size(), index + 1));
  results::PointRecord computed;
  run::run_sweep(
      experiment.sweep, {index}, 1, [&](run::PointReport&& report) { computed = std::move(report.record); },
      [] { return false; });
  return {
      {"place", experiment.sweep.place(index)},
      {"different", results::differences(results::read_record(result, experiment.sweep, index), computed)}};
}

}  // namespace

void rerun(const Verification& archive, std::size_t count, std::uint64_t seed,
           const std::function<void(const Rerun&)>& report) {
  for (const auto& [name, result] : archive.results)
    if (const long version = result.facts["numerics_version"]; version != results::kNumericsVersion)
      throw InputError(fmt::format(
          "--rerun: {} has numerics_version {}, but this program has {}, so its numbers may differ; "
          "build and use the program in the archive's data/source",
          name, version, results::kNumericsVersion));
  for (const DrawnPoint& drawn : draw_points(archive, count, seed)) {
    const std::string& bytes = archive.results.at(drawn.file).bytes;
    const auto compare = [&] { return compare_point(bytes, drawn.file, drawn.index).dump(); };
    try {
      const Json found = parse_untrusted(run_isolated(compare, kPointLimits));
      report({drawn.file, found["place"], found["different"]});
    } catch (const MalformedError& e) {
      throw MalformedError(fmt::format("{}: {}", drawn.file, e.what()));
    }
  }
}

}  // namespace bristle::archive
