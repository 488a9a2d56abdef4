#pragma once

#include "bristle/ensemble/point.hpp"
#include "results/tables.hpp"
#include "results/variables.hpp"

#include <functional>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

namespace bristle::results {

class ResultReader;

// Lists the variables and tables of an experiment's result. Make one for all points of a sweep.
class PointLayout {
 public:
  explicit PointLayout(const Sweep& sweep);

  // The variables over the sweep, in the order in which the file is made. A name is the path from the root.
  std::vector<Column> variables;
  std::vector<std::string> groups;  // groups of these variables
  std::vector<std::string> tables;

  // Returns the index of a variable. Throws std::out_of_range if there is none of this name.
  std::size_t number(const std::string& name) const { return numbers_.at(name); }
  bool has(const std::string& name) const { return numbers_.contains(name); }
  // Returns 16 hexadecimal digits, which differ for other variables or tables.
  const std::string& digest() const { return digest_; }
  // Returns the values of all variables at a point.
  std::vector<double> values_of(const PointResult& point) const;

 private:
  // Appends the values of some variables that follow each other.
  using Append = std::function<void(const PointResult&, std::vector<double>&)>;

  void add(const ResultVariable& variable, bool searched);

  std::vector<Append> append_;                            // all variables, in their order
  std::unordered_map<std::string, std::size_t> numbers_;  // indices of the variables, by name
  std::string digest_;
};
using Layout = std::shared_ptr<const PointLayout>;
Layout layout_of(const Sweep& sweep);

// The numbers of one sweep point in the form of a result file. Runs compute records, journals store them, and
// `verify --rerun` reads them from results. Every NaN has the same bits.
struct PointRecord {
  Layout layout;
  std::vector<double> values{};  // by variable
  std::vector<Rows> tables{};    // columns of each table, except the first, "point"
  std::string failure{};         // the error of a point with the status failed

  // Returns the value of a variable. Throws std::out_of_range if there is no such variable.
  double at(const std::string& variable) const { return values[layout->number(variable)]; }
};

PointRecord record_of(const Layout& layout, const PointResult& result, const Recorded& recorded);
// Returns the record of a point that an error ended: status failed, no values.
PointRecord failed_record(const Layout& layout, const std::string& error);

// Returns why a variable has no value at a point that has values, in words: the lift-off load, because its
// formula was not tested there.
std::string why_missing(const PointRecord& record, const ResultVariable& variable);

// Reads a point from a result file of this sweep. Throws RunError if it cannot be read.
PointRecord read_record(const ResultReader& result, const Sweep& sweep, std::size_t index);

// Returns the name of the attribute of the group kFailures that has the error of a point.
std::string failure_name(std::size_t index);

// Returns whether the record has the numbers of its layout, with consistent lengths and valid status codes.
bool is_consistent(const PointRecord& record);

// Returns the variables and tables whose bits differ between records of the same layout.
std::vector<std::string> differences(const PointRecord& a, const PointRecord& b);

}  // namespace bristle::results
