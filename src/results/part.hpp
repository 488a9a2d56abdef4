#pragma once

#include <optional>
#include <string>
#include <vector>

namespace bristle {

// A share of a sweep that is run by itself: number 1 .. count.
struct Shard {
  std::size_t number, count;
};

// Of "2/5". Throws InputError that says what is allowed.
Shard parse_shard(const std::string& text);
std::string shard_text(const Shard& shard);  // "2/5"

// The shard's points, every count-th: neighbours cost about the same, so shards do. None if there are fewer
// points than shards.
std::vector<std::size_t> shard_points(const Shard& shard, std::size_t points);

// results/fig4.h5 -> results/fig4.2-of-5.h5
std::string part_path(const std::string& whole, const Shard& shard);

// The command that merges the parts of which path is one.
std::string how_to_merge(const std::string& path, const Shard& shard);

}  // namespace bristle
