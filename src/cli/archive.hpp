#pragma once

#include "archive/gather.hpp"

#include <cstddef>
#include <cstdint>
#include <string>

namespace bristle::cli {

struct VerifyOptions {
  std::string file;
  std::size_t rerun = 0;   // number of points to compute again
  std::uint64_t seed = 1;  // for the choice of these points
};

// The commands `archive` and `verify`. They return the exit code and throw InputError or RunError.
int archive_command(archive::ArchiveOptions options);
int verify_command(const VerifyOptions& options);

}  // namespace bristle::cli
