#pragma once

#include <array>
#include <charconv>
#include <string>
#include <string_view>

// Messages of errors, without a library for formatting.
namespace bristle {

// Returns a number with six digits, or with the fewest that read back exactly.
inline std::string six_digits(double value) {
  std::array<char, 32> text;
  const auto end = std::to_chars(text.begin(), text.end(), value, std::chars_format::general, 6).ptr;
  return {text.begin(), end};
}
inline std::string all_digits(double value) {
  std::array<char, 32> text;
  return {text.begin(), std::to_chars(text.begin(), text.end(), value).ptr};
}

// Returns the parts one after the other.
template <class... Parts>
std::string message(const Parts&... parts) {
  std::string out;
  (out.append(std::string_view(parts)), ...);
  return out;
}

}  // namespace bristle
