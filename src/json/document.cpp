#include "json/document.hpp"

#include "bristle/model/parameters.hpp"
#include "util/data.hpp"
#include "util/error.hpp"
#include "util/text.hpp"

#include <nlohmann/json.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cctype>
#include <cstring>
#include <filesystem>
#include <iostream>

namespace bristle::json {
namespace fs = std::filesystem;
namespace {

const JsonPointer kTable("/sweep/sample/table");  // the name of a file at first, then its columns and rows

constexpr const char* kFromStandardInput =
    "-";  // in place of a file, as if it were one in the working folder

// What messages call the file.
std::string name_of(const std::string& path) { return path == kFromStandardInput ? "standard input" : path; }

Json content_of(const std::string& path) {
  if (path != kFromStandardInput) return read_json_file(path);
  std::string text;
  while (text.size() <= kMaxJsonBytes && std::cin) {
    char part[4096];
    std::cin.read(part, sizeof part);
    text.append(part, std::size_t(std::cin.gcount()));
  }
  if (text.size() > kMaxJsonBytes)
    throw InputError(fmt::format("{}: more than {} bytes", name_of(path), kMaxJsonBytes));
  return json_object(name_of(path), text);
}

// The folder within which experiments may extend each other: the outermost folder named "experiments" above
// the file, or else the file's own folder.
fs::path experiments_folder(const fs::path& file) {
  fs::path folder = fs::weakly_canonical(fs::absolute(file)).parent_path(), root = folder;
  for (fs::path p = folder; p != p.root_path(); p = p.parent_path())
    if (p.filename() == "experiments") root = p;
  return root;
}

bool inside(const fs::path& file, const fs::path& folder) {
  const fs::path relative = file.lexically_relative(folder);
  return !relative.empty() && *relative.begin() != "..";
}

// The file that `extends` names, relative to the file at path: without a folder and where there is no such
// file, the one that comes with the program.
std::string parent_of(const fs::path& path, const fs::path& extends) {
  const fs::path beside = path.parent_path() / extends;
  if (extends.has_parent_path() || fs::exists(fs::symlink_status(beside))) return beside.string();
  return data_path((fs::path("experiments") / extends).string()).value_or(beside.string());
}

// The file of the experiment with this name, if there is no file called `name` itself; empty if there is
// none.
std::string file_meant_by(const std::string& name) {
  std::error_code
      error;  // for instance a name that is too long, or a loop of links: read_json_file() reports it
  if (fs::status(name, error).type() != fs::file_type::not_found) return "";
  const std::string file = name + ".json", in_folder = "experiments/" + file;
  for (const std::string& candidate : {file, in_folder, data_path(in_folder).value_or("")})
    if (fs::is_regular_file(candidate, error)) return candidate;
  return "";
}

// The patches of the tiers, if the file has any.
std::vector<std::string> tiers_of(const Json& content) {
  std::vector<std::string> names;
  if (content.contains("tiers") && content["tiers"].is_object())
    for (const auto& [name, patch] : content["tiers"].items()) names.push_back(name);
  return names;
}

// Calls change with each place of the file, here and in the tiers, that names the file of a table.
template <class Change>
void each_table_name(Json& content, Change change) {
  const auto visit = [&](const JsonPointer& at) {
    if (content.contains(at) && content[at].is_string()) change(content[at]);
  };
  visit(kTable);
  for (const std::string& tier : tiers_of(content)) visit(JsonPointer("/tiers") / tier / kTable);
}

// Appends the file to out, after the files that it extends. chain: the files that led to this one.
void collect(const std::string& path, const fs::path& root, std::vector<std::string>& chain,
             std::vector<Document::Source>& out) {
  Json content = content_of(path);
  chain.push_back(fs::weakly_canonical(path).string());
  if (content.contains("extends")) {
    const Json& extends = content["extends"];
    const auto fail = [&](const std::string& why) {
      throw InputError(fmt::format("{}: /extends: {} {}", name_of(path), shown(extends), why));
    };
    if (!extends.is_string()) fail("is not a file name");
    const fs::path parent = fs::path(path).parent_path() / extends.get<std::string>();
    std::error_code error;  // for instance a name that is too long, or a loop of links
    const fs::path there = fs::weakly_canonical(fs::absolute(parent), error);
    if (error) fail(fmt::format("is not a valid file name: {}", error.message()));
    if (!inside(there, root))
      fail(fmt::format("lies outside the experiments folder {}; copy it there", root.string()));
    const std::string found = parent_of(path, extends.get<std::string>());
    if (!fs::is_regular_file(found, error))
      fail(fmt::format("does not exist (looked for {})", parent.string()));
    if (std::count(chain.begin(), chain.end(), fs::canonical(found).string()))
      fail("extends this file in turn; remove one of the two");
    const bool supplied = !inside(fs::canonical(found), root);
    collect(fs::path(found).lexically_normal().string(), supplied ? experiments_folder(found) : root, chain,
            out);
  }
  content.erase("extends");
  content.erase("$schema");  // for editors
  each_table_name(content, [folder = fs::path(path).parent_path()](Json& name) {
    name = (folder / name.get<std::string>()).string();
  });
  out.push_back({name_of(path), std::make_shared<const Json>(std::move(content))});
}

std::vector<std::string> tokens_of(JsonPointer pointer) {
  std::vector<std::string> tokens;
  for (; !pointer.empty(); pointer.pop_back()) tokens.insert(tokens.begin(), pointer.back());
  return tokens;
}

Document::Change parse_set(const std::string& argument) {
  const auto equals = argument.find('=');
  const auto fail = [&](const std::string& why) {
    throw InputError(fmt::format("--set {}: {}; write --set /model/k_r=20", argument, why));
  };
  if (equals == std::string::npos) fail("'=' is missing");
  const std::string text = argument.substr(equals + 1);
  if (std::count(argument.begin(), argument.begin() + long(equals), '/') > kMaxJsonDepth)
    fail(fmt::format("the JSON pointer is more than {} levels deep", kMaxJsonDepth));
  Json value;
  try {
    const bool json_intended =
        std::isdigit(static_cast<unsigned char>(text[0])) || std::strchr("-[{\"", text[0]);
    value = Json::accept(text) || (json_intended && !text.empty()) ? parse_json(text) : Json(text);
    value.dump();  // throws for text that is not UTF-8
  } catch (const InputError& e) {
    fail(fmt::format("'{}': {}", text.substr(0, 60), e.what()));
  } catch (const Json::exception& e) {
    fail(json_error(e.what()));
  }
  try {
    const JsonPointer pointer(argument.substr(0, equals));
    if (pointer.empty()) fail("the JSON pointer is empty");
    if (argument.starts_with("/tiers"))
      fail("would have no effect, because the tier has been applied; set the value itself");
    return {"--set " + argument, tokens_of(pointer), std::make_shared<const Json>(std::move(value))};
  } catch (const Json::exception& e) {
    fail(json_error(e.what()));
  }
  return {"", {}, nullptr};  // not reached: fail() throws
}

// The element of an array for a token of a JSON pointer; "-" appends one. Throws InputError.
Json& element(Json& array, const std::string& token, const std::string& change) {
  if (token == "-") return array.emplace_back();
  const bool number =
      !token.empty() && token.size() < 10 && token.find_first_not_of("0123456789") == token.npos;
  if (!number || std::stoul(token) >= array.size())
    throw InputError(
        fmt::format("{}: \"{}\" is not an element of the array {}; allowed: 0 to {}, or - to append", change,
                    token, shown(array), std::ptrdiff_t(array.size()) - 1));
  return array[std::stoul(token)];
}

void remove_key(Json& object, const std::string& key, const std::string& change) {
  std::vector<std::string> keys;
  for (const auto& [name, value] : object.items()) keys.push_back(name);
  if (!object.contains(key))
    throw InputError(fmt::format("{}: there is no key {} to remove{}; here: {}", change, key,
                                 did_you_mean(key, keys), fmt::join(keys, ", ")));
  object.erase(key);
}

// Assigns the value at its pointer; an object is merged into the one there, and null removes a key.
void apply(Json& document, const Document::Change& change) {
  const std::vector<std::string>& tokens = change.tokens;
  Json* at = &document;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    const std::string& token = tokens[i];
    if (at->is_array()) {
      at = &element(*at, token, change.name);
    } else if (at->is_object() || at->is_null()) {
      if (i + 1 == tokens.size() && change.value->is_null()) {
        remove_key(*at, token, change.name);
        return;
      }
      at = &(*at)[token];
    } else {
      throw InputError(fmt::format("{}: \"{}\" does not exist, because what should contain it is {}",
                                   change.name, token, shown(*at)));
    }
  }
  if (change.value->is_object() && at->is_object()) at->merge_patch(*change.value);
  else *at = *change.value;
}

// Whether the change sets the value at this pointer, or a part of it.
bool sets(const Document::Change& change, const JsonPointer& pointer) {
  const auto &changed = change.tokens, asked = tokens_of(pointer);
  const std::size_t common = std::min(changed.size(), asked.size());
  if (!std::equal(changed.begin(), changed.begin() + long(common), asked.begin())) return false;
  JsonPointer rest;
  for (std::size_t i = common; i < asked.size(); ++i) rest.push_back(asked[i]);
  return change.value->contains(rest);
}

// What the change sets at the pointer; null if nothing.
Json* set_at(const Document::Change& change, Json& value, const JsonPointer& pointer) {
  const std::vector<std::string> asked = tokens_of(pointer);
  if (change.tokens.size() > asked.size() ||
      !std::equal(change.tokens.begin(), change.tokens.end(), asked.begin()))
    return nullptr;
  JsonPointer rest;
  for (std::size_t i = change.tokens.size(); i < asked.size(); ++i) rest.push_back(asked[i]);
  return value.contains(rest) ? &value[rest] : nullptr;
}

// Whether the change sets a part of the table, and not all of it.
bool changes_part_of_table(const Document::Change& change) {
  const std::vector<std::string> table = tokens_of(kTable);
  if (change.tokens.size() > table.size())
    return std::equal(table.begin(), table.end(), change.tokens.begin());
  Json value = *change.value;
  const Json* found = set_at(change, value, kTable);
  return found && found->is_object();
}

bool changes_part_of_table(const Json& patch) {
  return patch.contains(kTable) && patch.at(kTable).is_object();
}

}  // namespace

