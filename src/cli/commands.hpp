#pragma once

#include "archive/build.hpp"
#include "assumptions/assumptions.hpp"
#include "compare/reference.hpp"
#include "experiment/experiment.hpp"
#include "run/task.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

// The commands of the program. Each returns the exit code and throws InputError or RunError.
namespace bristle::cli {

enum ExitCode {
  kSuccess = 0,
  kCheckFailed = 1,
  kBadInput = 2,
  kCouldNotFinish = 3,
  kInterrupted = 128  // plus the number of the signal
};

// The file of an experiment, or a result, which stands for the experiment that is stored in it; the changes
// to it; and the number of its only point, if the other points are to be left out.
struct ExperimentOptions {
  std::string file;
  json::DocumentOptions load;
  std::optional<std::size_t> point{};
};
// Computes an experiment and writes its result. options: without output the result is results/<name>.h5 or,
// of another tier, results/<name>-<tier>.h5, and of one point results/<name>-point-<N>.h5, which is computed
// even if a journal has it; instruction_set: empty for the widest available. Returns kCheckFailed if no trial
// of a design meets its constraints.
int run_command(const ExperimentOptions& experiment, const run::RunOptions& options,
                const std::string& instruction_set, bool needs_design = false);
int validate_command(const ExperimentOptions& experiment);

// Prints the modulation over the sliding speed of each friction law of the experiment, as a table.
int law_command(const ExperimentOptions& experiment);

// Prints the BibTeX entries of the software, of its data if they have a DOI, of the paper and, unless
// `result` is empty, of this result file.
int cite_command(const std::string& result);

// Prints the schema of experiment files for editors.
int schema_command();

int archive_command(archive::ArchiveOptions options);

struct VerifyOptions {
  std::string file;
  std::size_t rerun = 0;   // number of points to compute again
  std::uint64_t seed = 1;  // for the choice of these points
};
int verify_command(const VerifyOptions& options);

int assumptions_command(assumptions::AssumptionsOptions options);

struct CheckOptions {
  std::string file, reference;  // folder of the references; empty: ./reference, or else the program's
  bool report_only = false;     // claims that are not supported are no failure
  bool claims_only = false;     // no comparison with the reference
  bool all = false;             // print further checks, too, which decide nothing
  bool json = false;            // print JSON: deviations, and the command that computes each point again
};
int check_command(const CheckOptions& options);

struct DiffOptions {
  std::string a, b;
  compare::Tolerances tolerances;
  std::vector<std::string> only;  // variables to print side by side; empty: compare everything
};
int diff_command(const DiffOptions& options);

int reference_update_command(compare::ReferenceUpdate update);

struct ExportOptions {
  std::string file, output;       // empty output: the name of the result with .csv
  std::string group;              // empty: the variables
  std::string checks;             // of the group checks: a file with others; empty: the result's checks
  std::vector<std::string> only;  // variables that the table has beside coordinates and status; empty: all
};
int export_command(const ExportOptions& options);

struct ValueOptions {
  std::string file;
  std::vector<std::string> names;  // variables
  std::vector<std::string> at;     // "axis=value"; the nearest value of the axis counts
  bool json = false;
};
// Prints variables with their errors, and the status, of the points at a place: of all if `at` is empty.
int value_command(const ValueOptions& options);
// Prints variables of two results, a row for each point of both. Returns kCheckFailed if they differ.
int print_side_by_side(const results::ResultReader& a, const results::ResultReader& b,
                       const DiffOptions& options);

// Throws InputError if the table lacks one of the names that --only gives. path: the file of the table
void require_variables(const results::Dataset& table, const std::vector<std::string>& only,
                       const std::string& path);

struct InfoOptions {
  std::string file;
  bool json = false;
};
int info_command(const InfoOptions& options);

// Writes an experiment to start from, with in_si one of a material in SI units, and with repository a folder
// with the experiment, a script that checks its numbers and a workflow. It extends the paper.json beside it
// or, if there is none, the one that comes with the program. program: how this program was called, for the
// commands that are printed. Throws InputError if the name is not allowed or the file exists.
int new_command(const std::string& program, const std::string& name, bool in_si, bool repository);
// Returns experiments/NAME.json or, if there is no folder experiments, NAME.json.
std::string new_experiment_path(const std::string& name);

}  // namespace bristle::cli
