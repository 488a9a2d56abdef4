#include "archive/crate.hpp"
#include "util/sha.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <set>

// Nothing is known of the JSON but that it is some: every access asks first.
namespace bristle {
namespace {

const Json& member(const Json& entity, const char* key) {
  static const Json none;
  return entity.is_object() && entity.contains(key) ? entity.at(key) : none;
}

std::string text(const Json& entity, const char* key) {
  const Json& value = member(entity, key);
  return value.is_string() ? value.get<std::string>() : "";
}

// What {"@id": ...} or a list of them refers to.
std::vector<std::string> references(const Json& entity, const char* key) {
  const Json& value = member(entity, key);
  std::vector<std::string> out;
  if (value.is_object()) out.push_back(text(value, "@id"));
  if (value.is_array())
    for (const Json& item : value) out.push_back(text(item, "@id"));
  return out;
}

bool has(const std::vector<std::string>& list, const std::string& item) {
  return std::find(list.begin(), list.end(), item) != list.end();
}

bool is_a(const Json& entity, const std::string& type) {
  const Json& value = member(entity, "@type");
  return value == type || (value.is_array() && std::find(value.begin(), value.end(), type) != value.end());
}

class CrateCheck {
 public:
  CrateCheck(const Files& files, const Json& citation, const std::map<std::string, Json>& facts)
      : files_(files), citation_(citation), facts_(facts) {}

  Problems run(const Json& crate) {
    if (!collect(crate)) return problems_;
    check_descriptor();
    check_root();
    check_files();
    for (const auto& [id, entity] : entities_)
      if (is_a(entity, "CreateAction")) check_action(id, entity);
    for (const auto& [name, facts] : facts_) check_result(name, facts);
    return problems_;
  }

 private:
  void wrong(const std::string& place, const std::string& what) {
    problems_.push_back(fmt::format("data/{}: {}: {}", kCrateFile, place, what));
  }

  bool collect(const Json& crate) {
    const Json& context = member(crate, "@context");
    const char* const version = "https://w3id.org/ro/crate/1.1/context";
    if (context != version && !(context.is_array() && std::count(context.begin(), context.end(), version)))
      wrong("@context", fmt::format("is not that of RO-Crate 1.1, {}", version));
    const Json& graph = member(crate, "@graph");
    if (!graph.is_array()) {
      wrong("@graph", "is not a list of entities");
      return false;
    }
    for (const Json& entity : graph) {
      const std::string id = text(entity, "@id");
      if (id.empty()) wrong("@graph", fmt::format("{} has no @id", shown(entity)));
      else if (!entities_.emplace(id, entity).second) wrong(id, "is described twice");
    }
    return true;
  }

  const Json& entity(const std::string& id) const {
    static const Json none;
    const auto found = entities_.find(id);
    return found == entities_.end() ? none : found->second;
  }

  void require_texts(const std::string& id, std::initializer_list<const char*> keys) {
    for (const char* key : keys)
      if (text(entity(id), key).empty()) wrong(id, fmt::format("{} is missing", key));
  }

  // Each refers to an entity that is there.
  void require_references(const std::string& id, std::initializer_list<const char*> keys) {
    for (const char* key : keys) {
      const auto targets = references(entity(id), key);
      if (targets.empty()) wrong(id, fmt::format("{} is missing", key));
      for (const std::string& target : targets)
        if (!entities_.contains(target)) wrong(id, fmt::format("{} \"{}\" is not described", key, target));
    }
  }

  void check_descriptor() {
    const Json& descriptor = entity(kCrateFile);
    if (!is_a(descriptor, "CreativeWork")) wrong(kCrateFile, "there is no such entity of type CreativeWork");
    if (!has(references(descriptor, "conformsTo"), "https://w3id.org/ro/crate/1.1"))
      wrong(kCrateFile, "conformsTo is not https://w3id.org/ro/crate/1.1");
    if (references(descriptor, "about") != std::vector<std::string>{"./"})
      wrong(kCrateFile, "about is not ./");
  }

