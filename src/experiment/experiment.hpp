#pragma once

#include "experiment/ranges.hpp"
#include "json/document.hpp"
#include "sweep/sweep.hpp"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace bristle::experiment {

// A validated experiment in dimensionless form. The blocks that say what to do with the points ("checks",
// "analysis", "design") are read by the folders that do it, from `source`.
struct Experiment {
  std::string name, title, figure, path, tier;
  bool has_study_tier = false;  // `assumptions` evaluates its checks, too
  Sweep sweep;                  // its points; of a design, until its trials are known, their extremes
  Ranges ranges;                // quantities that the trials of a design vary; empty without a design
  std::string locate_jumps;     // axis along which jumps of z_0 are located; empty: none
  std::vector<std::string>
      warnings;  // values that have no effect, or another unit than the rest; mistakes in other tiers
  std::shared_ptr<const json::Document> source;  // with extends, tier and --set applied
  std::shared_ptr<const Json> document;          // the content of source, without tiers
};

// Reads the other blocks of an experiment. Throws InputError for a mistake in them.
using ReadBlocks = std::function<void(const Experiment&)>;

// Reads an experiment file. Throws InputError for every mistake in the experiment, with source, JSON pointer,
// value and remedy, also for mistakes that read_blocks finds. A mistake in another tier than the tier of the
// options is a warning. The extremes of the quantities of a design are checked as if they had been written.
Experiment load_experiment(
    const std::string& path, const json::DocumentOptions& options,
    const ReadBlocks& read_blocks = [](const Experiment&) {});
// Reads the experiment of a result file from the document and the tier stored there, with changes as by
// --set. source: name of the document in messages. Throws as load_experiment().
Experiment stored_experiment(const Json& document, const std::string& tier, const std::string& source,
                             const std::vector<std::string>& set = {});
// Reads an experiment that the program has made. Throws InputError whose message names no file.
Experiment made_experiment(const Json& document);

// Returns the document of one point of the experiment: each axis has the point's value only, and a sample is
// a table of one row. Leaves out what needs more points: checks, analysis, jumps and the search of a design.
Json document_of_point(const Experiment& experiment, std::size_t index);

// Returns the sweep's axes with all their values. Throws InputError for an unknown parameter, an empty or
// unsorted axis, a value outside the parameter's range, and more than kMaxPoints points in total.
std::vector<sweep::Axis> read_axes(const json::Document& document);

constexpr double kMaxPoints = 1e7;

}  // namespace bristle::experiment

namespace bristle {
using experiment::Experiment;
}
