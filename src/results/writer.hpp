#pragma once

#include "experiment/experiment.hpp"
#include "results/record.hpp"
#include "results/table.hpp"

#include <map>

namespace bristle::results {

// Writes a result file point by point under a temporary name, which publish() replaces by the final name.
// Without publish() an existing file remains unchanged and the temporary file is removed.
class ResultWriter {
 public:
  // Throws InputError if path cannot be written.
  ResultWriter(const Experiment& experiment, const std::string& path);
  ~ResultWriter();

  // Call in ascending order of index, because tables are appended to. Requires fits(record, experiment).
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
  void create_choice(const experiment::Axis& axis, const experiment::Sweepable& what);
  void create_scale(const std::string& name, hid_t type, const std::vector<double>& values,
                    const std::array<std::string, 3>& label);  // symbol, description, units
  void add_scale(h5::Handle dataset, const std::string& name, const std::array<std::string, 3>& label);
  void create_variables();
  h5::Handle create_variable(hid_t parent, const std::string& name, hid_t type, const std::string& long_name,
                             const std::string& symbol, const std::string& equation,
                             const std::string& units = "1", const std::string& ancillary = "");
  void add_variable(const std::string& name, h5::Handle dataset, double missing);
  void create_flags(const std::string& name, const std::string& long_name,
                    const std::vector<std::string>& meanings, int absent);

  const Experiment& experiment_;
  std::string path_, partial_;
  bool curves_;    // of R_n(z_0), along a last dimension "node"
  bool searched_;  // the gap follows from a load search: errors have a part due to the load
  int lock_ = -1;  // descriptor that holds the lock of the temporary file
  h5::Handle file_, load_error_;
  h5::Shape shape_;
  std::vector<h5::Handle> axes_;
  std::map<std::string, BlockWriter> variables_;
  std::map<std::string, Table> tables_;
  std::map<std::size_t, std::string> failures_;  // errors of failed points, by index
  bool published_ = false;
};

}  // namespace bristle::results
