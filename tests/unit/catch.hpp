#pragma once

#include <algorithm>
#include <string>

// Catch2 2 (Debian 12) and 3 (Debian 13, Ubuntu 24.04) have other headers, and other names of a few things.
#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_all.hpp>

namespace Catch {
using Matchers::EndsWith;
using Matchers::Equals;
using Matchers::StartsWith;
inline auto Contains(const std::string& text) { return Matchers::ContainsSubstring(text); }
using TestEventListenerBase = EventListenerBase;

// Tells whether the test has this tag, which is written in small letters and without brackets.
inline bool has_tag(const TestCaseInfo& test, const std::string& tag) {
  return std::ranges::count(test.tags, Tag(tag)) > 0;
}
}  // namespace Catch
using Catch::Approx;
#else
#include <catch2/catch.hpp>

namespace Catch {
inline bool has_tag(const TestCaseInfo& test, const std::string& tag) {
  return std::ranges::count(test.lcaseTags, tag) > 0;
}
}  // namespace Catch
#endif
