#include "archive/safe_json.hpp"

#include "archive/tar.hpp"

#include <fmt/format.h>
#include <set>

namespace bristle {
namespace {

// Deeper than any experiment; what walks through it calls itself once per level.
constexpr int kDeepest = 64;

}  // namespace

Json safe_json(const std::string& text) {
  std::vector<std::set<std::string>> keys;
  const auto watch = [&](int depth, Json::parse_event_t event, Json& parsed) {
    if (depth > kDeepest) throw BadArchive(fmt::format("JSON nested more than {} deep", kDeepest));
    if (event == Json::parse_event_t::object_start) keys.emplace_back();
    if (event == Json::parse_event_t::object_end) keys.pop_back();
    if (event == Json::parse_event_t::key && !keys.back().insert(parsed.get<std::string>()).second)
      throw BadArchive(fmt::format("the key {} appears twice in one object", shown(parsed)));
    return true;
  };
  try {
    return Json::parse(text, watch);
  } catch (const Json::exception& e) {
    throw BadArchive(fmt::format("not JSON: {}", e.what()));
  }
}

}  // namespace bristle
