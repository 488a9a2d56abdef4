#pragma once

#include "experiment/document.hpp"
#include "interface/point.hpp"

#include <string>
#include <vector>

namespace bristle {

// One dimension of a sweep: a model parameter, R_n or z_0, with ascending values.
struct Axis {
  std::string name;
  std::vector<double> values;
};

// What a point of the sweep is computed from.
struct PointInput {
  Interface interface;
  Loading loading;
};

// A validated experiment in dimensionless form.
struct Experiment {
  std::string name, title, figure, path, tier;
  PointInput base;         // before the sweep's values
  std::vector<Axis> axes;  // in the file's order; the last varies fastest
  bool record_bristles = false;
  Engine engine = Engine::fast;
  Json checks = Json::array();
  Json document;  // as run: extends, tier and --set applied

  std::size_t points() const;
  std::vector<std::size_t> shape() const;
  PointInput point(std::size_t index) const;
};

// Throws InputError for whatever is wrong with it, naming source, JSON pointer, value and remedy.
Experiment load_experiment(const std::string& path, const DocumentOptions& options);

}  // namespace bristle
