#pragma once

// What the program needs of C++20 and Emscripten's library of 2022 lacks: algorithms over ranges, and numbers
// to and from text. The compiler includes it before every file of the page's engine. Only the forms that the
// program has, and only what the library lacks.
#include <version>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <iterator>
#include <string>
#include <system_error>
#include <utility>

namespace std {

#if _LIBCPP_VERSION < 14000
// Writes a number with this many digits, as the format general does.
inline to_chars_result to_chars(char* first, char* last, double value, chars_format, int digits) {
  const int length = std::snprintf(first, std::size_t(last - first), "%.*g", digits, value);
  return {first + length, errc()};
}

// Writes a number with the fewest digits that read back exactly, without an exponent if it is as short.
inline to_chars_result to_chars(char* first, char* last, double value) {
  const double size = std::abs(value);
  for (int digits = size >= 10 && size < 1e5 ? int(std::log10(size)) + 1 : 1;; ++digits) {
    const to_chars_result written = to_chars(first, last, value, chars_format::general, digits);
    if (digits == 17 || std::strtod(first, nullptr) == value) return written;
  }
}
#endif

#if _LIBCPP_VERSION < 200000
// Reads a number as strtod() does, but without spaces and a sign plus before it.
inline from_chars_result from_chars(const char* first, const char* last, double& value) {
  if (first == last || *first == '+' || std::isspace(static_cast<unsigned char>(*first)))
    return {first, errc::invalid_argument};
  const std::string text(first, last);
  char* end = nullptr;
  const double read = std::strtod(text.c_str(), &end);
  if (end == text.c_str()) return {first, errc::invalid_argument};
  const from_chars_result result = {first + (end - text.c_str()),
                                    std::isinf(read) ? errc::result_out_of_range : errc()};
  if (result.ec == errc()) value = read;
  return result;
}
#endif

#ifndef __cpp_lib_ranges
namespace ranges {

struct as_it_is {
  template <class T>
  constexpr T&& operator()(T&& value) const {
    return static_cast<T&&>(value);
  }
};

// Returns a function that compares projections.
template <class Compare, class Projection>
constexpr auto projected(Compare& compare, Projection& projection) {
  return [&](const auto& a, const auto& b) {
    return bool(std::invoke(compare, std::invoke(projection, a), std::invoke(projection, b)));
  };
}
template <class Predicate, class Projection>
constexpr auto of_projected(Predicate& predicate, Projection& projection) {
  return [&](auto&& a) { return bool(std::invoke(predicate, std::invoke(projection, a))); };
}

template <class Range, class Predicate, class Projection = as_it_is>
constexpr bool all_of(Range&& range, Predicate predicate, Projection projection = {}) {
  return std::all_of(std::begin(range), std::end(range), of_projected(predicate, projection));
}
template <class Range, class Predicate, class Projection = as_it_is>
constexpr bool any_of(Range&& range, Predicate predicate, Projection projection = {}) {
  return std::any_of(std::begin(range), std::end(range), of_projected(predicate, projection));
}
template <class Range, class Predicate, class Projection = as_it_is>
constexpr bool none_of(Range&& range, Predicate predicate, Projection projection = {}) {
  return std::none_of(std::begin(range), std::end(range), of_projected(predicate, projection));
}
template <class Range, class Predicate, class Projection = as_it_is>
constexpr auto count_if(Range&& range, Predicate predicate, Projection projection = {}) {
  return std::count_if(std::begin(range), std::end(range), of_projected(predicate, projection));
}
template <class Range, class Value, class Projection = as_it_is>
constexpr auto count(Range&& range, const Value& value, Projection projection = {}) {
  return std::count_if(std::begin(range), std::end(range),
                       [&](const auto& one) { return std::invoke(projection, one) == value; });
}
template <class Range, class Value, class Projection = as_it_is>
constexpr auto find(Range&& range, const Value& value, Projection projection = {}) {
  return std::find_if(std::begin(range), std::end(range),
                      [&](const auto& one) { return std::invoke(projection, one) == value; });
}
template <class Range, class Predicate>
constexpr auto find_if(Range&& range, Predicate predicate) {
  return std::find_if(std::begin(range), std::end(range), predicate);
}
template <class Range, class Predicate>
constexpr auto find_if_not(Range&& range, Predicate predicate) {
  return std::find_if_not(std::begin(range), std::end(range), predicate);
}
template <class Range, class Compare = std::less<>, class Projection = as_it_is>
constexpr void sort(Range&& range, Compare compare = {}, Projection projection = {}) {
  std::sort(std::begin(range), std::end(range), projected(compare, projection));
}
template <class Range, class Compare = std::less<>, class Projection = as_it_is>
constexpr void stable_sort(Range&& range, Compare compare = {}, Projection projection = {}) {
  std::stable_sort(std::begin(range), std::end(range), projected(compare, projection));
}
template <class Range, class Compare = std::less<>, class Projection = as_it_is>
constexpr auto max_element(Range&& range, Compare compare = {}, Projection projection = {}) {
  return std::max_element(std::begin(range), std::end(range), projected(compare, projection));
}
template <class Range, class Compare = std::less<>, class Projection = as_it_is>
constexpr auto min_element(Range&& range, Compare compare = {}, Projection projection = {}) {
  return std::min_element(std::begin(range), std::end(range), projected(compare, projection));
}
template <class Range, class Compare = std::less<>, class Projection = as_it_is>
constexpr auto minmax_element(Range&& range, Compare compare = {}, Projection projection = {}) {
  return std::minmax_element(std::begin(range), std::end(range), projected(compare, projection));
}
template <class Range>
constexpr auto max(Range&& range) {
  return *ranges::max_element(range);
}
template <class Range>
constexpr auto minmax(Range&& range) {
  const auto [least, greatest] = ranges::minmax_element(range);
  return std::pair(*least, *greatest);
}
template <class Range, class Out, class Predicate>
constexpr auto copy_if(Range&& range, Out out, Predicate predicate) {
  return std::copy_if(std::begin(range), std::end(range), out, predicate);
}
template <class Range, class Out>
constexpr auto move(Range&& range, Out out) {
  return std::move(std::begin(range), std::end(range), out);
}
template <class A, class B, class Out>
constexpr auto set_union(A&& a, B&& b, Out out) {
  return std::set_union(std::begin(a), std::end(a), std::begin(b), std::end(b), out);
}
template <class Range, class Value>
constexpr void replace(Range&& range, const Value& before, const Value& after) {
  std::replace(std::begin(range), std::end(range), before, after);
}

}  // namespace ranges
#endif

}  // namespace std
