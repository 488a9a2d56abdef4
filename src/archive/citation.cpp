#include "archive/citation.hpp"

#include "util/error.hpp"

#include <fmt/format.h>
#include <charconv>
#include <nlohmann/json.hpp>
#include <yaml-cpp/yaml.h>

namespace bristle::archive {
namespace {

constexpr int kMaxYamlDepth = 16;
constexpr std::size_t kMaxYamlNodes = 10000, kMaxCitationBytes = 1 << 20;

// Returns a number for an unquoted integer, such as a year or a volume, and text for all else.
Json scalar(const YAML::Node& node) {
  const std::string& text = node.Scalar();
  long number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool is_integer = error == std::errc() && end == text.data() + text.size();
  if (node.Tag() == "?" && is_integer && fmt::format("{}", number) == text && text.size() <= 10)
    return number;
  return text;
}

// Counts nodes at every visit, because aliases may refer to the same node many times.
Json to_json(const YAML::Node& node, int depth, std::size_t& nodes) {
  if (depth > kMaxYamlDepth || ++nodes > kMaxYamlNodes)
    throw MalformedError("nested too deeply, or too many nodes");
  if (node.IsScalar()) return scalar(node);
  Json out;
  if (node.IsSequence()) {
    out = Json::array();
    for (const auto& item : node) out.push_back(to_json(item, depth + 1, nodes));
  } else if (node.IsMap()) {
    out = Json::object();
    for (const auto& pair : node) {
      const std::string key = pair.first.IsScalar() ? pair.first.Scalar() : "";
      if (key.empty() || out.contains(key))
        throw MalformedError(fmt::format("the key {} appears twice, or is not text", key));
      out[key] = to_json(pair.second, depth + 1, nodes);
    }
  }
  return out;
}

void emit(YAML::Emitter& out, const Json& value) {
  if (value.is_object()) {
    out << YAML::BeginMap;
    for (const auto& [key, item] : value.items()) {
      out << YAML::Key << key << YAML::Value;
      emit(out, item);
    }
    out << YAML::EndMap;
  } else if (value.is_array()) {
    out << YAML::BeginSeq;
    for (const Json& item : value) emit(out, item);
    out << YAML::EndSeq;
  } else if (value.is_number_integer()) out << value.get<long>();
  else out << YAML::DoubleQuoted << value.get<std::string>();
}

}  // namespace

Json parse_citation(const std::string& text) {
  if (text.size() > kMaxCitationBytes) throw MalformedError("too long for a citation");
  try {
    std::size_t nodes = 0;
    Json citation = to_json(YAML::Load(text), 0, nodes);
    if (!citation.is_object()) throw MalformedError("not a YAML object");
    citation.dump();  // throws for text that is not UTF-8
    return citation;
  } catch (const YAML::Exception& e) {
    throw MalformedError(fmt::format("not YAML: {}", e.what()));
  } catch (const Json::exception&) {
    throw MalformedError("not text in UTF-8");
  }
}

std::string citation_text(const Json& citation) try {
  YAML::Emitter out;
  emit(out, citation);
  return std::string(out.c_str()) + "\n";
} catch (const Json::exception& e) {
  throw MalformedError(json_error(e.what()));
}

Json dataset_citation(const Json& software, const std::string& commit) try {
  for (const char* key : {"title", "version", "date-released", "license", "authors"})
    if (!software.contains(key))
      throw MalformedError(fmt::format("{} is missing; an archive requires it", key));

  Json program = {{"type", "software"}, {"commit", commit}};
  for (const char* key : {"title", "version", "authors", "license", "repository-code", "url", "doi"})
    if (software.contains(key)) program[key] = software[key];
  Json out;
  out["cff-version"] = "1.2.0";
  out["message"] = "If you use these data, please cite them and the paper that describes the model.";
  out["type"] = "dataset";
  out["title"] = fmt::format("Data of {}", software.value("title", ""));
  out["abstract"] = "Results, experiments, references and figures, with the program that computed them.";
  for (const char* key : {"version", "date-released", "authors", "contact", "keywords"})
    if (software.contains(key)) out[key] = software[key];
  for (const Json& identifier : software.value("identifiers", Json::array()))
    if (identifier.value("type", "") == "doi") out["doi"] = identifier.at("value");
  out["license"] = kDataLicense;
  out["commit"] = commit;
  out["references"] = software.value("references", Json::array());
  out["references"].insert(out["references"].begin(), program);
  return out;
} catch (const Json::exception& e) {
  throw MalformedError(json_error(e.what()));
}

}  // namespace bristle::archive
