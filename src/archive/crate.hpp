#pragma once

#include "archive/contents.hpp"

#include <string>

// Metadata of the payload: RO-Crate 1.1 with the profile Process Run Crate 0.5.
namespace bristle::archive {

constexpr const char* kCrateFile = "ro-crate-metadata.json";

// Returns the text of the crate. contents.payload must contain all files except the crate.
std::string crate_text(const Contents& contents);

std::string doi_address(const Json& doi);

}  // namespace bristle::archive
