#pragma once

#include "util/json.hpp"
#include "experiment/document.hpp"

#include <vector>
#include <string>

namespace bristle::experiment {

// Checks the merged document. Throws InputError with source, JSON pointer, the invalid value and what is
// allowed.
void check_schema(const Document& document, const Json& schema);

// The experiment schema: experiment.schema.json, with the keys of the blocks "model" and "si" from
// kParameters, choices() and si_quantities(), and the words of enumerations.
const Json& experiment_schema();

// The schema of a sweepable number: in the model, load, orientation or si block.
const Json& parameter_schema(const std::string& name);

// Checks a value of a sweep against the schema of the parameter. Throws InputError if it is out of range.
void check_parameter(const Document& document, const JsonPointer& at, const std::string& parameter,
                     double value);

// The JSON schema of an experiment file as an author writes it, for editors: with `extends` blocks may be
// partial and null removes a key; without it the file is complete. The experiment schema describes the merged
// document; this one is made from it and from the table of what can be swept. predicates: the names that a
// check may use.
Json author_schema(const std::vector<std::string>& predicates);

}  // namespace bristle::experiment
