#pragma once

#include "archive/contents.hpp"

namespace bristle::archive {

// README.md of the archive: src/archive/README.md.in with the tables of results and of claims.
std::string archive_readme(const Contents& contents);

}  // namespace bristle::archive
