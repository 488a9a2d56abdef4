#include "cli/commands.hpp"

#include "claims/measure.hpp"
#include "claims/checks.hpp"
#include "design/block.hpp"
#include "design/design.hpp"
#include "experiment/schema.hpp"
#include "json/node.hpp"
#include "sweep/si.hpp"
#include "results/reader.hpp"
#include "run/analysis.hpp"
#include "bristle/model/error.hpp"
#include "bristle/simd/dispatch.hpp"
#include "bristle/simd/runner.hpp"
#include "results/phases.hpp"
#include "util/error.hpp"
#include "util/file.hpp"
#include "util/grid.hpp"
#include "util/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string_view>
#include <unistd.h>

namespace bristle::cli {
namespace {

void choose_instruction_set(const std::string& name) {
  if (name.empty() || prefer_kernels(name)) return;
  std::vector<std::string> names;
  for (const Kernels* kernels : available_kernels()) names.emplace_back(kernels->target);
  throw InputError(fmt::format("--instruction-set {}: not supported by this processor; allowed: {}", name,
                               fmt::join(names, ", ")));
}

// Returns the experiment that is stored in a result, with the sample of the file; the sample of a design is
// left out, because a design looks for its own, unless options.point names a point. Throws InputError for a
// damaged file or another tier.
Experiment load_result(const ExperimentOptions& options) {
  const results::ResultReader result(options.file);
  result.require_intact();
  const std::string tier = result.text("tier");
  if (options.load.tier != "full" && options.load.tier != tier)
    throw InputError(
        fmt::format("--tier {}: {} has the experiment of its tier, {}, only; name the experiment file",
                    options.load.tier, options.file, tier));
  Json document = result.experiment();
  if (!options.point && document.contains("design")) document["sweep"].erase(sweep::kSample);
  return experiment::stored_experiment(document, tier, options.file, options.load.set);
}

// Throws InputError if the file has more points than the one that would replace them.
void require_one_point(const std::string& path) {
  if (!is_of_kind(path, results::result_file())) return;
  if (const std::size_t points = grid_size(results::ResultReader(path).sweep_shape()); points > 1)
    throw InputError(fmt::format(
        "{}: holds {} points, which the point of --point would replace; give another file with -o", path,
        points));
}

// Returns the experiment of this point alone.
Experiment only_point(const Experiment& all, std::size_t point) {
  if (point >= all.sweep.size())
    throw InputError(
        fmt::format("--point {}: {} has the points 0 to {}", point, all.path, all.sweep.size() - 1));
  return experiment::stored_experiment(experiment::document_of_point(all, point), all.tier, all.path);
}

// Finds mistakes in the blocks that the experiment's own reader leaves to others.
void read_blocks(const Experiment& experiment) {
  claims::read_checks(experiment);
  run::read_analysis(experiment);
  if (!experiment.ranges.empty()) design::read_design(experiment);
}

Experiment load_checked(const ExperimentOptions& options) {
  const bool is_result = not_a_file(options.file).empty() && is_of_kind(options.file, results::result_file());
  Experiment experiment =
      is_result ? load_result(options) : experiment::load_experiment(options.file, options.load, read_blocks);
  if (options.point) experiment = only_point(experiment, *options.point);
  claims::validate_checks(experiment);
  run::validate_analysis(experiment);
  design::validate_design(experiment);
  return experiment;
}

// Returns the words of a choice, the number of points and the columns of a sample, or the number of values
// and the ends of their range.
std::string range_text(const sweep::Axis& axis) {
  const sweep::Sweepable& sweepable = axis.quantity();
  std::vector<std::string> columns;
  for (const sweep::Axis& column : axis.columns) columns.push_back(column.name);
  if (!columns.empty()) return fmt::format("{} of {}", axis.values.size(), fmt::join(columns, ", "));
  if (sweepable.options.empty())
    return fmt::format("{} from {:.6g} to {:.6g}", axis.values.size(), axis.values.front(),
                       axis.values.back());
  std::vector<std::string> words;
  for (const double value : axis.values) words.push_back(sweepable.text(value));
  return fmt::format("{}", fmt::join(words, ", "));
}

// An object that, while it lives, sends what is printed to standard error; only write() reaches standard
// output.
class ReservedOutput {
 public:
  ReservedOutput() : output_(dup(STDOUT_FILENO)) {
    std::signal(SIGPIPE, SIG_IGN);  // a write into a closed pipe then fails, and temporary files are removed
    std::fflush(stdout);
    dup2(STDERR_FILENO, STDOUT_FILENO);
  }
  ~ReservedOutput() {
    std::fflush(stdout);
    dup2(output_, STDOUT_FILENO);
    close(output_);
  }
  ReservedOutput(const ReservedOutput&) = delete;
  ReservedOutput& operator=(const ReservedOutput&) = delete;
  void write(std::string_view bytes) const {
    while (!bytes.empty()) {
      const ssize_t written = ::write(output_, bytes.data(), bytes.size());
      if (written < 0)
        throw RunError(fmt::format("standard output cannot be written: {}", std::strerror(errno)));
      bytes.remove_prefix(std::size_t(written));
    }
  }

