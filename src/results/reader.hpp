#pragma once

#include "experiment/document.hpp"
#include "results/hdf5.hpp"

#include <string>
#include <vector>

namespace bristle {

// A numeric variable of a result file, values in row-major order.
struct Variable {
  std::vector<std::string> dimensions;
  std::vector<std::size_t> shape;
  std::vector<double> values;
};

// Reads result files. Throws InputError that names file and dataset for what is not a result, is of an
// unknown schema version, or is missing.
class ResultReader {
 public:
  explicit ResultReader(const std::string& path);

  const std::string& path() const { return path_; }
  hid_t file() const { return file_; }
  std::vector<std::string> variables() const;  // numeric datasets of the root
  Variable variable(const std::string& name) const;
  // The words that a flag variable's values 0, 1, ... stand for; none for another.
  std::vector<std::string> flag_meanings(const std::string& name) const;
  std::string text(const std::string& attribute) const;
  Json experiment() const;

 private:
  std::string path_;
  h5::Handle file_;
};

}  // namespace bristle
