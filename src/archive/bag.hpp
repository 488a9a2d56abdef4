#pragma once

#include "archive/tar.hpp"

#include <string>
#include <utility>
#include <vector>

// BagIt 1.0 (RFC 8493): the payload in data/, and manifests with the SHA-512 of every file.
namespace bristle::archive {

// Descriptions of problems, one line each, starting with the name of the file.
using Problems = std::vector<std::string>;

// Lines of bag-info.txt.
using BagInfo = std::vector<std::pair<std::string, std::string>>;

// Returns the payload, in data/, and its tag files. Names in payload are relative to data/.
Files make_bag(const Files& payload, const BagInfo& info);

// Returns the files with the folder of an archive before their names.
Files in_folder(const std::string& folder, Files files);

// Removes the folder with which all names start, and returns
// it. Throws MalformedError if the names differ in it.
std::string strip_folder(Files& files);

// Compares the files of a bag with its manifests: which are damaged, missing or added. It does not check
// that make_bag() would write the same manifests; verification makes them again and compares.
Problems check_manifests(const Files& files);

// Returns the value of a label in bag-info.txt; empty if it is missing.
std::string bag_info(const Files& files, const std::string& label);

}  // namespace bristle::archive
