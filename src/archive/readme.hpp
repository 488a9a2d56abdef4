#pragma once

#include "archive/contents.hpp"

namespace bristle {

// README.md of the archive, for a reader who has nothing else: src/archive/README.md.in with the results'
// table and the claims' verdicts.
std::string archive_readme(const Contents& contents);

}  // namespace bristle
