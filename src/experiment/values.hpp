#pragma once

#include "json/node.hpp"
#include "sweep/sweepable.hpp"

#include <functional>
#include <string>
#include <vector>

namespace bristle::experiment {

// Returns the node at which a value stands, by its index.
using PlaceOf = std::function<json::Node(std::size_t)>;

// Throws InputError unless the values of a quantity are finite: the values of a range are not if its width or
// ratio is not.
void check_finite(const std::string& quantity, const std::vector<double>& values, const PlaceOf& place);

// Throws InputError unless the values of a quantity, in any order, are finite and in its range.
void check_values(const std::string& quantity, const std::vector<double>& values, const PlaceOf& place);

// Throws InputError at a range if it has fewer than `count` values of seven digits from low to high: values
// are rounded to them, and points that should differ would be one.
void require_distinct(const json::Node& range, double low, double high, std::size_t count);

// Returns the index of a word in the options of a choice. Throws InputError at the word.
double option_index(const json::Node& place, const sweep::Sweepable& choice, const Json& word);

// Returns the quantity or choice of this name. Throws InputError at the place if a sweep cannot vary it.
const sweep::Sweepable& require_sweepable(const json::Node& place, const std::string& name);

}  // namespace bristle::experiment
