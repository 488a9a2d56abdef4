#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace bristle {

using Json = nlohmann::ordered_json;  // keeps the order of sweep axes
using JsonPointer = Json::json_pointer;

// What `bristle run` was told beside the file.
struct DocumentOptions {
  std::vector<std::string> set;  // "/json/pointer=value"
  std::string tier = "full";
};

// An experiment file with its parents (extends), its tier and the --set changes applied, and where each
// part came from.
class Document {
 public:
  struct Source {
    std::string name;  // file, or "--set ...", or file with tier
    Json content;
  };

  // Throws InputError: unreadable or malformed file, extends that is missing, circular or outside the
  // experiments folder, a bad --set or tier.
  static Document load(const std::string& path, const DocumentOptions& options);
  // An experiment as a result file has it: merged already, without tiers. source names it in messages.
  static Document stored(const Json& content, const std::string& source);

  const Json& json() const { return merged_; }
  const std::string& path() const { return path_; }
  // Names the source that gave the value at pointer, or the file for what nobody gave.
  std::string origin(const JsonPointer& pointer) const;
  // The document with this tier's patch applied instead.
  Document with_tier(const std::string& tier) const;

 private:
  std::vector<Json> tier_patches() const;
  void merge();

  std::string path_, tier_;
  std::vector<Source> files_;  // parents first
  std::vector<Source> set_;
  Json merged_;
};

// A file that holds one JSON object, each key once. Throws InputError.
Json read_json_file(const std::string& path);

// JSON that is not trusted. Throws InputError, without a file's name, if it is none, is nested too deeply or
// has a key twice in one object.
Json parse_json(const std::string& text);

// Value as it appears in messages: JSON, shortened.
std::string shown(const Json& value);

}  // namespace bristle
