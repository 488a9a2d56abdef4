#pragma once

#include "unit/scratch.hpp"

#include <cstdint>
#include <cstdlib>
#include <string>

namespace bristle::testing {

inline std::string text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

inline void require(bool sound) {
  if (!sound) std::abort();
}

}  // namespace bristle::testing
