#pragma once

#include <map>
#include <string>
#include <vector>

namespace bristle::run {

// Version and source commit of the program.
extern const char* const kVersion;
extern const char* const kCommit;

// Returns facts, by name, that may differ between runs with equal numbers: program, compiler, libraries,
// host, command line.
std::map<std::string, std::string> provenance(const std::vector<std::string>& arguments, int threads);

// Returns the current time in UTC, ISO 8601.
std::string utc_now();

}  // namespace bristle::run
