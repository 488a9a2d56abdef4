#pragma once

namespace bristle::cli {

// Runs the command that the words of the command line select; the first word is the program's name. Returns
// the exit code; throws InputError if the words are not a command, and what the command throws.
int run_command_line(int argc, char** argv);

}  // namespace bristle::cli
