#pragma once

#include "experiment/experiment.hpp"
#include "results/record.hpp"

#include <map>

namespace bristle::results {

// Writes a result file point by point under a temporary name, which publish() replaces by the final name.
// Without publish() an existing file remains unchanged and the temporary file is removed.
class ResultWriter {
 public:
  // Throws InputError if path cannot be written.
  ResultWriter(const Experiment& experiment, const std::string& path);
  ~ResultWriter();

  // Call for every point, in ascending order of index. Requires fits(record, experiment).
  void write(std::size_t index, const PointRecord& record);

  // Call after write(). Adds the group /jumps. rows: as locate_jumps() returns them; along: name of the axis.
  void write_jumps(const std::string& along, const Rows& rows);

  // Adds attributes, digest and provenance (name -> text), closes the file, and verifies it by reading it
  // back.
  void close(const std::map<std::string, std::string>& provenance);
  // Temporary name of the closed file, for additions before publish().
  const std::string& partial() const { return partial_; }
  // Renames the closed file to its final name.
  void publish();

 private:
  void create();
  void discard();
  void write_values(std::size_t index, const PointRecord& record);
  void finish(const std::map<std::string, std::string>& provenance);
  void create_axis(const experiment::Axis& axis);
  void create_scale(const Column& column, const std::vector<double>& values);
  void add_scale(h5::Handle dataset, const std::string& name);
  void create_variables();
  // missing: the value of nodes that a curve does not have.
  void add_variable(const Column& column, double missing, const std::string& group = "");

  struct OverSweep {
    BlockWriter values;
    double missing;
  };

  const Experiment& experiment_;
  std::string path_, partial_;
  bool curves_;    // of R_n(z_0), along a last dimension "node"
  bool searched_;  // the gap follows from a load search: errors have a part due to the load
  int lock_ = -1;  // descriptor that holds the lock of the temporary file
  h5::Handle file_, load_error_;
  h5::Shape shape_;
  std::vector<h5::Handle> axes_;
  std::map<std::string, OverSweep> variables_;
  std::map<std::string, Table> tables_;
  std::map<std::size_t, std::string> failures_;  // errors of failed points, by index
  bool published_ = false;
};

}  // namespace bristle::results
