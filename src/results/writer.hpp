#pragma once

#include "experiment/experiment.hpp"
#include "results/record.hpp"
#include "util/file.hpp"

#include <map>
#include <memory>
#include <variant>

namespace bristle::results {

// Returns the columns of /jumps except "point". The last ones are the axes other than `along`, along which
// the gap jumps.
std::vector<Column> jump_columns(const Sweep& sweep, const std::string& along);

// Writes a result file point by point under a temporary name, which publish() changes to the final name.
// Without publish() an existing file remains unchanged and the temporary file is removed.
class ResultWriter {
 public:
  // Throws InputError if path cannot be written.
  ResultWriter(const Experiment& experiment, const std::string& path);
  ~ResultWriter();

  // Writes a point. Call it for every point, in ascending order of index. Requires the layout of the
  // experiment, and is_consistent(record).
  void write(std::size_t index, const PointRecord& record);

  // Adds the group /jumps. Call it after write(). rows: as locate_jumps() returns them; along: name of the
  // axis
  void write_jumps(const std::string& along, const Rows& rows);

  // Adds a group, whose axes must be axes of the sweep. Call it after write().
  void write_group(const Dataset& data);

  // Adds attributes, digest and provenance (name -> text), closes the file, and verifies it by reading it
  // back.
  void close(const std::map<std::string, std::string>& provenance);
  // Returns the temporary name of the closed file, for additions before publish().
  const std::string& partial() const { return whole_.partial(); }
  // Renames the closed file to its final name.
  void publish() { whole_.publish(); }

 private:
  struct Open;  // the file, and what is written to it

  void finish(const std::map<std::string, std::string>& provenance);

  const Experiment& experiment_;
  const PointLayout layout_;
  WholeFile whole_;
  std::unique_ptr<Open> open_;
  std::vector<std::pair<std::string, std::string>> failures_;  // errors of failed points, by failure_name()
};

// Replaces a group that no digest covers in an existing result file; removes the group if the dataset has no
// values.
void replace_group(const std::string& path, const Dataset& data);

// An attribute of an object in a result file, such as "slab_force/t"; "/" is the file itself.
struct Attribute {
  std::string object, name;
  std::variant<std::string, long, double> value;
  bool unless_present = false;  // keep the value that the file has
};
void write_attributes(const std::string& path, const std::vector<Attribute>& attributes);

// Returns the version of the HDF5 library, such as "1.10.8".
std::string hdf5_version();
// Makes errors of HDF5 exceptions. Call it before all other functions that read or write results.
void start_hdf5();

}  // namespace bristle::results
