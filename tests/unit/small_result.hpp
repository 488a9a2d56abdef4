#pragma once

#include "compare/reference.hpp"
#include "claims/store.hpp"
#include "claims/checks.hpp"
#include "experiment/experiment.hpp"
#include "results/digest.hpp"
#include "results/hdf5.hpp"
#include "results/inspect.hpp"
#include "results/reader.hpp"
#include "results/version.hpp"
#include "results/writer.hpp"
#include "scratch.hpp"

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

// Results of 2 x 3 points with invented, known numbers, and functions to damage them.
namespace bristle::testing {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
using Change = std::function<void(std::size_t, PointResult&)>;

inline PointResult small_point(std::size_t i) {
  PointResult p;
  p.z_0 = 0.5 + 0.01 * double(i);
  p.z_0_error = 1e-4;
  for (std::size_t k = 0; k < p.value.size(); ++k) p.value[k] = 1 + 0.1 * double(k) + 0.5 * double(i);
  p.error.fill(1e-3);
  p.R_x_norm.value = 0.8 - 0.1 * double(i);
  p.R_x_norm.error = 1e-3;
  p.R_y_norm.error = 1e-3;
  p.jump_z_0 = p.jump_R_n = p.incomplete_theta_0 = kNone;
  p.passages = 100;
  return p;
}

inline Experiment small_experiment(const Scratch& s, const std::string& more = "",
                                   const std::string& tier = "smoke") {
  s.write("paper.json", bytes_of(std::string(BRISTLE_EXPERIMENTS) + "/paper.json"));
  return load_experiment(s.write("small.json", R"({"extends": "paper.json", "name": "small",
        "sweep": {"k_r": {"values": [5, 20]}, "k_theta": {"values": [0.3, 1, 3]}},
        "checks": [{"claim": "x", "statement": "falls", "predicate": "end_ratio", "variable": "R_x_norm",
                    "along": "k_r", "is": "at_most", "threshold": 0.99}])" +
                                                   more + "}"),
                         {{}, tier});
}

// Writes the result and returns its path.
inline std::string small_result(const Scratch& s, const std::string& file, const Experiment& experiment,
                                const Change& change = {}, const std::string& commit = "0123abc") {
  ResultWriter writer(experiment, s.path(file));
  for (std::size_t i = 0; i < experiment.sweep.size(); ++i) {
    PointResult p = small_point(i);
    if (change) change(i, p);
    writer.write(i, record_of(layout_of(experiment.sweep), p, {}));
  }
  writer.close({{"commit", commit}, {"experiment_file", experiment.path}});
  writer.publish();
  return s.path(file);
}

inline std::string small_result(const Scratch& s, const std::string& file, const Change& change = {}) {
  return small_result(s, file, small_experiment(s), change);
}

inline Json reference_of(const std::string& path) {
  const ResultReader result(path);
  return Json::parse(file_text(make_reference(result, evaluate_checks(result))));
}

// Compares a result with a reference that a test has changed.
inline Comparison compare_with(const ResultReader& result, const std::vector<CheckResult>& checks,
                               const Json& reference, const std::string& label) {
  return compare_with_reference(result, checks, parse_reference(json_lines(reference), label), label);
}

inline void put(const std::string& path, const std::string& name, const h5::Shape& at, double value) {
  const h5::Handle file = h5::open_file(path, true), dataset = h5::open_dataset(file, name);
  h5::write_part(dataset, H5T_NATIVE_DOUBLE, at, h5::Shape(at.size(), 1), &value);
}

inline void remove_dataset(const std::string& path, const std::string& name) {
  const h5::Handle file = h5::open_file(path, true);
  h5::check(H5Ldelete(file, name.c_str(), H5P_DEFAULT), "removing " + name);
}

// Adds a dataset of ones without dimension scales.
inline void add_dataset(const std::string& path, const std::string& name, const h5::Shape& shape) {
  const h5::Handle file = h5::open_file(path, true);
  const h5::Handle dataset = h5::create_dataset(file, name, H5T_NATIVE_DOUBLE, shape);
  std::size_t size = 1;
  for (const hsize_t n : shape) size *= n;
  const std::vector<double> ones(size, 1);
  h5::write_part(dataset, H5T_NATIVE_DOUBLE, h5::Shape(shape.size(), 0), shape, ones.data());
}

}  // namespace bristle::testing
