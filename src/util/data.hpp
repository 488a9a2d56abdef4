#pragma once

#include <optional>
#include <string>

namespace bristle {

// Returns the path of a file or folder that comes with the program, such as "experiments/paper.json" or
// "reference": PREFIX/share/bristle/NAME for an installed PREFIX/bin/bristle, NAME in the checkout for its
// build/bristle. Returns none if there is no such file.
std::optional<std::string> data_path(const std::string& name);

}  // namespace bristle
