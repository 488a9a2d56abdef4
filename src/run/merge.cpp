#include "run/merge.hpp"

#include "claims/checks.hpp"
#include "claims/store.hpp"
#include "results/writer.hpp"
#include "run/jumps.hpp"
#include "run/provenance.hpp"
#include "run/sweep.hpp"
#include "util/error.hpp"
#include "util/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <filesystem>
#include <set>

namespace bristle::run {
namespace {

std::string provenance_entry(const Part& part, const std::string& name) {
  const auto found = part.provenance.find(name);
  return found == part.provenance.end() ? "unknown" : found->second;
}

void require_distinct_output(const std::vector<Part>& parts, const std::string& output) {
  std::error_code ignored;
  for (const Part& part : parts)
    if (std::filesystem::equivalent(part.path, output, ignored))
      throw InputError(
          fmt::format("-o {}: is one of the parts ({}); choose another output file", output, part.path));
}

std::string part_line(const Part& part) {
  return fmt::format("{} {}: {} points, payload sha256 {}; {} to {} on {} by {}: {}",
                     results::shard_text(part.shard), std::filesystem::path(part.path).filename().string(),
                     part.points.size(), part.payload_sha256, provenance_entry(part, "started"),
                     provenance_entry(part, "finished"), provenance_entry(part, "host"),
                     provenance_entry(part, "commit"), provenance_entry(part, "command_line"));
}

// The jumps between the points of all parts, which no part contains.
results::Rows find_jumps(const Experiment& experiment, const std::vector<Gap>& gaps,
                         const std::function<bool()>& stop) {
  return locate_jumps(experiment, gaps, [&](const Experiment& between, const auto& indices) {
    std::map<std::size_t, Gap> found;
    const auto sink = [&](PointReport&& report) { found[report.index] = gap_of(report.record); };
    const std::set<std::size_t> ascending(indices.begin(), indices.end());
    run_sweep(between, {ascending.begin(), ascending.end()}, all_cores(), sink, stop);
    std::vector<Gap> out;
    for (const std::size_t index : indices) out.push_back(found[index]);  // not known if interrupted
    return out;
  });
}

}  // namespace

std::map<std::string, std::string> merged_provenance(const std::vector<Part>& parts) {
  std::map<std::string, std::set<std::string>> values;
  for (const Part& part : parts)
    for (const auto& [name, text] : part.provenance)
      if (name == "points_commits")
        for (const std::string& commit : split_list(text)) values[name].insert(commit);
      else values[name].insert(text);
  std::map<std::string, std::string> out;
  values.erase("points_computed");
  for (const auto& [name, texts] : values) out[name] = fmt::format("{}", fmt::join(texts, ", "));
  // ISO 8601 times sort like text.
  if (const auto& started = values["started"]; !started.empty()) out["started"] = *started.begin();
  if (const auto& finished = values["finished"]; !finished.empty()) out["finished"] = *finished.rbegin();
  const std::size_t digits = fmt::format("{}", parts.size()).size();
  for (std::size_t i = 0; i < parts.size(); ++i)
    out[fmt::format("part_{:0{}}", i + 1, digits)] = part_line(parts[i]);
  return out;
}

void merge_parts(PartSet& parts, const std::string& output, const std::string& command_line,
                 const std::function<bool()>& stop) {
  require_distinct_output(parts.parts(), output);
  parts.require_complete();
  const Experiment& experiment = parts.experiment();
  results::ResultWriter writer(experiment, output);
  std::vector<Gap> gaps;
  const auto end_if_stopped = [&] {
    if (stop()) throw Interrupted(fmt::format("interrupted; {} was not changed", output));
  };
  for (std::size_t i = 0; i < experiment.points(); ++i) {
    end_if_stopped();
    const results::PointRecord record = parts.record(i);
    writer.write(i, record);
    if (!experiment.locate_jumps.empty()) gaps.push_back(gap_of(record));
  }
  const results::Rows jumps = find_jumps(experiment, gaps, stop);
  end_if_stopped();
  if (!jumps.empty()) writer.write_jumps(experiment.locate_jumps, jumps);
  auto entries = merged_provenance(parts.parts());
  entries["command_line"] = command_line;
  entries["merged"] = fmt::format("{} by bristle {} ({})", utc_now(), kVersion, kCommit);
  writer.close(entries);
  const auto checks = claims::evaluate_checks(results::ResultReader(writer.partial()));
  claims::write_checks(writer.partial(), checks);
  writer.publish();
}

}  // namespace bristle::run
