#include "archive/citation.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <regex>
#include <yaml-cpp/yaml.h>

namespace bristle {
namespace {

constexpr int kDeepest = 16;
constexpr std::size_t kMostNodes = 10000, kMostBytes = 1 << 20;

Json scalar(const YAML::Node& node) {
  const std::string& text = node.Scalar();
  static const std::regex integer("0|-?[1-9][0-9]{0,8}");  // years and volumes; quoted ones are texts
  if (node.Tag() == "?" && std::regex_match(text, integer)) return std::stol(text);
  return text;
}

// An alias may stand for the same node many times: the nodes are counted as they are met.
Json to_json(const YAML::Node& node, int depth, std::size_t& nodes) {
  if (depth > kDeepest || ++nodes > kMostNodes) throw BadArchive("nested too deeply, or too long");
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
        throw BadArchive(fmt::format("the key {} is there twice, or is none", key));
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

bool is_text(const Json& value) { return value.is_string() && !value.get_ref<const std::string&>().empty(); }

// Of the schema's objects "person" and "entity", what this program writes and knows.
bool is_author(const Json& author) {
  if (!author.is_object() || author.empty()) return false;
  const auto known = {"name",  "website", "family-names", "given-names", "name-particle", "name-suffix",
                      "alias", "orcid",   "email",        "affiliation", "city",          "country"};
  for (const auto& [key, value] : author.items())
    if (!is_text(value) || std::find(known.begin(), known.end(), key) == known.end()) return false;
  return author.contains("name") || author.contains("family-names") || author.contains("given-names");
}

}  // namespace

Json parse_citation(const std::string& text) {
  if (text.size() > kMostBytes) throw BadArchive("too long for a citation");
  try {
    std::size_t nodes = 0;
    Json citation = to_json(YAML::Load(text), 0, nodes);
    if (!citation.is_object()) throw BadArchive("not a YAML object");
    citation.dump();  // throws for text that is not UTF-8
    return citation;
  } catch (const YAML::Exception& e) {
    throw BadArchive(fmt::format("not YAML: {}", e.what()));
  } catch (const Json::exception&) {
    throw BadArchive("not text in UTF-8");
  }
}

std::string citation_text(const Json& citation) {
  YAML::Emitter out;
  emit(out, citation);
  return std::string(out.c_str()) + "\n";
}

Json dataset_citation(const Json& software, const std::string& commit) {
  Json program = {{"type", "software"}, {"commit", commit}};
  for (const char* key : {"title", "version", "authors", "license", "repository-code", "url", "doi"})
    if (software.contains(key)) program[key] = software[key];
  Json out;
  out["cff-version"] = "1.2.0";
  out["message"] = "If you use these data, please cite them and the paper whose model they are of.";
  out["type"] = "dataset";
  out["title"] = fmt::format("Data of {}", software.value("title", ""));
  out["abstract"] = "Results, experiments, references and figures, with the program that computed them.";
  for (const char* key : {"version", "date-released", "license", "authors", "keywords"})
    if (software.contains(key)) out[key] = software[key];
  out["commit"] = commit;
  out["references"] = software.value("references", Json::array());
  out["references"].insert(out["references"].begin(), program);
  return out;
}

Problems check_citation(const Json& citation) {
  Problems problems;
  const auto wrong = [&](const std::string& key, const std::string& what) {
    problems.push_back(fmt::format("data/CITATION.cff: {}: {}", key, what));
  };
  const auto known = {"cff-version",   "message",     "type",       "title",  "abstract", "version",
                      "date-released", "license",     "authors",    "commit", "keywords", "references",
                      "doi",           "identifiers", "repository", "url",    "contact"};
  for (const auto& [key, value] : citation.items())
    if (std::find(known.begin(), known.end(), key) == known.end())
      wrong(key, "is no key of CFF 1.2.0 that a dataset here has");
  for (const char* key :
       {"cff-version", "message", "type", "title", "version", "date-released", "license", "commit"})
    if (!citation.contains(key)) wrong(key, "is missing");
    else if (!is_text(citation[key])) wrong(key, fmt::format("{} is not a text", shown(citation[key])));
  if (!problems.empty()) return problems;
  if (citation["cff-version"] != "1.2.0")
    wrong("cff-version", shown(citation["cff-version"]) + " is not 1.2.0");
  if (citation["type"] != "dataset") wrong("type", shown(citation["type"]) + " is not dataset");
  static const std::regex date("[0-9]{4}-(0[1-9]|1[012])-(0[1-9]|[12][0-9]|3[01])");
  if (!std::regex_match(citation["date-released"].get<std::string>(), date))
    wrong("date-released", shown(citation["date-released"]) + " is not a date as 2026-11-21");
  const Json authors = citation.value("authors", Json());
  if (!authors.is_array() || authors.empty() || !std::all_of(authors.begin(), authors.end(), is_author))
    wrong("authors", "is not a list of persons and entities");
  for (const Json& reference : citation.value("references", Json::array()))
    for (const char* key : {"type", "title", "authors"})
      if (!reference.is_object() || !reference.contains(key))
        wrong("references", fmt::format("{} has no {}", shown(reference), key));
  return problems;
}

}  // namespace bristle
