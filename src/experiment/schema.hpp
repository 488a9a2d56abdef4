#pragma once

#include "experiment/document.hpp"

namespace bristle::experiment {

// Checks the merged document against the experiment schema (src/experiment/experiment.schema.json) or against
// the text of another schema. Throws InputError with source, JSON pointer, the invalid value and what is
// allowed.
void check_schema(const Document& document);
void check_schema(const Document& document, const char* schema);

// The text of the experiment schema, and a description of what a subschema allows: "a number greater than 0
// (radial stiffness, dimensionless)".
const char* experiment_schema();
std::string allowed_by_schema(const Json& schema);

// The schema of a sweepable number: in the model, load, orientation or si block.
const Json& parameter_schema(const std::string& name);

// Checks a value of a sweep against the schema of the parameter. Throws InputError if it is out of range.
void check_parameter(const Document& document, const JsonPointer& at, const std::string& parameter,
                     double value);

}  // namespace bristle::experiment
