#pragma once

#include "ensemble/trace.hpp"
#include "results/tables.hpp"
#include "results/variables.hpp"

#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace bristle::results {

class ResultReader;

// The numbers of one sweep point in the form of a result file. Runs compute records, journals store them, and
// `verify --rerun` reads them from results. Every NaN has the same bits.
struct PointRecord {
  std::map<std::string, std::vector<double>> values;  // by dataset: one number, or one per node of a curve
  std::map<std::string, Rows> tables;                 // by table: its columns except the first, "point"
  std::string failure;                                // the error of a point with the status failed
};

// The variables and tables that a result of an experiment has. Make one for all points of a sweep.
struct PointLayout {
  PointLayout(const Sweep& sweep);

  // A variable over the sweep. Its name is the path from the root.
  struct Variable : Column {
    std::function<double(const PointResult&)> value;            // empty for the branch of a curve's nodes
    double missing = std::numeric_limits<double>::quiet_NaN();  // for nodes that a curve does not have
  };
  std::vector<Variable> variables;  // in the order in which the file is made
  std::vector<std::string> groups;  // of these variables
  std::vector<std::string> tables;
  std::optional<std::size_t> nodes;  // largest number, of a curve

 private:
  void add(const ResultVariable& variable, bool searched);
};

PointRecord record_of(const PointLayout& layout, const PointResult& result, const Recorded& recorded);
PointRecord record_of(const PointLayout& layout, const std::vector<CurveNode>& curve);
// A point that an error ended: status failed, no values, a curve with one node.
PointRecord failed_record(const PointLayout& layout, const std::string& error);

// Reads a point from a result file of this sweep. Throws RunError if it cannot be read.
PointRecord read_record(const ResultReader& result, const Sweep& sweep, std::size_t index);

// Name of the attribute of the group kFailures that has the error of a point.
std::string failure_name(std::size_t index);

// Whether the record has exactly these datasets and tables, with consistent lengths and valid status codes.
bool fits(const PointRecord& record, const PointLayout& layout);

// Datasets and tables whose bits differ, or which only one of the records has.
std::vector<std::string> differences(const PointRecord& a, const PointRecord& b);

}  // namespace bristle::results
