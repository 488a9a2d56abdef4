#pragma once

#include "json/json.hpp"

#include <memory>
#include <string>
#include <vector>

namespace bristle::json {

// A value that --set assigns in a document.
struct Assignment {
  std::string name;                 // "--set ...", for messages
  std::vector<std::string> tokens;  // of the JSON pointer
  std::shared_ptr<const Json> value;

  // Returns true if the change sets the value at this pointer, or a part of it.
  bool sets(const JsonPointer& pointer) const;
  // Returns what the change sets at the pointer, a part of `value`, which is a copy of the change's own
  // value; null if the change sets nothing there.
  Json* find(Json& value, const JsonPointer& pointer) const;
};

// Reads "/json/pointer=value". A value that is not JSON is text. Throws InputError.
Assignment parse_assignment(const std::string& argument);

// Assigns the value at its pointer; an object is merged into the one there, and null removes a key. Throws
// InputError if there is no such key or element.
void apply(Json& document, const Assignment& change);

// Returns the keys and indices of a JSON pointer.
std::vector<std::string> tokens_of(JsonPointer pointer);

}  // namespace bristle::json
