#include "results/part.hpp"

#include "util/error.hpp"

#include <fmt/format.h>
#include <charconv>

namespace bristle::results {
namespace {

constexpr const char* kExtension = ".h5";

std::optional<std::size_t> whole_number(const std::string& text) {
  std::size_t value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end) return {};
  return value;
}

std::string stem(const std::string& path) {
  const std::string extension = kExtension;
  const bool has = path.size() > extension.size() &&
                   path.compare(path.size() - extension.size(), extension.size(), extension) == 0;
  return has ? path.substr(0, path.size() - extension.size()) : path;
}

}  // namespace

Shard parse_shard(const std::string& text) {
  const auto slash = text.find('/');
  const auto number = whole_number(text.substr(0, slash));
  const auto count = slash == std::string::npos ? std::nullopt : whole_number(text.substr(slash + 1));
  if (!number || !count || *count == 0)
    throw InputError(fmt::format(
        "--shard {}: not a shard; give i/N, the i-th of N shards, as two positive integers such as 2/8",
        text));
  if (*number == 0 || *number > *count)
    throw InputError(fmt::format("--shard {}: there is no shard {} of {}; shards are numbered 1/{} to {}/{}",
                                 text, *number, *count, *count, *count, *count));
  return {*number, *count};
}

std::string shard_text(const Shard& shard) { return fmt::format("{}/{}", shard.number, shard.count); }

std::vector<std::size_t> shard_points(const Shard& shard, std::size_t points) {
  std::vector<std::size_t> out;
  for (std::size_t i = shard.number - 1; i < points; i += shard.count) out.push_back(i);
  return out;
}

std::string part_path(const std::string& whole, const Shard& shard) {
  return fmt::format("{}.{}-of-{}{}", stem(whole), shard.number, shard.count, kExtension);
}

std::string how_to_merge(const std::string& path, const Shard& shard) {
  const std::string ending = part_path("", shard);
  if (path.size() <= ending.size() || path.compare(path.size() - ending.size(), ending.size(), ending) != 0)
    return "bristle merge -o FILE.h5 PARTS...";
  const std::string whole = path.substr(0, path.size() - ending.size());
  return fmt::format("bristle merge -o {}{} {}.*-of-{}{}", whole, kExtension, whole, shard.count, kExtension);
}

}  // namespace bristle::results
