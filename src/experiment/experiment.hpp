#pragma once

#include "experiment/check.hpp"
#include "experiment/document.hpp"
#include "experiment/sweepable.hpp"

#include <memory>
#include <string>
#include <vector>

namespace bristle {

// One dimension of a sweep: a sweepable's name, with ascending values or, for a choice, indices of its
// options.
struct Axis {
  std::string name;
  std::vector<double> values;
};

bool swept(const std::vector<Axis>& axes, const std::string& name);

// A validated experiment in dimensionless form.
struct Experiment {
  std::string name, title, figure, path, tier;
  PointInput base;         // before the sweep's values
  std::vector<Axis> axes;  // in the file's order; the last varies fastest
  bool C_peaks_at_V_s = true;  // C follows A at every point, so that chi peaks at V_R = V_s
  Recording record;
  Engine engine = Engine::fast;
  std::vector<Check> checks;
  std::shared_ptr<const Json> document;  // as run: extends, tier and --set applied

  std::size_t points() const;
  std::vector<std::size_t> shape() const;
  PointInput point(std::size_t index) const;
  // The point's coordinates for messages: "k_r = 2, friction = nss".
  std::string place(std::size_t index) const;
  bool swept(const std::string& name) const;
  bool on_lattice() const;  // at one point at least
};

// Throws InputError for whatever is wrong with it, naming source, JSON pointer, value and remedy.
Experiment load_experiment(const std::string& path, const DocumentOptions& options);
// The experiment that a result file was computed from, from its document and tier. Throws as above.
Experiment stored_experiment(const Json& document, const std::string& tier, const std::string& source);

}  // namespace bristle
