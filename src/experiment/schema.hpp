#pragma once

#include "json/schema.hpp"

#include <optional>
#include <string>
#include <vector>

namespace bristle::experiment {

// Returns the schema of experiments: experiment.schema.json, with the keys of the blocks "model" and "si"
// from kParameters, choices() and si_quantities(), and the words of enumerations.
const json::Schema& experiment_schema();

// Returns the schema of a sweepable number: in the model, load, orientation or si block, or a width of the
// scatter.
const Json& parameter_schema(const std::string& name);

// Returns where an experiment gives the value of a sweepable number or choice: /si/R_m, or /scatter/r0 for
// scatter_r0. None for another name.
std::optional<JsonPointer> pointer_to(const std::string& name);

// Returns the same in words, with the keys of a scatter; empty for another name.
std::string place_in_words(const std::string& name);

// Throws InputError at the place if a value is out of the range of the parameter.
void check_parameter(const json::Node& place, const std::string& parameter, double value);

// Returns the JSON schema of an experiment file as an author writes it, for editors: with `extends` blocks
// may be partial and null removes a key; without it the file is complete. The experiment schema describes the
// merged document; this one is made from it and from the table of what can be swept. predicates: the names
// that a check may use
Json author_schema(const std::vector<std::string>& predicates);

}  // namespace bristle::experiment
