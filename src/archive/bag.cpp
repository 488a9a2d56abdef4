#include "archive/bag.hpp"

#include "util/error.hpp"
#include "util/sha.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <sstream>

namespace bristle::archive {
namespace {

constexpr const char* kDeclaration = "BagIt-Version: 1.0\nTag-File-Character-Encoding: UTF-8\n";
constexpr const char* kManifest = "manifest-sha512.txt";
constexpr const char* kTagManifest = "tagmanifest-sha512.txt";
constexpr std::size_t kHashDigits = 128;  // of SHA-512, hexadecimal
constexpr std::size_t kFewDigits = 16;

bool is_payload(const std::string& name) { return name.compare(0, 5, "data/") == 0; }

std::string manifest_of(const Files& files) {
  std::string text;
  for (const auto& [name, content] : files) text += fmt::format("{}  {}\n", sha512_of(content), name);
  return text;
}

std::string payload_oxum(const Files& files) {
  std::size_t bytes = 0, count = 0;
  for (const auto& [name, content] : files)
    if (is_payload(name)) {
      bytes += content.size();
      ++count;
    }
  return fmt::format("{}.{}", bytes, count);
}

// A UUID of version 8, derived from the payload: equal payloads have equal identifiers.
std::string identifier(const std::string& manifest) {
  std::string hex = sha512_of(manifest).substr(0, 32);
  hex[12] = '8';
  hex[16] = "89ab"[hex[16] % 4];
  return fmt::format("urn:uuid:{}-{}-{}-{}-{}", hex.substr(0, 8), hex.substr(8, 4), hex.substr(12, 4),
                     hex.substr(16, 4), hex.substr(20));
}

// Accepts only the exact form that make_bag() writes, so that every changed byte of a line is detected.
std::map<std::string, std::string> parse_manifest(const std::string& file, const std::string& text,
                                                  Problems& problems) {
  std::map<std::string, std::string> hashes;
  std::istringstream in(text);
  std::size_t number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    const bool valid = line.size() > kHashDigits + 2 && line.compare(kHashDigits, 2, "  ") == 0 &&
                       line.find_first_not_of("0123456789abcdef") == kHashDigits;
    const std::string name = valid ? line.substr(kHashDigits + 2) : "";
    if (!valid)
      problems.push_back(fmt::format(
          "{}: line {} is not 128 lower-case hexadecimal digits, two spaces, a name", file, number));
    else if (!hashes.empty() && name <= hashes.rbegin()->first)
      problems.push_back(fmt::format("{}: line {}: names are not in order", file, number));
    else hashes[name] = line.substr(0, kHashDigits);
  }
  if (text.empty() || text.back() != '\n') problems.push_back(fmt::format("{}: ends within a line", file));
  return hashes;
}

// Hashes of different contents differ in nearly all digits. If only a few differ, the manifest was changed.
std::string mismatch(const std::string& manifest, const std::string& file, const std::string& actual,
                     const std::string& listed) {
  std::size_t differing = 0;
  for (std::size_t i = 0; i < kHashDigits; ++i) differing += actual[i] != listed[i];
  if (differing <= kFewDigits)
    return fmt::format("{}: was changed: its SHA-512 of {} differs in {} of {} digits", manifest, file,
                       differing, kHashDigits);
  return fmt::format("{}: its SHA-512 is {}..., not the {}... of {}", file, actual.substr(0, 16),
                     listed.substr(0, 16), manifest);
}

// Compares files with the lines of their manifest.
void check_manifest(const std::string& manifest, const Files& files, Problems& problems) {
  std::map<std::string, const std::string*> listed;
  for (const auto& [name, content] : files)
    if (name != kTagManifest && is_payload(name) == (manifest == kManifest)) listed[name] = &content;
  const auto hashes = parse_manifest(manifest, files.at(manifest), problems);
  for (const auto& [name, hash] : hashes) {
    const auto file = listed.find(name);
    if (file == listed.end()) problems.push_back(fmt::format("{}: is missing; {} lists it", name, manifest));
    else if (const std::string actual = sha512_of(*file->second); actual != hash)
      problems.push_back(mismatch(manifest, name, actual, hash));
  }
  for (const auto& [name, content] : listed)
    if (!hashes.contains(name))
      problems.push_back(fmt::format("{}: does not belong here; {} does not list it", name, manifest));
}

}  // namespace

Files make_bag(const std::string& folder, const Files& payload, const BagInfo& info) {
  Files data;
  for (const auto& [name, content] : payload) data["data/" + name] = content;
  Files tags{{"bagit.txt", kDeclaration}, {kManifest, manifest_of(data)}};
  std::string& text = tags["bag-info.txt"];
  for (const auto& [label, value] : info) text += fmt::format("{}: {}\n", label, value);
  text += fmt::format("External-Identifier: {}\nPayload-Oxum: {}\n", identifier(tags[kManifest]),
                      payload_oxum(data));
  const std::string tag_manifest = manifest_of(tags);
  tags[kTagManifest] = tag_manifest;
  Files bag;
  for (const Files* part : {&data, &tags})
    for (const auto& [name, content] : *part) bag[folder + "/" + name] = content;
  return bag;
}

std::string strip_folder(Files& files) {
  const std::string& first = files.begin()->first;
  std::string folder = first.substr(0, first.find('/'));
  Files stripped;
  for (auto& [name, content] : files) {
    if (name.compare(0, folder.size() + 1, folder + "/") != 0)
      throw MalformedError(fmt::format("{}: lies outside the folder {}/ of the archive", name, folder));
    stripped[name.substr(folder.size() + 1)] = std::move(content);
  }
  files = std::move(stripped);
  return folder;
}

Problems check_bag(const Files& files) {
  Problems problems;
  for (const char* tag : {"bagit.txt", "bag-info.txt", kManifest, kTagManifest})
    if (!files.contains(tag)) problems.push_back(fmt::format("{}: is missing", tag));
  if (!problems.empty()) return problems;
  check_manifest(kTagManifest, files, problems);
  check_manifest(kManifest, files, problems);
  if (files.at("bagit.txt") != kDeclaration)
    problems.push_back("bagit.txt: is not the declaration of BagIt 1.0 in UTF-8");
  for (const auto& [name, content] : files)
    if (!is_payload(name) && name != "bagit.txt" && name != "bag-info.txt" && name != kManifest &&
        name != kTagManifest)
      problems.push_back(
          fmt::format("{}: does not belong here; outside data/ only BagIt's own files are allowed", name));
  if (const std::string stored = bag_info(files, "Payload-Oxum"), actual = payload_oxum(files);
      stored != actual)
    problems.push_back(
        fmt::format("bag-info.txt: Payload-Oxum is \"{}\", but the files give \"{}\"", stored, actual));
  return problems;
}

std::string bag_info(const Files& files, const std::string& label) {
  std::istringstream in(files.at("bag-info.txt"));
  for (std::string line; std::getline(in, line);)
    if (line.compare(0, label.size() + 2, label + ": ") == 0) return line.substr(label.size() + 2);
  return "";
}

}  // namespace bristle::archive
