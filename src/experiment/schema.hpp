#pragma once

#include "experiment/document.hpp"

namespace bristle::experiment {

// Checks the merged document against the experiment schema or against another one. Throws InputError with
// source, JSON pointer, the invalid value and what is allowed.
void check_schema(const Document& document);
void check_schema(const Document& document, const Json& schema);

// The experiment schema: experiment.schema.json, with the keys of the blocks "model" and "si" from
// kParameters, choices() and si_quantities(), and the words of enumerations.
const Json& experiment_schema();
// A description of what a subschema allows: "a number greater than 0 (radial stiffness, dimensionless)".
std::string allowed_by_schema(const Json& schema);

// The schema of a sweepable number: in the model, load, orientation or si block.
const Json& parameter_schema(const std::string& name);

// Checks a value of a sweep against the schema of the parameter. Throws InputError if it is out of range.
void check_parameter(const Document& document, const JsonPointer& at, const std::string& parameter,
                     double value);

}  // namespace bristle::experiment
