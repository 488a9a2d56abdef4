#pragma once

#include "experiment/check.hpp"
#include "experiment/design.hpp"
#include "experiment/document.hpp"
#include "experiment/sweep.hpp"

#include <memory>
#include <string>
#include <vector>

namespace bristle::experiment {

// Variables of the result whose values over a sample are analysed.
struct Analysis {
  std::vector<std::string> sobol_indices, quantiles;
};

// A validated experiment in dimensionless form.
struct Experiment {
  std::string name, title, figure, path, tier;
  bool has_study_tier = false;        // `assumptions` evaluates its checks, too
  Sweep sweep;                        // its points; of a design, until its trials are known, their extremes
  std::string locate_jumps;           // axis along which jumps of z_0 are located; empty: none
  std::vector<std::string> warnings;  // values that have no effect, or another unit than the rest
  Analysis analysis;
  std::optional<Design> design;  // its trials are the sample
  std::vector<Check> checks;
  std::shared_ptr<const Json> document;  // with extends, tier and --set applied
};

// Throws InputError for every mistake in the experiment, with source, JSON pointer, value and remedy. The
// second model of a design, and the extremes of its quantities, are checked as if they had been written.
Experiment load_experiment(const std::string& path, const DocumentOptions& options);
// The experiment of a result file, from the document and the tier stored there, with changes as by --set.
// Throws as load_experiment().
Experiment stored_experiment(const Json& document, const std::string& tier, const std::string& source,
                             const std::vector<std::string>& set = {});

// The document of one point of the experiment: each axis has the point's value only, and a sample is a table
// of one row. Leaves out what needs more points: checks, analysis, jumps and the search of a design.
Json document_of_point(const Experiment& experiment, std::size_t index);

// The experiment of a design under its second model: the choice is an axis of one word. Requires one.
Experiment second_model_of(const Experiment& experiment);

// The sweep's axes with all their values. Throws InputError for an unknown parameter, an empty or unsorted
// axis, a value outside the parameter's range, and more than kMaxPoints points in total.
std::vector<Axis> read_axes(const Document& document);

constexpr double kMaxPoints = 1e7;

}  // namespace bristle::experiment

namespace bristle {
using experiment::Experiment;
}
