#pragma once

#include "experiment/experiment.hpp"
#include "results/dataset.hpp"
#include "results/version.hpp"
#include "util/file.hpp"

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace bristle::results {

// Reads result files, which are not trusted: a file is opened only after damage_of() has read it in a process
// of its own. Throws InputError with file and dataset if the file is not a result, cannot be read or has an
// unknown schema version, and if a dataset or attribute is missing.
class ResultReader {
 public:
  explicit ResultReader(const std::string& path);
  // Reads a result in memory that an archive contained. name: for messages. Throws MalformedError if the
  // bytes cannot be read.
  ResultReader(const std::string& name, const std::string& bytes);

  // Returns what is damaged; empty if digests and contents match. Code that draws conclusions from the
  // numbers calls require_intact(), which throws InputError if anything is damaged.
  const std::vector<std::string>& damage() const { return damage_; }
  void require_intact() const;
  const std::string& path() const { return path_; }
  bool has(const std::string& name) const;  // true for a dataset or group
  // Returns the names in a group in ascending order; "": in the root.
  std::vector<std::string> names(const std::string& group) const;
  bool is_group(const std::string& name) const;
  // Returns the paths from the root, such as "R_x" and "bristles/theta_0", of the datasets that digests
  // cover. The axis of a choice stands for its words and codes.
  std::vector<std::string> datasets() const;
  std::vector<std::string> variables() const;  // datasets of the root
  // Returns the values of a dataset; for the axis of a choice, codes with their words. Each dataset is read
  // from the file once; the reference is valid as long as this reader.
  const Array& variable(const std::string& name) const;
  bool has_text(const std::string& attribute) const;
  // Returns a text with control characters escaped, because texts, including the texts of /provenance and
  // /failures, are untrusted.
  std::string text(const std::string& attribute) const;
  std::string raw_text(const std::string& attribute) const;  // text without escapes, such as JSON
  long integer(const std::string& attribute) const;
  // Returns the document of the experiment, which is parsed once.
  const Json& experiment() const;
  // Returns a text of a group, with its line feeds; empty if there is no such group or text.
  std::string lines(const std::string& group, const std::string& name) const;
  // Returns the attributes of the group /provenance; empty if there is no such group.
  std::map<std::string, std::string> provenance() const { return text_attributes("provenance"); }
  // Returns the attributes of the group /failures; empty if there is no such group.
  std::map<std::string, std::string> failures() const { return text_attributes(kFailures); }
  std::vector<std::string> axes() const;            // names of the variables of the sweep's axes
  std::vector<std::string> sample_columns() const;  // variables over the axis "sample"; empty without it
  std::vector<std::string> coordinates() const;     // the names that place a point: axes and sample columns
  std::vector<std::size_t> sweep_shape() const;     // number of values of each axis

 private:
  struct Open;  // the open file

  void require_schema() const;
  std::map<std::string, std::string> text_attributes(const std::string& group) const;

  std::string path_;
  std::vector<std::string> damage_;
  std::shared_ptr<const Open> file_;
  mutable std::map<std::string, Array> read_;  // arrays that variable() has read, by name
  mutable std::shared_ptr<const Json> experiment_;
};

// Returns the kind of file that a run may replace: results of any version.
FileKind result_file();

// Returns true if the file contains the numbers of this experiment, complete and undamaged.
bool up_to_date(const std::string& path, const Experiment& experiment);

// Returns the coordinates of a value, such as "k_r = 2, k_theta = 0.3"; the row number for a dimension
// without coordinates.
std::string place(const ResultReader& result, const std::string& name, std::size_t index);

// Returns the name of an axis in the file. A swept R_n or z_0 becomes R_n_target or z_0_target, because R_n
// and z_0 are the computed values.
std::string axis_variable(const std::string& name);
// Returns the name of the variable with the codes of a swept choice, whose axis contains the words.
std::string code_variable(const std::string& choice);

}  // namespace bristle::results
