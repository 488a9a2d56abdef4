#pragma once

#include "experiment/experiment.hpp"
#include "results/record.hpp"
#include "util/file.hpp"

#include <map>

namespace bristle::results {

// The columns of /jumps but "point"; those of the axes beside that along which the gap jumps are the last.
std::vector<Column> jump_columns(const Sweep& sweep, const std::string& along);

// A dimension of a group: words with their codes, or numbers.
struct GroupDimension {
  Column column;
  std::vector<std::string> words;
  std::vector<double> values;
};

GroupDimension word_dimension(const std::string& name, const std::string& meaning,
                              const std::vector<std::string>& words);

// Variables over some axes of the sweep and over dimensions of their own.
struct Group {
  std::string name;
  std::vector<std::size_t> axes;  // indices
  std::vector<GroupDimension> dimensions;
  std::vector<Column> columns;
  std::vector<std::vector<double>> values;  // by column, in row-major order
};

// Writes a result file point by point under a temporary name, which publish() replaces by the final name.
// Without publish() an existing file remains unchanged and the temporary file is removed.
class ResultWriter {
 public:
  // Throws InputError if path cannot be written.
  ResultWriter(const Experiment& experiment, const std::string& path);

  // Call for every point, in ascending order of index. Requires fits(record, experiment).
  void write(std::size_t index, const PointRecord& record);

  // Call after write(). Adds the group /jumps. rows: as locate_jumps() returns them; along: name of the axis.
  void write_jumps(const std::string& along, const Rows& rows);

  // Call after write().
  void write_group(const Group& group);

  // Adds attributes, digest and provenance (name -> text), closes the file, and verifies it by reading it
  // back.
  void close(const std::map<std::string, std::string>& provenance);
  // Temporary name of the closed file, for additions before publish().
  const std::string& partial() const { return whole_.partial(); }
  // Renames the closed file to its final name.
  void publish() { whole_.publish(); }

 private:
  void create_axis(const experiment::Axis& axis);
  void create_sample(const experiment::Axis& axis);
  void add_scale(h5::Handle dataset);
  void create_variables();
  void finish(const std::map<std::string, std::string>& provenance);

  const Experiment& experiment_;
  const PointLayout layout_;
  WholeFile whole_;
  h5::Handle file_;
  h5::Shape shape_;  // of the sweep, and of the nodes of traced curves
  std::vector<h5::Handle> axes_;
  std::vector<BlockWriter> variables_;  // in the order of layout_.datasets
  std::map<std::string, TableWriter> tables_;
  std::vector<std::pair<std::string, std::string>> failures_;  // errors of failed points, by failure_name()
};

}  // namespace bristle::results
