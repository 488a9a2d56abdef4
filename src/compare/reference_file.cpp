#include "compare/reference_file.hpp"

#include "util/error.hpp"
#include "util/file.hpp"
#include "util/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

namespace bristle::compare {
namespace {

// JSON text: objects and arrays of objects with one entry per line, arrays of numbers on one line.
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

// A value of the file with its JSON pointer, for messages.
class Node {
 public:
  Node(const std::string& path, const Json& json, JsonPointer at = JsonPointer())
      : path_(path), json_(json), at_(std::move(at)) {}

  [[noreturn]] void fail(const std::string& what) const {
    const std::string at = at_.empty() ? "/" : at_.to_string();
    throw InputError(
        fmt::format("{}: {}: {}; restore the reference with `git checkout`, or write it again with `bristle "
                    "reference update`",
                    path_, at, what));
  }

  Node operator[](const std::string& key) const {
    object();
    if (!json_.contains(key)) (*this / key).fail("is missing");
    return *this / key;
  }

  bool has(const std::string& key) const { return object().contains(key); }

  // Requires an object with no other keys than these.
  const Node& only(const std::vector<std::string>& keys) const {
    for (const auto& [key, value] : object().items())
      if (std::find(keys.begin(), keys.end(), key) == keys.end())
        (*this / key)
            .fail(fmt::format("is not a key of a reference{}; allowed: {}", did_you_mean(key, keys),
                              fmt::join(keys, ", ")));
    return *this;
  }

  const Json& object() const {
    if (!json_.is_object()) fail(fmt::format("{} is not an object", shown(json_)));
    return json_;
  }

  const Json& array() const {
    if (!json_.is_array()) fail(fmt::format("{} is not an array", shown(json_)));
    return json_;
  }

  bool is_number() const { return json_.is_number(); }

  std::string text() const {
    if (!json_.is_string()) fail(fmt::format("{} is not a string", shown(json_)));
    return json_.get<std::string>();
  }

  long integer() const {
    if (!json_.is_number_integer()) fail(fmt::format("{} is not an integer", shown(json_)));
    return json_.get<long>();
  }

  // A finite number, or NaN for null.
  double number() const {
    if (json_.is_null()) return std::numeric_limits<double>::quiet_NaN();
    if (!json_.is_number() || !std::isfinite(json_.get<double>()))
      fail(fmt::format("{} is not a number", shown(json_)));
    return json_.get<double>();
  }

  template <class Read>
  auto list(Read read) const {
    std::vector<decltype(read(*this))> out;
    for (std::size_t i = 0; i < array().size(); ++i) out.push_back(read(Node(path_, json_[i], at_ / i)));
    return out;
  }

  template <class Read>
  auto list(Read read, std::size_t size) const {
    if (array().size() != size)
      fail(fmt::format("{} entries, but the axes have {} points", json_.size(), size));
    return list(read);
  }

  template <class Visit>
  void each(Visit visit) const {
    for (const auto& [key, value] : object().items()) visit(key, *this / key);
  }

 private:
  Node operator/(const std::string& key) const {
    static const Json none;
    return Node(path_, json_.contains(key) ? json_[key] : none, at_ / key);
  }

