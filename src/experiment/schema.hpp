#pragma once

#include "experiment/document.hpp"

namespace bristle {

// Checks the document, as merged, against the experiment schema (src/experiment/experiment.schema.json) or
// another, whose text is given. Throws InputError that names source, JSON pointer, offending value and what
// is allowed.
void check_schema(const Document& document);
void check_schema(const Document& document, const char* schema);

// The experiment schema's text, and what it allows at a place: "a number greater than 0 (radial stiffness)".
const char* experiment_schema();
std::string allowed_by_schema(const Json& schema);

// A value of a sweepable number against its schema. Throws InputError if it is outside.
void check_parameter(const Document& document, const JsonPointer& at, const std::string& parameter,
                     double value);

}  // namespace bristle
