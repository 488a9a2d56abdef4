#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace bristle::run {

// A share of a sweep that is computed separately. number: 1 to count
struct Shard {
  std::size_t number, count;
};

// Parses a shard such as "2/5". Throws InputError that says what is allowed.
Shard parse_shard(const std::string& text);
std::string shard_text(const Shard& shard);  // "2/5"

// Returns the points of the shard: every count-th point, because neighbouring points are about equally
// expensive. Returns none if there are fewer points than the shard's number, and all points without a shard.
std::vector<std::size_t> shard_points(const std::optional<Shard>& shard, std::size_t points);

// Returns the path of the journal of a run: results/fig4.h5.journal, or results/fig4.h5.2-of-5.journal for a
// shard.
std::string journal_path(const std::string& result, const std::optional<Shard>& shard);
// Returns the journals that shards of this result have left beside it, with their shards.
std::vector<std::pair<Shard, std::string>> shard_journals(const std::string& result);

}  // namespace bristle::run
