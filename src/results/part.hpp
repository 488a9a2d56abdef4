#pragma once

#include <optional>
#include <string>
#include <vector>

namespace bristle::results {

// A share of a sweep that is computed separately: number 1 to count.
struct Shard {
  std::size_t number, count;
};

// Parses "2/5". Throws InputError with what is allowed.
Shard parse_shard(const std::string& text);
std::string shard_text(const Shard& shard);  // "2/5"

// The points of the shard: every count-th, as neighbouring points are about equally expensive. Empty if there
// are fewer points than the shard's number.
std::vector<std::size_t> shard_points(const Shard& shard, std::size_t points);

// results/fig4.h5 -> results/fig4.2-of-5.h5
std::string part_path(const std::string& whole, const Shard& shard);

// The command that merges path with the other parts.
std::string how_to_merge(const std::string& path, const Shard& shard);

}  // namespace bristle::results
