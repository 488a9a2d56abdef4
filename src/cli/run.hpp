#pragma once

#include "experiment/experiment.hpp"
#include "run/task.hpp"

#include <string>

namespace bristle::cli {

// The file of an experiment and the changes to it.
struct ExperimentOptions {
  std::string file;
  experiment::DocumentOptions load;
};

// The commands `run` and `validate`. They return the exit code and throw InputError or RunError. options:
// without output the result is results/<name>.h5; instruction_set: empty for the widest available.
int run_command(const ExperimentOptions& experiment, const run::RunOptions& options,
                const std::string& instruction_set);
int validate_command(const ExperimentOptions& experiment);

// The command `schema`: prints the schema of experiment files for editors.
int schema_command();

}  // namespace bristle::cli
