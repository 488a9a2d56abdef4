#include "archive/bag.hpp"

#include "util/error.hpp"
#include "util/sha.hpp"

#include <fmt/format.h>
#include <sstream>

namespace bristle::archive {
namespace {

constexpr const char* kDeclaration = "BagIt-Version: 1.0\nTag-File-Character-Encoding: UTF-8\n";
constexpr const char* kManifest = "manifest-sha512.txt";
constexpr const char* kTagManifest = "tagmanifest-sha512.txt";
constexpr std::size_t kHashDigits = 128;  // of SHA-512, hexadecimal

bool is_payload(const std::string& name) { return name.compare(0, 5, "data/") == 0; }

std::string manifest_of(const Files& files) {
  std::string text;
  for (const auto& [name, content] : files) text += fmt::format("{}  {}\n", sha512_of(content), name);
  return text;
}

std::string payload_oxum(const Files& payload) {
  std::size_t bytes = 0;
  for (const auto& [name, content] : payload) bytes += content.size();
  return fmt::format("{}.{}", bytes, payload.size());
}

// Returns a UUID of version 8 that follows from the payload: equal payloads have equal identifiers.
std::string identifier(const std::string& manifest) {
  std::string hex = sha512_of(manifest).substr(0, 32);
  hex[12] = '8';
  hex[16] = "89ab"[hex[16] % 4];
  return fmt::format("urn:uuid:{}-{}-{}-{}-{}", hex.substr(0, 8), hex.substr(8, 4), hex.substr(12, 4),
                     hex.substr(16, 4), hex.substr(20));
}

// Compares files with the lines of their manifest. Adds to problems the files that are damaged, missing or
// not listed.
void check_manifest(const std::string& manifest, const Files& files, Problems& problems) {
  Files covered, listed;
  for (const auto& [name, content] : files)
    if (name != kTagManifest && is_payload(name) == (manifest == kManifest))
      covered[name] = sha512_of(content);
  std::istringstream in(files.at(manifest));
  for (std::string line; std::getline(in, line);)
    if (line.size() > kHashDigits + 2) listed[line.substr(kHashDigits + 2)] = line.substr(0, kHashDigits);
  for (const auto& [name, hash] : listed)
    if (!covered.contains(name))
      problems.push_back(fmt::format("{}: is missing; {} lists it", name, manifest));
    else if (covered[name] != hash)
      problems.push_back(fmt::format("{}: its SHA-512 is {}..., but {}... in {}", name,
                                     covered[name].substr(0, 16), hash.substr(0, 16), manifest));
  for (const auto& [name, hash] : covered)
    if (!listed.contains(name))
      problems.push_back(fmt::format("{}: does not belong here; {} does not list it", name, manifest));
}

}  // namespace

Files make_bag(const Files& payload, const BagInfo& info) {
  Files bag, tags{{"bagit.txt", kDeclaration}};
  for (const auto& [name, content] : payload) bag["data/" + name] = content;
  tags[kManifest] = manifest_of(bag);
  std::string& text = tags["bag-info.txt"];
  for (const auto& [label, value] : info) text += fmt::format("{}: {}\n", label, value);
  text += fmt::format("External-Identifier: {}\nPayload-Oxum: {}\n", identifier(tags[kManifest]),
                      payload_oxum(bag));
  bag[kTagManifest] = manifest_of(tags);
  bag.merge(tags);
  return bag;
}

Files in_folder(const std::string& folder, Files files) {
  Files out;
  for (auto& [name, content] : files) out[folder + "/" + name] = std::move(content);
  return out;
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

Problems check_manifests(const Files& files) {
  Problems problems;
  for (const char* manifest : {kTagManifest, kManifest})
    if (files.contains(manifest)) check_manifest(manifest, files, problems);
    else problems.push_back(fmt::format("{}: is missing", manifest));
  return problems;
}

std::string bag_info(const Files& files, const std::string& label) {
  const auto file = files.find("bag-info.txt");
  std::istringstream in(file == files.end() ? "" : file->second);
  for (std::string line; std::getline(in, line);)
    if (line.compare(0, label.size() + 2, label + ": ") == 0) return line.substr(label.size() + 2);
  return "";
}

}  // namespace bristle::archive