Document Document::load(const std::string& path, const DocumentOptions& options) {
  Document d;
  d.path_ = name_of(path);
  d.tier_ = options.tier;
  std::vector<std::string> chain;
  if (const std::string meant = file_meant_by(path); !meant.empty())
    throw InputError(fmt::format("{}: no such file; did you mean {}?", path, meant));
  if (path != kFromStandardInput) read_json_file(path);  // reports a missing file before its missing folder
  collect(path, experiments_folder(path), chain, d.files_);
  for (const std::string& argument : options.set) d.set_.push_back(parse_set(argument));
  d.merge();
  return d;
}

Document Document::stored(const Json& content, const std::string& source,
                          const std::vector<std::string>& set) {
  Document d;
  d.path_ = source;
  d.tier_ = "full";
  d.files_.push_back({source, std::make_shared<const Json>(content)});
  for (const std::string& argument : set) d.set_.push_back(parse_set(argument));
  d.merge();
  return d;
}

Document Document::made(const Json& content) {
  Document d = stored(content, "");
  d.made_ = true;
  return d;
}

Document Document::with_tier(const std::string& tier) const {
  Document d = *this;
  d.tier_ = tier;
  d.merge();
  return d;
}

bool Document::has_tier(const std::string& tier) const { return !tier_patches(tier).empty(); }

