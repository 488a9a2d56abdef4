#pragma once

#include "archive/contents.hpp"

#include <string>

// RO-Crate 1.1 with the profile Process Run Crate 0.5: the payload's metadata, ro-crate-metadata.json.
namespace bristle {

constexpr const char* kCrateFile = "ro-crate-metadata.json";

// The text of the crate of a payload; contents.payload holds every file but the crate.
std::string crate_text(const Contents& contents);

}  // namespace bristle
