#include "run/points.hpp"

#include "run/provenance.hpp"
#include "run/shard.hpp"
#include "run/signals.hpp"
#include "util/error.hpp"
#include "util/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <set>
#include <unordered_set>

namespace bristle::run {
namespace {

constexpr std::size_t kMaxNamed = 10;  // greatest number of points or shards named in a message

// Returns a list such as "1/3, 2/3 and 7 more".
std::string list_of(const std::vector<std::string>& names) {
  const auto end = names.begin() + long(std::min(names.size(), kMaxNamed));
  const std::string more = end == names.end() ? "" : fmt::format(" and {} more", names.end() - end);
  return fmt::format("{}{}", fmt::join(names.begin(), end, ", "), more);
}

// Returns in words the shards to which the missing points belong, and the command of the first shard. shards:
// their total number, which journals beside the result tell
std::string where_missing(const std::vector<std::size_t>& missing, std::size_t shards,
                          const std::vector<std::string>& arguments) {
  std::set<std::size_t> numbers;
  for (const std::size_t i : missing) numbers.insert(i % shards + 1);
  std::vector<std::string> names;
  for (const std::size_t n : numbers) names.push_back(shard_text({n, shards}));
  const std::string command = command_with(arguments, "--shard " + names.front());
  if (names.size() == 1)
    return fmt::format("They belong to shard {}. To compute it:\n  {}", names.front(), command);
  return fmt::format("They belong to the shards {}. To compute the first (the others likewise):\n  {}",
                     list_of(names), command);
}

// Returns a sentence about each journal of a shard that has points, but none of the experiment.
std::string foreign_journals(const KeyedPoints& all, const std::string& result) {
  std::unordered_set<std::string> keys;
  for (const std::size_t i : all.points()) keys.insert(all.key(i));
  std::string out;
  for (const auto& [shard, path] : shard_journals(result)) {
    std::size_t points = 0, own = 0;
    // "unknown" includes points of programs with uncommitted changes, which this program may not use.
    results::read_journal(path, "unknown", [&](const results::JournalStart& line) {
      ++points;
      own += keys.contains(line.key) && (results::is_dirty(kCommit) || !results::is_dirty(line.commit));
    });
    if (points > 0 && own == 0)
      out += fmt::format(
          "{} has {} points, but none can be used: they are of another experiment (other options, for "
          "example) or numerics version, or were computed by a program with uncommitted changes.\n",
          path, points);
  }
  return out;
}

}  // namespace

KeyedPoints::KeyedPoints(const Sweep& sweep, std::vector<std::size_t> points)
    : sweep_(sweep), layout_(results::layout_of(sweep)), points_(std::move(points)) {
  for (const std::size_t i : points_) {
    if (interrupted()) throw Interrupted("interrupted before the first point");
    keys_.push_back(results::point_key(sweep, i));
  }
}

const std::string& KeyedPoints::key(std::size_t point) const {
  return keys_[std::size_t(std::ranges::lower_bound(points_, point) - points_.begin())];
}

std::vector<std::size_t> KeyedPoints::missing_in(const results::Journal& journal) const {
  std::vector<std::size_t> missing;
  for (std::size_t k = 0; k < points_.size(); ++k)
    if (!journal.find(keys_[k], layout_)) missing.push_back(points_[k]);
  return missing;
}

std::vector<std::size_t> KeyedPoints::missing_beside(const std::string& result) const {
  std::unordered_set<std::string> found;
  for (const std::string& path : results::journals_beside(result))
    results::read_journal(path, kCommit, [&](const results::JournalStart& line) {
      if (line.layout == layout_->digest()) found.insert(line.key);
    });
  std::vector<std::size_t> missing;
  for (std::size_t k = 0; k < points_.size(); ++k)
    if (!found.contains(keys_[k])) missing.push_back(points_[k]);
  return missing;
}

void KeyedPoints::adopt_into(results::Journal& journal) const {
  std::map<std::string, std::string> places;
  for (std::size_t k = 0; k < points_.size(); ++k) places[keys_[k]] = sweep_.place(points_[k]);
  for (const std::string& other : results::journals_beside(journal.path()))
    if (other != journal.path()) journal.adopt(other, layout_, places);
}

void require_complete(const Sweep& sweep, const std::vector<std::size_t>& missing, const std::string& result,
                      const std::vector<std::string>& arguments) {
  if (missing.empty()) return;
  std::vector<std::string> points;
  for (const std::size_t i : missing) points.push_back(fmt::format("{} ({})", i, sweep.place(i)));
  const auto shards = shard_journals(result);
  throw InputError(fmt::format("{}: {} of {} points are missing in the journals of its folder: {}.\n{}{}",
                               result, missing.size(), sweep.size(), list_of(points),
                               foreign_journals(KeyedPoints(sweep, shard_points({}, sweep.size())), result),
                               shards.empty()
                                   ? fmt::format("To compute them:\n  {}", command_with(arguments, ""))
                                   : where_missing(missing, shards.back().first.count, arguments)));
}

std::string command_with(const std::vector<std::string>& arguments, const std::string& option) {
  if (arguments.empty()) return "bristle run EXPERIMENT.json " + option;
  std::vector<std::string> kept;
  bool piped = false;
  for (auto argument = arguments.begin(); argument != arguments.end(); ++argument) {
    // A run with --complete is not forced, because --force would ignore the points of the shards.
    if (*argument == "--complete" || *argument == "--force" || argument->starts_with("--shard=")) continue;
    if (*argument == "--shard") {
      if (++argument == arguments.end()) break;
      continue;
    }
    piped = piped || *argument == "-";
    kept.push_back(*argument);
  }
  return shell_command(kept) + (option.empty() ? "" : " " + option) + (piped ? " < EXPERIMENT.json" : "");
}

}  // namespace bristle::run
