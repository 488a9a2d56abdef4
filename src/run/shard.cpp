#include "run/shard.hpp"

#include "results/journal.hpp"
#include "util/error.hpp"

#include <fmt/format.h>
#include <charconv>
#include <filesystem>
#include <regex>

namespace bristle::run {
namespace {

std::optional<std::size_t> whole_number(const std::string& text) {
  std::size_t value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end) return {};
  return value;
}

// The names of journals of shards have at most nine digits.
constexpr std::size_t kMostShards = 999999999;

}  // namespace

Shard parse_shard(const std::string& text) {
  const auto slash = text.find('/');
  const auto number = whole_number(text.substr(0, slash));
  const auto count = whole_number(slash == std::string::npos ? "" : text.substr(slash + 1));
  if (!number || !count || *count == 0)
    throw InputError(fmt::format(
        "--shard {}: not a shard; give i/N, the i-th of N shards, as two positive integers such as 2/8",
        text));
  if (*count > kMostShards)
    throw InputError(
        fmt::format("--shard {}: more than {} shards; no experiment has so many points", text, kMostShards));
  if (*number == 0 || *number > *count)
    throw InputError(fmt::format("--shard {}: there is no shard {} of {}; shards are numbered 1/{} to {}/{}",
                                 text, *number, *count, *count, *count, *count));
  return {*number, *count};
}

std::string shard_text(const Shard& shard) { return fmt::format("{}/{}", shard.number, shard.count); }

std::vector<std::size_t> shard_points(const std::optional<Shard>& shard, std::size_t points) {
  std::vector<std::size_t> out;
  for (std::size_t i = shard ? shard->number - 1 : 0; i < points; i += shard ? shard->count : 1)
    out.push_back(i);
  return out;
}

std::string journal_path(const std::string& result, const std::optional<Shard>& shard) {
  return shard ? fmt::format("{}.{}-of-{}.journal", result, shard->number, shard->count)
               : result + ".journal";
}

std::vector<std::pair<Shard, std::string>> shard_journals(const std::string& result) {
  std::vector<std::pair<Shard, std::string>> out;
  const std::string start = std::filesystem::path(result).filename();
  for (const std::string& path : results::journals_beside(result)) {
    const std::string name = std::filesystem::path(path).filename();
    static const std::regex ending(R"(\.([1-9]\d{0,8})-of-([1-9]\d{0,8})\.journal)");
    std::smatch match;
    const std::string rest = name.starts_with(start) ? name.substr(start.size()) : "";
    if (std::regex_match(rest, match, ending))
      out.push_back({{std::stoul(match[1]), std::stoul(match[2])}, path});
  }
  return out;
}

}  // namespace bristle::run
