#pragma once

#include "experiment/experiment.hpp"

namespace bristle::experiment {

// The value to seven digits. Quantiles differ between libraries of elementary functions in the last bit, and
// must not: points are known by their values. Tables of samples are easier to read, too.
double rounded(double value);

// The quantile of the standard normal distribution for shares between 1e-11 and 1 - 1e-11. The bits are the
// same on all machines.
double normal_quantile(double share);

// The axis of /sweep/sample: the rows of a table, or a Sobol sequence over distributions of quantities
// (docs/experiments.md). Throws InputError as read_axes() does.
Axis read_sample(const Document& document);

// The columns and rows of a table of comma-separated values: the first line names the columns. Empty lines
// and lines that begin with # are left out, and so is a first column without a name, which pandas writes for
// its index. Throws InputError for a file that is no table, or has values that are not allowed.
Json read_table(const std::string& path);

// The values of one quantity are finite: those of a range may not be, if its width or ratio is not. at: where
// the value with this index stands. Throws InputError.
void check_finite(const Document& document, const std::string& name, const std::vector<double>& values,
                  const std::function<JsonPointer(std::size_t)>& at);

// The values of one quantity, in any order, are in the range of the quantity. at: where the value with this
// index stands. Throws InputError.
void check_values(const Document& document, const std::string& name, const std::vector<double>& values,
                  const std::function<JsonPointer(std::size_t)>& at);

// Throws InputError if there are fewer than `count` values of seven digits from low to high: values are
// rounded to them, and points that should differ would be one.
void require_distinct(const Document& document, const JsonPointer& at, double low, double high,
                      std::size_t count);

// The index of the word in the options of a choice. Throws InputError.
double option_index(const Document& document, const JsonPointer& at, const Sweepable& choice,
                    const Json& word);

// The quantity or choice of this name. Throws InputError if a sweep cannot vary it.
const Sweepable& require_sweepable(const Document& document, const JsonPointer& at, const std::string& name);

}  // namespace bristle::experiment
