#pragma once

#include <map>
#include <string>

namespace bristle {

// Program version and where it was built from.
extern const char* const kVersion;
extern const char* const kCommit;

// What may differ between equal runs: program, compiler, libraries, host, command line. name -> text.
std::map<std::string, std::string> provenance(const std::string& command_line, int threads);

// Now in UTC, ISO 8601.
std::string utc_now();

}  // namespace bristle