// The tier's patches of all files, parents first. They are applied one by one: merging two patches into one
// would lose the keys that the first removes.
std::vector<Json> Document::tier_patches(const std::string& tier) const {
  std::vector<Json> patches;
  for (const Source& s : files_) {
    const Json tiers = s.content->value("tiers", Json::object());
    const bool named = tiers.is_object() && tiers.contains(tier);
    if (tiers.is_null() || (named && tiers[tier].is_null())) patches.clear();
    else if (named && tiers[tier].is_object()) patches.push_back(tiers[tier]);
  }
  return patches;
}

std::string Document::remedy_of_inherited_tier(const std::string& tier) const {
  const JsonPointer at = JsonPointer("/tiers") / tier;
  const auto has_patch = [&](const Source& s) {
    return s.content->contains(at) && s.content->at(at).is_object();
  };
  const auto parent = std::find_if(files_.rbegin() + 1, files_.rend(), has_patch);
  if (parent == files_.rend() || tier_patches(tier).empty()) return "";
  if (has_patch(files_.back()))
    return fmt::format(
        "the tier {} is inherited from {}: change this key in /tiers/{} of {}; null there removes it", tier,
        parent->name, tier, path_);
  return fmt::format(
      "the tier {} is inherited from {}: give {} a patch of its own in /tiers/{}, or none, so that the tier "
      "has all points: \"tiers\": {{\"{}\": null}}",
      tier, parent->name, path_, tier, tier);
}

