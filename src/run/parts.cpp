#include "run/parts.hpp"

#include "results/digest.hpp"
#include "results/version.hpp"
#include "run/provenance.hpp"
#include "util/error.hpp"
#include "util/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <utility>

namespace bristle::run {
namespace {

constexpr std::size_t kMaxOpenParts = 200;  // the usual limit is 1024 file descriptors per process
constexpr std::size_t kMaxNamed = 10;       // points and shards named in a message

// The command that computes this shard, derived from the command that computed the part.
std::string shard_command(const Part& part, const results::Shard& shard) {
  const auto line = part.provenance.find("command_line");
  const std::string old_option = "--shard " + results::shard_text(part.shard),
                    new_option = "--shard " + results::shard_text(shard);
  if (line == part.provenance.end() || line->second.find(old_option) == std::string::npos)
    return "bristle run EXPERIMENT.json " + new_option;
  return replace_all(replace_all(line->second, old_option, new_option), results::part_path("", part.shard),
                     results::part_path("", shard));
}

void require_intact(const results::ResultReader& file, const Part& part, std::size_t points) {
  const bool fits = part.points.empty() || part.points.back() < points;
  if (!file.damage().empty() || !fits)
    throw InputError(
        fmt::format("{}: damaged: its contents do not match their digest; to compute it again: {}", part.path,
                    shard_command(part, part.shard)));
}

// JSON pointers at which two documents differ, with both values.
std::vector<std::string> differences_of(const Json& a, const Json& b) {
  const Json flat_a = a.flatten(), flat_b = b.flatten();
  std::vector<std::string> out;
  const auto value = [](const Json& flat, const std::string& at) {
    return flat.contains(at) ? shown(flat[at]) : "missing";
  };
  const auto add = [&](const Json& from, bool only_new) {
    for (const auto& [at, unused] : from.items())
      if (only_new ? !flat_a.contains(at) : value(flat_a, at) != value(flat_b, at))
        out.push_back(fmt::format("{} is {} and {}", at, value(flat_a, at), value(flat_b, at)));
  };
  add(flat_a, false);
  add(flat_b, true);
  if (out.empty()) out.emplace_back("the keys are in a different order");
  return out;
}

void require_same_experiment(const results::ResultReader& first, const results::ResultReader& other) {
  const Json a = first.experiment(), b = other.experiment();
  if (a == b && first.text("tier") == other.text("tier")) return;
  const auto differences = differences_of(a, b);
  const std::string more =
      differences.size() > 1 ? fmt::format(" (and {} more)", differences.size() - 1) : "";
  if (results::inputs_sha256(a) != results::inputs_sha256(b))
    throw InputError(fmt::format("{} and {} are parts of different experiments: {}{}", first.path(),
                                 other.path(), differences.front(), more));
  throw InputError(fmt::format(
      "{} and {} contain the same experiment with different descriptions: {}{}; run the shards again: this "
      "updates the descriptions without computing points again",
      first.path(), other.path(), differences.front(), more));
}

struct Version {
  std::string program;
  long numerics;
};

Version version_of(const results::ResultReader& file, const Part& part) {
  const auto program = part.provenance.find("version");
  return {program == part.provenance.end() ? "unknown" : program->second,
          h5::read_integer_attribute(file.file(), "numerics_version")};
}

std::string version_text(const Version& v) {
  return fmt::format("bristle {} (numerics version {})", v.program, v.numerics);
}

bool same(const Version& a, const Version& b) { return a.program == b.program && a.numerics == b.numerics; }

void require_same_version(const Part& first, const Version& of_first, const Part& other,
                          const Version& of_other) {
  if (!same(of_first, of_other))
    throw InputError(fmt::format("{} was computed by {}, but {} by {}; compute one of them again", first.path,
                                 version_text(of_first), other.path, version_text(of_other)));
}

results::ResultReader open_part(const std::string& path) {
  try {
    return results::ResultReader(path, results::Expected::part);
  } catch (const RunError& e) {
    throw InputError(fmt::format("{}: damaged: {}; compute it again", path, e.what()));
  }
}

}  // namespace

PartSet::PartSet(const std::vector<std::string>& paths) : parts_(read(paths)) {
  std::stable_sort(parts_.begin(), parts_.end(), [](const Part& a, const Part& b) {
    return std::pair(a.shard.count, a.shard.number) < std::pair(b.shard.count, b.shard.number);
  });
  for (std::size_t i = 0; i < parts_.size(); ++i)
    for (const std::size_t point : parts_[i].points) locations_.push_back({point, i});
  std::sort(locations_.begin(), locations_.end());
}

std::vector<Part> PartSet::read(const std::vector<std::string>& paths) {
  std::vector<Part> parts;
  Version of_first{};
  std::optional<results::ResultReader> first;
  for (const std::string& path : paths) {
    results::ResultReader file = open_part(path);
    try {
      if (!file.has("provenance")) throw RunError("there is no group /provenance");
      parts.push_back(
          {path, *file.shard(), file.part_points(), file.text("payload_sha256"), file.provenance()});
      if (parts.size() == 1) {
        of_first = version_of(file, parts[0]);
        experiment_ = experiment::stored_experiment(file.experiment(), file.text("tier"), path);
      }
      require_intact(file, parts.back(), experiment_.points());
    } catch (const RunError& e) {
      throw InputError(fmt::format("{}: damaged: {}; compute it again", path, e.what()));
    }
    require_same_version(parts[0], of_first, parts.back(), version_of(file, parts.back()));
    if (first) require_same_experiment(*first, file);
    else first = std::move(file);
  }
  const Version own{kVersion, results::kNumericsVersion};
  if (!same(of_first, own))
    throw InputError(fmt::format(
        "{} was computed by {}, but this program is {}; merge with the program that computed the parts, or "
        "compute them again",
        paths[0], version_text(of_first), version_text(own)));
  return parts;
}

std::string PartSet::point_label(std::size_t index) const {
  return fmt::format("{} ({})", index, experiment_.place(index));
}

void PartSet::require_complete() const {
  std::vector<std::size_t> missing;
  auto location = locations_.begin();
  for (std::size_t i = 0; i < experiment_.points(); ++i) {
    if (location == locations_.end() || location->point != i) missing.push_back(i);
    while (location != locations_.end() && location->point == i) ++location;
  }
  if (missing.empty()) return;
  const Part& example = parts_.front();
  std::set<std::size_t> numbers;
  std::vector<std::string> points, shards;
  for (const std::size_t i : missing) {
    numbers.insert(i % example.shard.count + 1);
    if (points.size() < kMaxNamed) points.push_back(point_label(i));
  }
  for (const std::size_t n : numbers)
    if (shards.size() < kMaxNamed) shards.push_back(results::shard_text({n, example.shard.count}));
  const auto more = [](std::size_t all) {
    return all > kMaxNamed ? fmt::format(" and {} more", all - kMaxNamed) : "";
  };
  throw InputError(
      fmt::format("{} of {} points are missing: {}{}.\nThey belong to the shards {}{}. To compute {}:\n  {}",
                  missing.size(), experiment_.points(), fmt::join(points, ", "), more(missing.size()),
                  fmt::join(shards, ", "), more(numbers.size()),
                  shards.size() > 1 ? "the first shard (the others likewise)" : "it",
                  shard_command(example, {*numbers.begin(), example.shard.count})));
}

const results::ResultReader& PartSet::open(std::size_t part) {
  const auto found = opened_.find(part);
  if (found != opened_.end()) return found->second;
  if (opened_.size() == kMaxOpenParts) opened_.clear();
  return opened_.try_emplace(part, parts_[part].path, results::Expected::part).first->second;
}

results::PointRecord PartSet::record(std::size_t index) {
  auto location = std::lower_bound(locations_.begin(), locations_.end(), Location{index, 0});
  const std::size_t from = location->part;
  results::PointRecord out = results::read_record(open(from).file(), experiment_, index);
  for (++location; location != locations_.end() && location->point == index; ++location) {
    const auto other =
        results::differences(out, results::read_record(open(location->part).file(), experiment_, index));
    if (!other.empty())
      throw InputError(fmt::format("{} and {} differ at point {}: {}; compute one of them again",
                                   parts_[from].path, parts_[location->part].path, point_label(index),
                                   other.front()));
  }
  return out;
}

}  // namespace bristle::run
