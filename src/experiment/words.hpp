#pragma once

#include "dynamics/passage.hpp"
#include "ensemble/load.hpp"
#include "ensemble/orientation.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace bristle::experiment {

// The words in experiments for the values 0, 1, ... of an enumeration. A test compares them with the schema.
template <class Enum>
const std::vector<std::string>& words();

template <>
inline const std::vector<std::string>& words<Distribution>() {
  static const std::vector<std::string> list = {"uniform", "von_mises"};
  return list;
}
template <>
inline const std::vector<std::string>& words<Sampling>() {
  static const std::vector<std::string> list = {"quadrature", "lattice", "list"};
  return list;
}
template <>
inline const std::vector<std::string>& words<LoadPath>() {
  static const std::vector<std::string> list = {"loading", "unloading"};
  return list;
}
template <>
inline const std::vector<std::string>& words<Engine>() {
  static const std::vector<std::string> list = {"fast", "reference"};
  return list;
}
template <>
inline const std::vector<std::string>& words<Method>() {
  static const std::vector<std::string> list = {"automatic", "explicit_only", "implicit_only"};
  return list;
}

template <class Enum>
const std::string& word(Enum value) {
  return words<Enum>().at(std::size_t(value));
}

// The value of a word. The schema must allow the word.
template <class Enum>
Enum from_word(const std::string& text) {
  const auto& list = words<Enum>();
  return Enum(std::find(list.begin(), list.end(), text) - list.begin());
}

}  // namespace bristle::experiment
