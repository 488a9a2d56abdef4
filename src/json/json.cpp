#include "json/json.hpp"

#include "util/error.hpp"
#include "util/file.hpp"

#include <nlohmann/json.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>
#include <set>
#include <vector>

namespace bristle {

namespace {

std::string layout(const Json& json, const std::string& indent) {
  const bool objects = json.is_array() && !json.empty() && json[0].is_object();
  if ((!json.is_object() && !objects) || json.empty()) return json.dump();
  std::vector<std::string> entries;
  const std::string inner = indent + " ";
  for (const auto& [key, value] : json.items()) {
    const std::string text = objects ? value.dump() : Json(key).dump() + ": " + layout(value, inner);
    entries.push_back(inner + text);
  }
  return fmt::format("{}\n{}\n{}{}", objects ? "[" : "{", fmt::join(entries, ",\n"), indent,
                     objects ? "]" : "}");
}

// Watches the events of a parser: limits the depth, refuses keys that appear twice in one object, and takes
// arrays of arrays out of the document if their rows are wanted.
class Watch {
 public:
  explicit Watch(std::map<std::string, NumberRows>* rows) : rows_(rows) {}

  // Returns whether the document keeps the value.
  bool operator()(int depth, Json::parse_event_t event, Json& parsed) {
    using Event = Json::parse_event_t;
    if (event == Event::value && row_) {
      const bool number = parsed.is_number();
      row_->plain = row_->plain && (number || parsed.is_null());
      row_->values.push_back(number ? parsed.get<double>() : std::numeric_limits<double>::quiet_NaN());
      return false;
    }
    if (depth > kMaxJsonDepth)
      throw InputError(fmt::format("JSON nested more than {} levels deep", kMaxJsonDepth));
    if (event == Event::key) return take_key(parsed);
    if (event == Event::object_start) {
      levels_.push_back({true, "", {}});
      if (row_) row_->plain = false;
    }
    if (event == Event::array_start) return begin_array();
    if (event == Event::object_end) levels_.pop_back();
    if (event == Event::array_end) return end_array();
    return true;
  }

 private:
  struct Level {
    bool object;
    std::string key;  // key of the value that follows
    std::set<std::string> keys;
  };

  bool take_key(const Json& parsed) {
    Level& level = levels_.back();
    level.key = parsed.get<std::string>();
    if (!level.keys.insert(level.key).second)
      throw InputError(fmt::format("the key {} appears twice in one object", shown(parsed)));
    return true;
  }

  bool begin_array() {
    const bool is_row = rows_ && !levels_.empty() && !levels_.back().object;
    levels_.push_back({false, "", {}});
    if (!is_row) return true;
    if (row_) row_->plain = false;  // an array in a row
    else row_ = &(*rows_)[place()];
    ++depth_of_row_;
    return true;
  }

  bool end_array() {
    levels_.pop_back();
    if (depth_of_row_ == 0) return true;
    if (--depth_of_row_ > 0) return false;
    row_->ends.push_back(row_->values.size());
    row_ = nullptr;
    return false;
  }

  // Returns the JSON pointer of the value that is being read, without the indices of arrays.
  std::string place() const {
    JsonPointer at;
    for (const Level& level : levels_)
      if (level.object) at /= level.key;
    return at.to_string();
  }

  std::map<std::string, NumberRows>* rows_;
  std::vector<Level> levels_;
  NumberRows* row_ = nullptr;  // rows to which values belong
  int depth_of_row_ = 0;       // depth of arrays, 1 in a row
};

Json parse(const std::string& text, std::map<std::string, NumberRows>* rows) {
  Watch watch(rows);
  try {
    return Json::parse(text, [&](int depth, Json::parse_event_t event, Json& parsed) {
      return watch(depth, event, parsed);
    });
  } catch (const Json::out_of_range& e) {  // "... overflow parsing '1e400'"
    const std::string message = e.what(), number = message.substr(message.find('\'') + 1);
    throw InputError(
        fmt::format("{} is beyond the largest number, 1.8e308", number.substr(0, number.find('\''))));
  } catch (const Json::exception& e) {
    throw InputError(fmt::format("not JSON: {}", json_error(e.what())));
  }
}

}  // namespace

std::string json_lines(const Json& json) { return layout(json, "") + "\n"; }

bool is_utf8(const std::string& text) {
  try {
    Json(text).dump();  // throws for text that is not UTF-8
    return true;
  } catch (const Json::exception&) {
    return false;
  }
}

std::string json_error(const std::string& message) {
  const auto end = message.find("] ");
  return end == std::string::npos ? message : message.substr(end + 2);
}

Json read_json_file(const std::string& path) { return json_object(path, read_file(path, kMaxJsonBytes)); }

Json json_object(const std::string& name, const std::string& text) {
  try {
    Json content = parse_json(text);
    if (!content.is_object())
      throw InputError(fmt::format("expected a JSON object {{...}}, found {}", shown(content)));
    return content;
  } catch (const InputError& e) {
    throw InputError(fmt::format("{}: {}", name, e.what()));
  }
}

Json parse_json(const std::string& text) { return parse(text, nullptr); }

Json parse_json(const std::string& text, std::map<std::string, NumberRows>& rows) {
  return parse(text, &rows);
}

std::string shown(const Json& value) {
  std::string text = value.dump();
  if (text.size() > 60) text = text.substr(0, 57) + "...";
  return text;
}

}  // namespace bristle
