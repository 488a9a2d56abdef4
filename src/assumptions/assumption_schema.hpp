#pragma once

namespace bristle {

// The text of assumption.schema.json.
const char* assumption_schema();

}  // namespace bristle
