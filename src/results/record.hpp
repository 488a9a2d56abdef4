#pragma once

#include "ensemble/trace.hpp"
#include "results/recorded_tables.hpp"
#include "results/variables.hpp"

#include <map>
#include <string>
#include <vector>

namespace bristle {

// The numbers of one sweep point as a result file has them: what a run computes, its journal keeps, parts are
// merged from and a verification compares. Every NaN has the same bits.
struct PointRecord {
  std::map<std::string, std::vector<double>> values;  // by dataset: one number, or one per node of a curve
  std::map<std::string, Rows> tables;                 // by table: its columns but for the first, "point"
};

PointRecord record_of(const Experiment& experiment, const PointResult& result, const Recorded& recorded);
PointRecord record_of(const Experiment& experiment, const std::vector<CurveNode>& curve);

// From a result file of this experiment, or of a part of it. Throws RunError for what cannot be read.
PointRecord read_record(hid_t file, const Experiment& experiment, std::size_t index);

// Names of the datasets over the sweep and of the tables that a result of this experiment has.
std::vector<std::string> value_names(const Experiment& experiment);
std::vector<std::string> table_names(const Experiment& experiment);
// The record has these, no more and no less.
bool fits(const PointRecord& record, const Experiment& experiment);

// Datasets and tables of which the two have other bits, or that one of them lacks.
std::vector<std::string> differences(const PointRecord& a, const PointRecord& b);

}  // namespace bristle
