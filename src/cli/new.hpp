#pragma once

#include <string>

namespace bristle::cli {

// experiments/NAME.json or, if there is no such folder, NAME.json
std::string new_experiment_path(const std::string& name);

// The command `new`: writes an experiment to start from, with in_si one of a material in SI units. It extends
// the paper.json beside it or, if there is none, the one that comes with the program. Returns the exit code;
// throws InputError if the name is not allowed or the file exists.
int new_command(const std::string& name, bool in_si);

}  // namespace bristle::cli
