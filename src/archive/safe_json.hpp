#pragma once

#include "experiment/document.hpp"

namespace bristle {

// JSON that is not trusted: throws BadArchive if it is none, is nested too deeply or has a key twice in one
// object. The message does not name the file.
Json safe_json(const std::string& text);

}  // namespace bristle
