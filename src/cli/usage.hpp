#pragma once

#include <string>

namespace CLI {
class App;
}

namespace bristle::cli {

// Returns the commands that one starts with, for a command line without any.
std::string first_steps();

// Returns the message after a failed app.parse(): the command or option that is not known, with the similar
// one that is, or else CLI11's description. CLI11 reports what is missing first, which does not help who
// mistyped a name.
std::string command_line_mistake(const CLI::App& app, const std::string& description);

}  // namespace bristle::cli
