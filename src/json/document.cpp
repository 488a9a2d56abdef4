#include "json/document.hpp"

#include "bristle/model/parameters.hpp"
#include "util/data.hpp"
#include "util/error.hpp"
#include "util/text.hpp"

#include <nlohmann/json.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <filesystem>
#include <iostream>

namespace bristle::json {
namespace fs = std::filesystem;
namespace {

// Where an experiment may contain a table: the name of a file at first, then its columns and rows.
const JsonPointer kTables[] = {JsonPointer("/sweep/sample/table"), JsonPointer("/friction_law/table")};

constexpr const char* kValuesOfAxis[] = {"values", "linspace", "logspace"};

constexpr const char* kFromStandardInput =
    "-";  // in place of a file, as if it were one in the working folder

// Returns what messages call the file.
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

// Returns the folder within which experiments may extend each other: the outermost folder named "experiments"
// above the file, or else the file's own folder.
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

// Returns the file that `extends` names, relative to the file at path: without a folder and where there is no
// such file, the one that comes with the program.
std::string parent_of(const fs::path& path, const fs::path& extends) {
  const fs::path beside = path.parent_path() / extends;
  if (extends.has_parent_path() || fs::exists(fs::symlink_status(beside))) return beside.string();
  return data_path((fs::path("experiments") / extends).string()).value_or(beside.string());
}

// Returns the file of the experiment with this name, if there is no file called `name` itself; empty if there
// is none.
std::string file_meant_by(const std::string& name) {
  std::error_code
      error;  // for instance a name that is too long, or a loop of links: read_json_file() reports it
  if (fs::status(name, error).type() != fs::file_type::not_found) return "";
  const std::string file = name + ".json", in_folder = "experiments/" + file;
  for (const std::string& candidate : {file, in_folder, data_path(in_folder).value_or("")})
    if (fs::is_regular_file(candidate, error)) return candidate;
  return "";
}

// Returns the names of the tiers for which the file has an entry.
std::vector<std::string> tiers_of(const Json& content) {
  std::vector<std::string> names;
  if (content.contains("tiers") && content["tiers"].is_object())
    for (const auto& [name, patch] : content["tiers"].items()) names.push_back(name);
  return names;
}

// Calls visit with each value of the file, here and in the tiers, that names the file of this table.
template <class Visit>
void each_table_name(Json& content, const JsonPointer& table, Visit visit) {
  const auto try_at = [&](const JsonPointer& at) {
    if (content.contains(at) && content[at].is_string()) visit(content[at]);
  };
  try_at(table);
  for (const std::string& tier : tiers_of(content)) try_at(JsonPointer("/tiers") / tier / table);
}

// Returns the names of the experiments that a file can extend: files beside it and files that come with the
// program.
std::vector<std::string> files_beside(const std::string& path) {
  std::vector<std::string> names;
  const fs::path beside = fs::absolute(path).parent_path();
  for (const fs::path& folder : {beside, fs::path(data_path("experiments").value_or(beside.string()))}) {
    std::error_code error;  // a folder that cannot be read has no names
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
      if (entry.path().extension() == ".json") names.push_back(entry.path().filename().string());
  }
  return names;
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
      fail(fmt::format("does not exist{} (looked for {})",
                       did_you_mean(extends.get<std::string>(), files_beside(path)), parent.string()));
    if (std::count(chain.begin(), chain.end(), fs::canonical(found).string()))
      fail("extends this file in turn; remove one of the two");
    const bool supplied = !inside(fs::canonical(found), root);
    collect(fs::path(found).lexically_normal().string(), supplied ? experiments_folder(found) : root, chain,
            out);
  }
  content.erase("extends");
  content.erase("$schema");  // for editors
  for (const JsonPointer& table : kTables)
    each_table_name(content, table, [folder = fs::path(path).parent_path()](Json& name) {
      name = (folder / name.get<std::string>()).string();
    });
  out.push_back({name_of(path), std::make_shared<const Json>(std::move(content))});
}

// Returns true if the change sets a part of the table, and not all of it.
bool changes_part(const Assignment& change, const JsonPointer& table) {
  const std::vector<std::string> tokens = tokens_of(table);
  if (change.tokens.size() > tokens.size())
    return std::equal(tokens.begin(), tokens.end(), change.tokens.begin());
  Json value = *change.value;
  const Json* found = change.find(value, table);
  return found && found->is_object();
}

bool changes_part(const Json& patch, const JsonPointer& table) {
  return patch.contains(table) && patch.at(table).is_object();
}

// Removes how the values of an axis were given, where a change that is merged gives them in another way.
// is_new: tells whether the change sets the value at a pointer
template <class IsNew>
void replace_values_of_axes(Json& merged, IsNew is_new) {
  if (!merged.contains("sweep") || !merged["sweep"].is_object()) return;
  for (auto& [name, axis] : merged["sweep"].items()) {
    const JsonPointer at = JsonPointer("/sweep") / name;
    const auto is_replaced_by = [&, &axis = axis](const char* kind) {
      return axis.contains(kind) && is_new(at / kind);
    };
    if (!std::ranges::any_of(kValuesOfAxis, is_replaced_by)) continue;
    for (const char* key : {"values", "linspace", "logspace", "take"})
      if (!is_new(at / key)) axis.erase(key);
  }
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
  for (const std::string& argument : options.set) d.set_.push_back(parse_assignment(argument));
  d.merge();
  return d;
}

Document Document::stored(const Json& content, const std::string& source,
                          const std::vector<std::string>& set) {
  Document d;
  d.path_ = source;
  d.tier_ = "full";
  d.files_.push_back({source, std::make_shared<const Json>(content)});
  for (const std::string& argument : set) d.set_.push_back(parse_assignment(argument));
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

// Returns the tier's patches of all files, parents first. They are applied one by one: merging two patches
// into one would lose the keys that the first removes.
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
  tables_.clear();
  const auto add = [&](const Json& patch) {
    for (const JsonPointer& table : kTables)
      if (changes_part(patch, table)) {
        include_table(merged, table);
        tables_.erase(table.to_string());
      }
    merged.merge_patch(patch);
    replace_values_of_axes(merged, [&](const JsonPointer& at) { return patch.contains(at); });
  };
  for (const Source& s : files_) {
    const auto si = s.content->find("si");  // a null removes the block, and begins none
    if (si != s.content->end() && si->is_object() && !merged.contains("si")) {
      merged["model"]["bending"] = word(Bending::rod);
      merged["model"]["contact"] = word(Contact::hertz);
    }
    const auto content = s.content;  // include_table() replaces the contents of all files
    add(*content);
  }
  for (const Json& patch : tier_patches(tier_)) add(patch);
  for (const Assignment& change : set_) {
    for (const JsonPointer& table : kTables)
      if (changes_part(change, table)) include_table(merged, table);
    apply(merged, change);
  }
  replace_values_of_axes(merged, [&](const JsonPointer& at) { return set_by_option(at); });
  for (const JsonPointer& table : kTables) include_table(merged, table);
  merged_ = std::make_shared<const Json>(std::move(merged));
}

void Document::include_table(Json& merged, const JsonPointer& at) {
  if (!merged.contains(at) || !merged[at].is_string()) return;
  const Json name = merged[at];
  const Table& table = tables_[at.to_string()] = read_table(name);
  merged[at] = table.content;
  for (Source& source : files_) {
    Json content = *source.content;
    each_table_name(content, at, [&](Json& named) {
      if (named == name) named = table.content;
    });
    source.content = std::make_shared<const Json>(std::move(content));
  }
  for (Assignment& change : set_) {
    Json value = *change.value;
    if (Json* named = change.find(value, at); named && *named == name) *named = table.content;
    change.value = std::make_shared<const Json>(std::move(value));
  }
}

std::string Document::place(const std::string& pointer) const {
  if (made_) return pointer;
  for (const auto& [at, table] : tables_) {
    const bool changed = std::ranges::any_of(set_, [&, &at = at](const Assignment& change) {
      return changes_part(change, JsonPointer(at)) && change.sets(JsonPointer(pointer));
    });
    if (pointer.starts_with(at) && !changed) return table.place(pointer.substr(at.size()));
  }
  return fmt::format("{}: {}", origin(JsonPointer(pointer)), pointer);
}

void Document::fail(const std::string& pointer, const std::string& what) const {
  throw InputError(fmt::format("{}: {}", place(pointer), what));
}

bool Document::set_by_option(const JsonPointer& pointer) const {
  return std::ranges::any_of(set_, [&](const Assignment& change) { return change.sets(pointer); });
}

bool Document::chosen(const JsonPointer& pointer) const {
  const auto has = [](const Json& content, const JsonPointer& at) {
    return content.contains(at) && !content.at(at).is_null();
  };
  if (set_by_option(pointer)) return has(*merged_, pointer);
  const Json& own = *files_.back().content;
  return files_.size() > 1 && (has(own, pointer) || has(own, JsonPointer("/tiers/" + tier_) / pointer));
}

bool Document::inherits(const JsonPointer& pointer) const {
  return files_.size() > 1 && merged_->contains(pointer) && !chosen(pointer);
}

std::string Document::origin(const JsonPointer& pointer) const {
  for (auto s = set_.rbegin(); s != set_.rend(); ++s)
    if (s->sets(pointer)) return s->name;
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