 private:
  int output_;
};

// A folder for a result on its way to standard output: HDF5 cannot write into a pipe.
struct TemporaryFolder {
  TemporaryFolder() {
    path = (std::filesystem::temp_directory_path() / "bristle-XXXXXX").string();
    if (!mkdtemp(path.data()))
      throw RunError(fmt::format("{}: cannot be made: {}", path, std::strerror(errno)));
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  std::string path;
};

bool compute(const Experiment& experiment, const run::RunOptions& options, bool needs_design) {
  if (!experiment.ranges.empty() || needs_design) return design::run_design(experiment, options);
  run::run_experiment(experiment, options);
  return true;
}

bool compute_to_standard_output(const Experiment& experiment, const run::RunOptions& options,
                                bool needs_design) {
  if (options.shard || options.complete)
    throw InputError("-o -: shards have journals beside the result; name a file");
  if (isatty(STDOUT_FILENO))
    throw InputError(
        "-o -: standard output is a terminal, and a result is not text; write > FILE.h5 or a pipe behind it");
  const TemporaryFolder folder;
  const ReservedOutput output;
  run::RunOptions in_folder = options;
  in_folder.output = folder.path + "/" + experiment.name + ".h5";
  // The folder is removed, so that what messages say about the points saved in it does not hold.
  constexpr const char* lost = "; -o - keeps no points: with the name of a file, the same command continues";
  try {
    const bool succeeded = compute(experiment, in_folder, needs_design);
    output.write(read_file(in_folder.output));
    return succeeded;
  } catch (const Interrupted&) {
    throw Interrupted(std::string("interrupted") + lost);
  } catch (const RunError& e) {
    throw RunError(e.reason() + lost + " (TMPDIR names the folder for temporary files)");
  }
}

void print_warnings(const Experiment& e) {
  for (const std::string& warning : e.warnings) write_message(fmt::format("warning: {}\n", warning));
}

// Prints the first and the last point of an experiment in SI units, in dimensionless form.
void print_conversion(const Experiment& e) {
  const std::size_t last = e.sweep.size() - 1;
  for (const std::size_t index : last > 0 ? std::vector<std::size_t>{0, last} : std::vector<std::size_t>{0})
    fmt::print("dimensionless at {}: {}\n", e.sweep.place(index),
               fmt::join(sweep::values_from_si(e.sweep.point(index)), ", "));
}

// Returns the point with the greatest load over the polar stiffness among those with a load; none without
// one.
std::optional<std::size_t> most_loaded(const Sweep& sweep) {
  std::optional<std::size_t> out;
  double most = 0;
  for (std::size_t i = 0; i < sweep.size(); ++i) {
    const sweep::PointInput point = sweep.point(i);
    const double load = point.loading.R_n / point.setup.parameters.k_phi;
    if (point.loading.z_0 || load <= most) continue;
    most = load;
    out = i;
  }
  return out;
}

// Prints the load at which a bristle of the most loaded point buckles, and the most that its brush carries,
// by means over few azimuths. Warns if the load is greater.
void print_carried(const Experiment& e) {
  const auto index = most_loaded(e.sweep);
  if (!index) return;
  sweep::PointInput point = e.sweep.point(*index);
  const double R_n = point.loading.R_n, euler = euler_load(point.setup.parameters);
  constexpr double kRough = 0.1, kMoreThanAny = 1e6;
  Setup rough = point.setup;
  if (rough.orientation.sampling != Sampling::list) rough.orientation.sampling = Sampling::quadrature;
  rough.orientation.rtol = kRough;
  rough.max_evaluations_per_point = 20'000'000;
  PointResult found = without_values(PointStatus::failed);
  try {
    found =
        solve_point(rough, {.R_n = kMoreThanAny * point.setup.parameters.k_phi}, make_runner(Engine::fast));
  } catch (const ModelError&) {  // `run` says of each point why it failed
  }
  const double carried = found.R_n_largest.value;
  const auto load = [&](double value) { return results::load_text(point, value); };
  fmt::print("load of a bristle at {}: {}; Euler's buckling load of a straight shaft: {}{}\n",
             e.sweep.place(*index), load(R_n), load(euler),
             std::isnan(carried) ? "" : "; the brush carries at most about " + load(carried));
  if (carried < R_n * (1 - kRough))
    write_message(fmt::format("warning: no gap carries the load at {}: {}\n", e.sweep.place(*index),
                              results::carried_text(point, carried, found.z_0_of_R_n_largest)));
}

// Prints how the bristles of the brush differ, where the sweep does not vary it.
void print_scatter(const Scatter& scatter) {
  if (!scatter.any()) return;
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < kScattered.size(); ++i)
    if (scatter.width[i] > 0)
      parts.push_back(fmt::format("{} {} {:g}", kScattered[i].name,
                                  scatter.uniform[i] ? "uniform within +-" : "normal with standard deviation",
                                  scatter.width[i]));
  fmt::print("scatter, relative, of {} different bristles: {}\n", scatter.bristles, fmt::join(parts, ", "));
}

}  // namespace

int run_command(const ExperimentOptions& input, const run::RunOptions& options,
                const std::string& instruction_set, bool needs_design) {
  choose_instruction_set(instruction_set);
  const Experiment experiment = load_checked(input);
  if (!options.quiet) print_warnings(experiment);
  run::RunOptions with_output = options;
  std::string suffix = experiment.tier == "full" ? "" : "-" + experiment.tier;
  if (input.point) suffix += fmt::format("-point-{}", *input.point);
  if (options.output.empty()) {
    if (experiment.source->inherits(JsonPointer("/name")))
      throw InputError(fmt::format(
          "{}: /name: is missing; with the inherited name {} the result would replace another experiment's; "
          "give a name, or the file of the result with -o",
          experiment.path, experiment.name));
    with_output.output = fmt::format("results/{}{}.h5", experiment.name, suffix);
  }
  if (input.point) {
    with_output.force = true;
    require_one_point(with_output.output);
  }
  const auto compute_it = options.output == "-" ? compute_to_standard_output : compute;
  return compute_it(experiment, with_output, needs_design) ? kSuccess : kCheckFailed;
}

int validate_command(const ExperimentOptions& options) {
  const Experiment e = load_checked(options);
  std::string sweep;
  for (const sweep::Axis& axis : e.sweep.axes)
    sweep += fmt::format("{}{} ({})", sweep.empty() ? "" : " x ", axis.name, range_text(axis));
  const std::size_t checks = json::Node(*e.source, "/checks").elements().size();
  fmt::print("{}: valid. {}: {} point{}{}{}, {} check{}\n",
             options.file == "-" ? "standard input" : options.file, e.name, e.sweep.size(),
             e.sweep.size() == 1 ? "" : "s", sweep.empty() ? "" : ", ", sweep, checks,
             checks == 1 ? "" : "s");
  print_scatter(e.sweep.base.setup.scatter);
  print_warnings(e);
  print_carried(e);
  if (e.sweep.base.si.empty()) return kSuccess;
  print_conversion(e);
  if (const auto kept = sweep::values_not_in_si(e.sweep.point(0)); !kept.empty())
    fmt::print("not given in the si block, so dimensionless and the same for any material: {}\n",
               fmt::join(kept, ", "));
  return kSuccess;
}

int schema_command() {
  fmt::print("{}\n", experiment::author_schema(claims::predicate_names()).dump(1));
  return kSuccess;
}

}  // namespace bristle::cli