  std::string path_;
  const Json& json_;
  JsonPointer at_;
};

double number(const Node& node) { return node.number(); }

double coordinate(const Node& node) {
  if (std::isnan(node.number())) node.fail("null is not allowed; allowed: a number");
  return node.number();
}

double tolerance_part(const Node& node) {
  if (!(node.number() >= 0)) node.fail("not a part of a tolerance; allowed: 0 or a positive number");
  return node.number();
}

// Reads a list, or one number that applies to all points with a value.
std::vector<double> read_part(const Node& node, const std::vector<double>& values) {
  if (!node.is_number()) return node.list(tolerance_part, values.size());
  const double same = tolerance_part(node);
  std::vector<double> out;
  for (const double value : values) out.push_back(std::isfinite(value) ? same : 0);
  return out;
}

Json part_json(const std::vector<double>& part, const std::vector<double>& values) {
  std::optional<double> same;
  for (std::size_t i = 0; i < part.size(); ++i) {
    if (!std::isfinite(values[i])) continue;
    if (!same) same = part[i];
    if (part[i] != *same) return part;
  }
  return same.value_or(0.0);
}

ReferenceVariable read_variable(const std::string& name, const Node& node, std::size_t points) {
  ReferenceVariable v;
  v.name = name;
  std::vector<std::string> keys = {"values"};
  for (const TolerancePart& part : kToleranceParts) keys.emplace_back(part.name);
  node.only(keys);
  v.values = node["values"].list(number, points);
  for (const TolerancePart& part : kToleranceParts) v.*part.values = read_part(node[part.name], v.values);
  return v;
}

experiment::Axis read_axis(const std::string& name, const Node& node) {
  experiment::Axis axis{name, node.list(coordinate)};
  if (axis.values.empty()) node.fail("an axis needs at least one value");
  return axis;
}

ReferenceClaim read_claim(const Node& node) {
  node.only({"claim", "reading", "statement", "verdict"});
  const std::string verdict = node["verdict"].text();
  const std::vector<std::string> known = {"supported", "refuted", "undecided"};
  if (std::find(known.begin(), known.end(), verdict) == known.end())
    node["verdict"].fail(fmt::format("\"{}\" is not a verdict{}; allowed: {}", verdict,
                                     did_you_mean(verdict, known), fmt::join(known, ", ")));
  const std::string reading = node.has("reading") ? node["reading"].text() : "";
  return {node["claim"].text(), reading, node["statement"].text(), verdict};
}

Json parse(const std::string& path) {
  const std::string text = read_file(path, kMaxJsonBytes);
  try {
    return parse_json(text);
  } catch (const InputError& e) {
    Node(path, Json()).fail(e.what());
  }
}

}  // namespace

std::string reference_text(const Reference& reference) {
  Json out;
  out["schema"] = kReferenceSchema;
  out["name"] = reference.name;
  out["tier"] = reference.tier;
  out["inputs_sha256"] = reference.inputs_sha256;
  out["numerics_version"] = reference.numerics_version;
  out["payload_sha256"] = reference.payload_sha256;
  out["commit"] = reference.commit;
  out["claims"] = Json::array();
  for (const ReferenceClaim& c : reference.claims) {
    Json claim = {
        {"claim", c.claim}, {"reading", c.reading}, {"verdict", c.verdict}, {"statement", c.statement}};
    if (c.reading.empty()) claim.erase("reading");
    out["claims"].push_back(claim);
  }
  out["axes"] = Json::object();
  for (const experiment::Axis& axis : reference.axes) out["axes"][axis.name] = axis.values;
  out["flags"] = Json::object();
  for (const ReferenceFlags& f : reference.flags) out["flags"][f.name]["values"] = f.values;
  out["variables"] = Json::object();
  for (const ReferenceVariable& v : reference.variables) {
    Json& variable = out["variables"][v.name];
    variable["values"] = v.values;  // NaN is written as null
    for (const TolerancePart& part : kToleranceParts)
      variable[part.name] = part_json(v.*part.values, v.values);
  }
  return layout(out, "") + "\n";
}

Reference read_reference(const std::string& path) {
  const Json json = parse(path);
  const Node root(path, json);
  if (const std::string schema = root["schema"].text(); schema != kReferenceSchema)
    root["schema"].fail(fmt::format("\"{}\", but this program reads {} only", schema, kReferenceSchema));
  root.only({"schema", "name", "tier", "inputs_sha256", "numerics_version", "payload_sha256", "commit",
             "claims", "axes", "flags", "variables"});
  Reference out;
  out.name = root["name"].text();
  out.tier = root["tier"].text();
  out.inputs_sha256 = root["inputs_sha256"].text();
  out.numerics_version = root["numerics_version"].integer();
  out.payload_sha256 = root["payload_sha256"].text();
  out.commit = root["commit"].text();
  out.claims = root["claims"].list(read_claim);
  root["axes"].each(
      [&](const std::string& name, const Node& node) { out.axes.push_back(read_axis(name, node)); });
  const std::size_t points = out.points();
  root["flags"].each([&](const std::string& name, const Node& node) {
    const auto integer = [](const Node& n) { return n.integer(); };
    out.flags.push_back({name, node.only({"values"})["values"].list(integer, points), ""});
  });
  root["variables"].each([&](const std::string& name, const Node& node) {
    out.variables.push_back(read_variable(name, node, points));
  });
  return out;
}

std::string reference_path(const std::string& folder, const std::string& name) {
  return (std::filesystem::path(folder) / (name + ".json")).string();
}

}  // namespace bristle::compare