  void check_root() {
    const Json& root = entity("./");
    if (!is_a(root, "Dataset")) wrong("./", "there is no root entity of type Dataset");
    require_texts("./", {"name", "description", "datePublished", "version"});
    require_references("./", {"license", "author", "publisher", "conformsTo", "hasPart", "mentions"});
    if (!has(references(root, "conformsTo"), "https://w3id.org/ro/wfrun/process/0.5"))
      wrong("./", "conformsTo is not https://w3id.org/ro/wfrun/process/0.5");
    const auto agree = [&](const char* key, const std::string& here, const std::string& there) {
      if (here != there) wrong("./", fmt::format("{} is \"{}\", in CITATION.cff \"{}\"", key, here, there));
    };
    agree("version", text(root, "version"), text(citation_, "version"));
    agree("datePublished", text(root, "datePublished"), text(citation_, "date-released"));
    const auto license = references(root, "license");
    agree("license", license.empty() ? "" : license[0],
          "https://spdx.org/licenses/" + text(citation_, "license"));
    for (const auto& [id, entity] : entities_)
      if (is_a(entity, "CreateAction") && !has(references(root, "mentions"), id))
        wrong("./", fmt::format("mentions lacks {}", id));
  }

  // Files here and files described are the same.
  void check_files() {
    const auto parts = references(entity("./"), "hasPart");
    for (const auto& [path, bytes] : files_) {
      if (path.compare(0, 5, "data/") != 0 || path.substr(5) == kCrateFile) continue;
      const std::string name = path.substr(5);
      if (!is_a(entity(name), "File")) {
        wrong(name, "the file is not described");
        continue;
      }
      if (!has(parts, name)) wrong("./", fmt::format("hasPart lacks {}", name));
      require_texts(name, {"name", "encodingFormat"});
      if (text(entity(name), "contentSize") != fmt::format("{}", bytes.size()))
        wrong(name, fmt::format("contentSize is not the file's, {}", bytes.size()));
      if (text(entity(name), "sha512") != sha512_of(bytes)) wrong(name, "sha512 is not the file's");
    }
    for (const auto& [id, entity] : entities_)
      if ((is_a(entity, "File") || has(parts, id)) && !files_.contains("data/" + id))
        wrong(id, "is described, but there is no such file");
  }

  void check_action(const std::string& id, const Json& action) {
    require_texts(id, {"name"});
    require_references(id, {"instrument", "object", "result", "agent"});
    for (const std::string& program : references(action, "instrument")) {
      if (!is_a(entity(program), "SoftwareApplication")) wrong(program, "is no SoftwareApplication");
      require_texts(program, {"name", "softwareVersion", "url"});
    }
    for (const char* key : {"object", "result"})
      for (const std::string& file : references(action, key))
        if (!files_.contains("data/" + file)) wrong(id, fmt::format("{} \"{}\" is no file here", key, file));
  }

  // A result is what one action made, as the result's own provenance tells.
  void check_result(const std::string& path, const Json& facts) {
    const std::string name = path.substr(5);
    const Json& provenance = member(facts, "provenance");
    int makers = 0;
    for (const auto& [id, action] : entities_) {
      if (!is_a(action, "CreateAction") || !has(references(action, "result"), name)) continue;
      ++makers;
      const auto programs = references(action, "instrument");
      const Json& program = entity(programs.empty() ? "" : programs[0]);
      const std::pair<std::string, const char*> told[] = {{text(action, "startTime"), "started"},
                                                          {text(action, "endTime"), "finished"},
                                                          {text(program, "softwareVersion"), "version"},
                                                          {text(program, "identifier"), "commit"}};
      for (const auto& [here, key] : told)
        if (here != text(provenance, key))
          wrong(id, fmt::format("says \"{}\", the /provenance of {} says {} \"{}\"", here, name, key,
                                text(provenance, key)));
    }
    if (makers != 1) wrong(name, fmt::format("is the result of {} actions, not of one", makers));
  }

  const Files& files_;
  const Json& citation_;
  const std::map<std::string, Json>& facts_;
  std::map<std::string, Json> entities_;
  Problems problems_;
};

}  // namespace

Problems check_crate(const Json& crate, const Files& files, const Json& citation,
                     const std::map<std::string, Json>& facts) {
  return CrateCheck(files, citation, facts).run(crate);
}

}  // namespace bristle
