#pragma once

#include "experiment/experiment.hpp"
#include "results/part.hpp"
#include "results/record.hpp"
#include "results/table.hpp"

#include <map>

namespace bristle {

// Writes a result file point by point, under a temporary name beside the final one; publish() gives
// it its name. Without publish() the final name is untouched and the temporary file removed.
class ResultWriter {
 public:
  // Of a shard: the file is a part, with these points only. Throws InputError if the output cannot be written
  // there.
  ResultWriter(const Experiment& experiment, const std::string& path, const std::optional<Shard>& shard = {});
  ~ResultWriter();

  // Call in ascending order of index: what is recorded is appended. The record must fit the experiment.
  void write(std::size_t index, const PointRecord& record);

  // Adds attributes, digest and provenance (name -> text), closes, and reads back what was written.
  void close(const std::map<std::string, std::string>& provenance);
  // The closed file under its temporary name, for what else is to be added.
  const std::string& partial() const { return partial_; }
  // Gives the closed file its name.
  void publish();

 private:
  void create();
  void discard();
  void create_part();
  void create_axis(const Axis& axis);
  void create_scale(const std::string& name, hid_t type, const std::vector<double>& values,
                    const std::array<std::string, 3>& label);  // symbol, description, units
  void create_variables();
  h5::Handle create_variable(hid_t parent, const std::string& name, hid_t type, const std::string& long_name,
                             const std::string& symbol, const std::string& equation,
                             const std::string& units = "1");
  void create_flags(const std::string& name, const std::string& long_name,
                    const std::vector<std::string>& meanings, int absent);

  const Experiment& experiment_;
  std::string path_, partial_;
  std::optional<Shard> shard_;
  bool curves_;    // of R_n(z_0), along a last dimension "node"
  bool searched_;  // the gap was searched for: errors have a part from that
  int lock_ = -1;  // descriptor that keeps other runs off the temporary file
  h5::Handle file_, load_error_;
  h5::Shape shape_;
  std::vector<h5::Handle> axes_;
  std::map<std::string, h5::Handle> variables_;
  std::map<std::string, Table> tables_;
  bool published_ = false;
};

}  // namespace bristle
