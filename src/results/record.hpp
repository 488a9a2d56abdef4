#pragma once

#include "bristle/ensemble/trace.hpp"
#include "results/tables.hpp"
#include "results/variables.hpp"

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

namespace bristle::results {

class ResultReader;

// Lists the variables and tables of an experiment's result. Make one for all points of a sweep.
class PointLayout {
 public:
  explicit PointLayout(const Sweep& sweep);

  // A variable over the sweep. Its name is the path from the root.
  struct Variable : Column {
    std::function<double(const PointResult&)> value;            // empty for the variable "branch"
    double missing = std::numeric_limits<double>::quiet_NaN();  // value at nodes that a curve lacks
  };
  std::vector<Variable> variables;  // in the order in which the file is made
  std::vector<std::string> groups;  // groups of these variables
  std::vector<std::string> tables;
  std::optional<std::size_t> nodes;  // largest number of nodes of a curve; none without curves

  // Returns the index of a variable. Throws std::out_of_range if there is none of this name.
  std::size_t number(const std::string& name) const { return numbers_.at(name); }
  bool has(const std::string& name) const { return numbers_.contains(name); }
  // Returns 16 hexadecimal digits, which differ for other variables, tables or numbers of nodes.
  const std::string& digest() const { return digest_; }

 private:
  void add(const ResultVariable& variable, bool searched);

  std::unordered_map<std::string, std::size_t> numbers_;  // indices of the variables, by name
  std::string digest_;
};
using Layout = std::shared_ptr<const PointLayout>;
Layout layout_of(const Sweep& sweep);

// The numbers of one sweep point in the form of a result file. Runs compute records, journals store them, and
// `verify --rerun` reads them from results. Every NaN has the same bits.
struct PointRecord {
  Layout layout;
  std::vector<double> values{};  // values by variable, then by node of a curve
  std::vector<Rows> tables{};    // columns of each table, except the first, "point"
  std::string failure{};         // the error of a point with the status failed

  std::size_t nodes() const { return values.size() / layout->variables.size(); }  // 1 without a curve
  // Returns the value at each node. Throws std::out_of_range if there is no such variable.
  std::span<const double> at(const std::string& variable) const;
};

PointRecord record_of(const Layout& layout, const PointResult& result, const Recorded& recorded);
PointRecord record_of(const Layout& layout, const std::vector<CurveNode>& curve);
// Returns the record of a point that an error ended: status failed, no values, a curve with one node.
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
