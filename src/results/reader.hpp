#pragma once

#include "experiment/experiment.hpp"
#include "results/hdf5.hpp"
#include "results/part.hpp"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace bristle {

// A numeric variable of a result file, values in row-major order.
struct Variable {
  std::vector<std::string> dimensions;
  std::vector<std::size_t> shape;
  std::vector<double> values;
};

// What a reader is to be given: a whole result, a part of one, or either.
enum class Expected {
  whole,
  part,
  either
};

// Reads result files. Throws InputError that names file and dataset for what is not a result, is of an
// unknown schema version, is a part where the whole is expected or the reverse, or is missing.
class ResultReader {
 public:
  explicit ResultReader(const std::string& path, Expected expected = Expected::whole);

  const std::string& path() const { return path_; }
  hid_t file() const { return file_; }
  std::vector<std::string> variables() const;  // numeric datasets of the root
  Variable variable(const std::string& name) const;
  // The words that a flag variable's values 0, 1, ... stand for; none for another.
  std::vector<std::string> flag_meanings(const std::string& name) const;
  bool has(const std::string& name) const;  // a dataset or group
  std::string text(const std::string& attribute) const;
  Json experiment() const;
  std::map<std::string, std::string> provenance() const;  // empty if there is none
  std::vector<std::string> axes() const;                  // of the sweep, by the names of their variables
  std::vector<std::size_t> sweep_shape() const;           // a traced curve is one point
  std::optional<Shard> shard() const;            // of a part; none for a whole result
  std::vector<std::size_t> part_points() const;  // of a part: indices of its points, ascending

 private:
  void require(Expected expected) const;

  std::string path_;
  h5::Handle file_;
};

// Whether the file exists and holds a whole result, of any version.
bool holds_whole_result(const std::string& path);

// Whether the file already holds the numbers of this experiment, or of this shard of it, complete and intact.
bool up_to_date(const std::string& path, const Experiment& experiment,
                const std::optional<Shard>& shard = {});

// The name of an axis in the file: a swept R_n or z_0 is an input, R_n_target; the value reached is R_n.
std::string axis_variable(const std::string& name);

}  // namespace bristle
