#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <vector>

namespace bristle {

// The words in experiments and results for the values 0, 1, ... of an enumeration.
using Words = std::span<const char* const>;

// Returns the words of an enumeration. Specialised beside each enumeration.
template <class Enum>
Words words();

template <class Enum>
const char* word(Enum value) {
  return words<Enum>()[std::size_t(value)];
}

// Returns the value of a word, which must be one of the enumeration's.
template <class Enum>
Enum from_word(const std::string& text) {
  const Words list = words<Enum>();
  return Enum(std::find(list.begin(), list.end(), text) - list.begin());
}

inline std::vector<std::string> texts(Words words) { return {words.begin(), words.end()}; }

}  // namespace bristle
