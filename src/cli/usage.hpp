#pragma once

#include <string>

namespace CLI {
class App;
}

namespace bristle::cli {

// The commands that one starts with, for a command line without any.
std::string first_steps();

// After a failed app.parse(): the command or option that is not known, with the similar one that is; empty if
// all are known. CLI11 reports what is missing first, which does not help who mistyped a name.
std::string unknown_argument(const CLI::App& app);

}  // namespace bristle::cli
