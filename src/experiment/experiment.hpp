#pragma once

#include "experiment/check.hpp"
#include "experiment/design.hpp"
#include "experiment/document.hpp"
#include "experiment/sweepable.hpp"

#include <memory>
#include <string>
#include <vector>

namespace bristle::experiment {

// One dimension of a sweep: the name of a Sweepable, and its ascending values or, for a choice, the indices
// of its options. The axis "sample" has the numbers of its points as values, and a column for each quantity
// that they vary together, with a value for each point in any order.
struct Axis {
  std::string name;
  std::vector<double> values;
  std::vector<Axis> columns{};

  const Sweepable& quantity() const;
  // Assigns the value, or those of all columns, at this index.
  void set(PointInput& point, std::size_t index) const;
  void keep_first();  // value only
};

// Whether an axis, or a column of the sample, varies this quantity.
bool swept(const std::vector<Axis>& axes, const std::string& name);

// Variables of the result whose values over a sample are analysed.
struct Analysis {
  std::vector<std::string> sobol_indices, quantiles;
};

// A validated experiment in dimensionless form.
struct Experiment {
  std::string name, title, figure, path, tier;
  bool has_study_tier = false;        // `assumptions` evaluates its checks, too
  PointInput base;                    // before the sweep's values
  std::vector<Axis> axes;             // in the file's order; the last varies fastest
  bool C_peaks_at_V_s = true;         // C is computed from A at every point, so that chi peaks at V_R = V_s
  std::string locate_jumps;           // axis along which jumps of z_0 are located; empty: none
  std::vector<std::string> warnings;  // values that have no effect, or another unit than the rest
  Recording record;
  Analysis analysis;
  std::optional<Design> design;  // its trials are the sample
  Engine engine = Engine::fast;
  std::shared_ptr<const ModulationTable> friction_law;  // of the word "custom"; null: no point has it
  std::string azimuths_sha256;  // of base.setup.orientation.theta_0, which may have many values
  std::vector<Check> checks;
  std::shared_ptr<const Json> document;  // with extends, tier and --set applied

  std::size_t points() const;
  std::vector<std::size_t> shape() const;
  PointInput point(std::size_t index) const;
  // The point's coordinates for messages: "k_r = 2, friction = nss".
  std::string place(std::size_t index) const;
  bool swept(const std::string& name) const;
  bool on_lattice() const;  // for at least one point
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

// Exactly the input that determines a point's numbers, as text: the same text for equal points of any two
// experiments, regardless of names, axes and their order. Choices are written as words, so that inserting
// or reordering friction laws does not change the meaning of stored keys.
std::string canonical_point(const Experiment& experiment, std::size_t index);

// The sweep's axes with all their values. Throws InputError for an unknown parameter, an empty or unsorted
// axis, a value outside the parameter's range, and more than kMaxPoints points in total.
std::vector<Axis> read_axes(const Document& document);

constexpr double kMaxPoints = 1e7;

// Whether two points of experiments that differ in points only have the same numbers.
bool same_effect(const PointInput& a, const PointInput& b);
// The axes along which all points have the same numbers, such as mu_c where no friction law reads it.
std::vector<std::string> axes_without_effect(const Experiment& experiment);

}  // namespace bristle::experiment

namespace bristle {
using experiment::Experiment;
}