void Document::merge() {
  Json merged = Json::object();
  table_.reset();
  const auto add = [&](const Json& patch) {
    if (changes_part_of_table(patch)) {
      include_table(merged);
      table_.reset();
    }
    merged.merge_patch(patch);
  };
  for (const Source& s : files_) {
    if (s.content->contains("si") && !merged.contains("si")) {
      merged["model"]["bending"] = word(Bending::rod);
      merged["model"]["contact"] = word(Contact::hertz);
    }
    const auto content = s.content;  // include_table() replaces the contents of all files
    add(*content);
  }
  for (const Json& patch : tier_patches(tier_)) add(patch);
  for (const Change& change : set_) {
    if (changes_part_of_table(change)) include_table(merged);
    apply(merged, change);
  }
  include_table(merged);
  merged_ = std::make_shared<const Json>(std::move(merged));
}

void Document::include_table(Json& merged) {
  if (!merged.contains(kTable) || !merged[kTable].is_string()) return;
  const Json name = merged[kTable];
  table_ = read_table(name);
  const Json& table = table_->content;
  merged[kTable] = table;
  for (Source& source : files_) {
    Json content = *source.content;
    each_table_name(content, [&](Json& named) {
      if (named == name) named = table;
    });
    source.content = std::make_shared<const Json>(std::move(content));
  }
  for (Change& change : set_) {
    Json value = *change.value;
    if (Json* named = set_at(change, value, kTable); named && *named == name) *named = table;
    change.value = std::make_shared<const Json>(std::move(value));
  }
}

std::string Document::place(const std::string& pointer) const {
  if (made_) return pointer;
  const std::string table = kTable.to_string();
  const bool changed = std::ranges::any_of(set_, [&](const Change& change) {
    return changes_part_of_table(change) && sets(change, JsonPointer(pointer));
  });
  if (table_ && pointer.starts_with(table) && !changed) return table_->place(pointer.substr(table.size()));
  return fmt::format("{}: {}", origin(JsonPointer(pointer)), pointer);
}

void Document::fail(const std::string& pointer, const std::string& what) const {
  throw InputError(fmt::format("{}: {}", place(pointer), what), made_ ? "" : tier_of(JsonPointer(pointer)));
}

bool Document::set_by_option(const JsonPointer& pointer) const {
  return std::ranges::any_of(set_, [&](const Change& change) { return sets(change, pointer); });
}

bool Document::chosen(const JsonPointer& pointer) const {
  const auto has = [](const Json& content, const JsonPointer& at) {
    return content.contains(at) && !content.at(at).is_null();
  };
  if (set_by_option(pointer)) return has(*merged_, pointer);
  const Json& own = *files_.back().content;
  return files_.size() > 1 && (has(own, pointer) || has(own, JsonPointer("/tiers/" + tier_) / pointer));
}

std::string Document::origin(const JsonPointer& pointer) const {
  for (auto s = set_.rbegin(); s != set_.rend(); ++s)
    if (sets(*s, pointer)) return s->name;
  const Source* source = source_of(pointer);
  if (!source) return path_;
  const std::string tier = tier_of(pointer);
  return tier.empty() ? source->name : fmt::format("{} (tier {})", source->name, tier);
}

const Document::Source* Document::source_of(const JsonPointer& pointer) const {
  const JsonPointer in_tier = JsonPointer("/tiers/" + tier_) / pointer;
  for (auto s = files_.rbegin(); s != files_.rend(); ++s)
    if (s->content->contains(in_tier) || s->content->contains(pointer)) return &*s;
  return nullptr;
}

std::string Document::tier_of(const JsonPointer& pointer) const {
  if (set_by_option(pointer)) return "";
  const Source* source = source_of(pointer);
  return source && source->content->contains(JsonPointer("/tiers/" + tier_) / pointer) ? tier_ : "";
}

}  // namespace bristle::json
