#include "archive/safe_json.hpp"

#include "archive/tar.hpp"
#include "util/error.hpp"

namespace bristle {

Json safe_json(const std::string& text) {
  try {
    return parse_json(text);
  } catch (const InputError& e) {
    throw BadArchive(e.what());
  }
}

}  // namespace bristle
