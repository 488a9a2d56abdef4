#pragma once

#include "archive/tar.hpp"

#include <string>
#include <utility>
#include <vector>

// BagIt 1.0 (RFC 8493): the payload under data/, beside it manifests with the SHA-512 of every file.
namespace bristle {

// What is wrong, one line each, beginning with the file it is about.
using Problems = std::vector<std::string>;

// Lines of bag-info.txt.
using BagInfo = std::vector<std::pair<std::string, std::string>>;

// The payload (names as under data/) with its tag files; names begin with the folder's.
Files make_bag(const std::string& folder, const Files& payload, const BagInfo& info);

// Removes the folder that all names begin with, and returns it. Throws MalformedError if there is no such.
std::string strip_folder(Files& files);

// Holds a bag's files (without the folder) against its manifests: every hash, nothing missing, nothing added.
Problems check_bag(const Files& files);

// A value of bag-info.txt; empty if there is none.
std::string bag_info(const Files& files, const std::string& label);

}  // namespace bristle
