#pragma once

#include "experiment/experiment.hpp"
#include "json/node.hpp"
#include "results/dataset.hpp"
#include "results/variables.hpp"
#include "sampling/sensitivity.hpp"

#include <map>
#include <set>
#include <string>
#include <vector>

namespace bristle::run {

// Throws InputError at the place if the result has no variable of this name, and the name is none of `known`,
// which are allowed as well.
void require_variable(const Experiment& experiment, const json::Node& place, const std::string& name,
                      std::vector<std::string> known = {});

// Adds Sobol indices, their errors, and the numbers of blocks that the indices follow from, to a dataset
// whose last dimensions are output (or another one) and input. rows: the indices of all inputs, by the other
// dimensions
void add_indices(results::Dataset& data, const std::vector<SobolIndices>& rows);

// Returns a table for people: a line for each input with its total and its first-order index, by descending
// total index. Adds what the indices follow from, unless they follow from all blocks of the design. remedy:
// what to do if too few points have a value
std::string indices_text(const SobolIndices& indices, const std::vector<std::string>& inputs,
                         std::size_t blocks, const std::string& remedy);

// Throws InputError if the experiment has a block "analysis" that it cannot have: without a sample, with
// Sobol indices of a sample that is not by sobol, or beside a block "design".
void read_analysis(const Experiment& experiment);
// Throws InputError as read_analysis() does, and if the block names a variable that the result does not have.
void validate_analysis(const Experiment& experiment);

// Returns the names of the variables that /analysis needs, and status.
std::set<std::string> analysed_variables(const Experiment& experiment);

// Returns the groups /indices and /quantiles that /analysis asks for, for each point of the axes other than
// the sample. values: the values of analysed_variables() over the sweep; missing values (NaN) are left out
std::vector<results::Dataset> analyse(const Experiment& experiment,
                                      const std::map<std::string, std::vector<double>>& values);

// Returns the groups in words, one line for each variable and point of the other axes; empty without an
// analysis.
std::string analysis_text(const Experiment& experiment, const std::vector<results::Dataset>& groups);

}  // namespace bristle::run
