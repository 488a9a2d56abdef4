#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace bristle {

// A source file that uses Json includes <nlohmann/json.hpp> itself: parsing that header takes longer than
// parsing all others together.
using Json = nlohmann::ordered_json;  // keeps the order of sweep axes
using JsonPointer = nlohmann::json_pointer<std::string>;

// JSON with more levels of nesting is refused: recursive functions process it, and the stack is limited.
constexpr int kMaxJsonDepth = 64;

// Files with more bytes are refused before they are read; the files of this project have less than a
// megabyte.
constexpr std::uintmax_t kMaxJsonBytes = std::uintmax_t(64) << 20;

// Reads a file that holds one JSON object. Throws InputError, naming the file, as read_file() and
// parse_json() do.
Json read_json_file(const std::string& path);

// Returns the JSON object in a text, as read_json_file() does for a file. name: what messages call the text
Json json_object(const std::string& name, const std::string& text);

// Parses untrusted text. Throws InputError, without a file name, for text that is not JSON, for a key that
// appears twice in one object, and for nesting deeper than kMaxJsonDepth.
Json parse_json(const std::string& text);

// Rows of numbers, such as [[1, 2], [3, null]]. NaN stands for null.
struct NumberRows {
  std::vector<double> values;     // values of all rows
  std::vector<std::size_t> ends;  // index behind the last value of each row
  bool plain = true;              // every value is a number or null
};

// Parses untrusted text with very many numbers, as parse_json() does, without making JSON of them. Returns
// the document with [] in place of every array of arrays, and adds the rows of these arrays to `rows` by JSON
// pointer.
Json parse_json(const std::string& text, std::map<std::string, NumberRows>& rows);

// Returns JSON text: objects and arrays of objects with one entry per line, arrays of numbers on one line.
std::string json_lines(const Json& json);

// Returns the value as it appears in messages: JSON, shortened to 60 characters.
std::string shown(const Json& value);

// Returns true if the text is valid UTF-8, as JSON requires.
bool is_utf8(const std::string& text);

// Returns the text of a Json::exception without its tag, "[json.exception.parse_error.101] ".
std::string json_error(const std::string& message);

}  // namespace bristle
