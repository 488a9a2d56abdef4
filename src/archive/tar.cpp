#include "archive/tar.hpp"

#include "util/error.hpp"
#include "util/file.hpp"
#include "util/json.hpp"

#include <archive.h>
#include <archive_entry.h>
#include <fmt/format.h>
#include <algorithm>
#include <cctype>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

namespace bristle::archive {
namespace fs = std::filesystem;
namespace {

constexpr std::uintmax_t kMaxArchiveBytes = std::uintmax_t(4) << 30;
constexpr std::size_t kMaxFiles = 10000;
constexpr std::size_t kTarBlock = 512;  // bytes
constexpr std::size_t kRecord = 20 * kTarBlock;

std::size_t padded(std::size_t size) { return (size + kTarBlock - 1) / kTarBlock * kTarBlock; }

using Reader = std::unique_ptr<::archive, int (*)(::archive*)>;
using Writer = std::unique_ptr<::archive, int (*)(::archive*)>;
using Entry = std::unique_ptr<archive_entry, void (*)(archive_entry*)>;
using Sink = std::function<void(const char*, std::size_t)>;

la_ssize_t write_to_sink(::archive*, void* sink, const void* bytes, std::size_t size) {
  (*static_cast<const Sink*>(sink))(static_cast<const char*>(bytes), size);
  return la_ssize_t(size);
}

void write_file(::archive* out, const std::string& name, const std::string& content, std::time_t time) {
  const Entry entry(archive_entry_new(), archive_entry_free);
  archive_entry_set_pathname(entry.get(), name.c_str());
  archive_entry_set_size(entry.get(), la_int64_t(content.size()));
  archive_entry_set_filetype(entry.get(), AE_IFREG);
  archive_entry_set_perm(entry.get(), 0644);
  archive_entry_set_mtime(entry.get(), time, 0);
  if (archive_write_header(out, entry.get()) != ARCHIVE_OK)
    throw RunError(fmt::format("{}: cannot be archived: {}", name, archive_error_string(out)));
  if (archive_write_data(out, content.data(), content.size()) != la_ssize_t(content.size()))
    throw RunError(fmt::format("{}: cannot be archived: {}", name, archive_error_string(out)));
}

// Name of the part of the archive that contains the byte at this offset.
std::string part_at(const Files& files, std::size_t offset) {
  std::size_t at = 0;
  for (const auto& [name, content] : files) {
    if (offset < at + kTarBlock) return fmt::format("{}: its tar header", name);
    if (offset < at + kTarBlock + content.size()) return fmt::format("{}: its content", name);
    at += kTarBlock + padded(content.size());
    if (offset < at) return fmt::format("{}: the padding after it", name);
  }
  return "the end of the archive";
}

bool portable(char c) { return std::isalnum(static_cast<unsigned char>(c)) || std::strchr("._-/", c); }

// As ASCII, because names come from an untrusted archive and are printed on the terminal.
std::string quoted(const std::string& name) {
  return Json(name.substr(0, 100)).dump(-1, ' ', true, Json::error_handler_t::replace);
}

// Refuses entries that could do harm if the archive were unpacked.
std::string checked_name(archive_entry* entry) {
  const char* pathname = archive_entry_pathname(entry);
  const std::string name = pathname ? pathname : "";
  const auto refuse = [&](const char* why) {
    throw MalformedError(fmt::format("{}: {}", quoted(name), why));
  };
  if (archive_entry_hardlink(entry) || archive_entry_filetype(entry) != AE_IFREG)
    refuse("is a link, a folder or a device; an archive contains plain files only");
  if (name.empty() || !std::ranges::all_of(name, portable))
    refuse("names may contain only letters, digits and . _ - /");
  const fs::path path = name;
  if (path.is_absolute() || path.lexically_normal().string() != name || name.back() == '/' ||
      path.begin()->string() == "..")
    refuse("leads out of the archive, or is not the shortest form of the path");
  return name;
}

// size: that the entry declares, which may not be more than most.
std::string read_content(::archive* in, archive_entry* entry, const std::string& name, std::uintmax_t most) {
  const la_int64_t size = archive_entry_size(entry);
  if (size < 0 || std::uintmax_t(size) > most)
    throw MalformedError(fmt::format(
        "{}: its header declares {} bytes, more than the archive has; it may be truncated", name, size));
  std::string content(std::size_t(size), '\0');
  const la_ssize_t got = archive_read_data(in, content.data(), content.size());
  if (got < 0)
    throw MalformedError(fmt::format("{}: its content cannot be read: {}", name, archive_error_string(in)));
  content.resize(std::size_t(got));
  return content;
}

[[noreturn]] void broken_header(::archive* in, const std::string& path, const std::string& last) {
  const la_int64_t at = std::max<la_int64_t>(archive_read_header_position(in), 0);
  std::string name(100, '\0');  // in the raw header, which may be damaged
  std::ifstream(path, std::ios::binary).seekg(at).read(name.data(), 100);
  throw MalformedError(fmt::format("{}: its tar header (byte {}{}) is damaged, or this is no tar archive: {}",
                                   quoted(name.c_str()), at, last.empty() ? "" : ", after " + last,
                                   archive_error_string(in)));
}

void require_not_compressed(const std::string& path) {
  const std::pair<const char*, std::string> known[] = {{"gzip", "\x1f\x8b"},
                                                       {"xz",
                                                        "\xfd"
                                                        "7zXZ"},
                                                       {"zstd", "\x28\xb5\x2f\xfd"},
                                                       {"bzip2", "BZh"},
                                                       {"zip", "PK"}};
  std::string start(8, '\0');
  std::ifstream(path, std::ios::binary).read(start.data(), 8);
  for (const auto& [name, magic] : known)
    if (start.starts_with(magic))
      throw MalformedError(fmt::format(
          "the file is compressed ({}); archives are uncompressed tar files: unpack it first", name));
}

std::uintmax_t checked_size(const std::string& path) {
  std::error_code error;
  if (!fs::exists(path, error))
    throw InputError(fmt::format("{}: no such file; `make archive` makes one", path));
  if (const std::string what = not_a_file(path); !what.empty())
    throw InputError(fmt::format("{}: {}", path, what));
  const std::uintmax_t size = fs::file_size(path, error);
  if (error || !std::ifstream(path)) throw InputError(fmt::format("{}: cannot be read", path));
  if (size == 0) throw MalformedError("the file is empty");
  if (size > kMaxArchiveBytes)
    throw MalformedError(
        fmt::format("{} bytes exceed the maximum of {} for an archive", size, kMaxArchiveBytes));
  return size;
}

}  // namespace

void write_tar(const Files& files, std::time_t time, const Sink& sink) {
  const Writer out(archive_write_new(), archive_write_free);
  archive_write_set_format_ustar(out.get());
  archive_write_add_filter_none(out.get());
  archive_write_set_bytes_per_block(out.get(), kRecord);
  archive_write_set_bytes_in_last_block(out.get(), kRecord);
  void* const context = const_cast<Sink*>(&sink);
  if (archive_write_open(out.get(), context, nullptr, write_to_sink, nullptr) != ARCHIVE_OK)
    throw RunError(fmt::format("libarchive: {}", archive_error_string(out.get())));
  for (const auto& [name, content] : files) write_file(out.get(), name, content, time);
  if (archive_write_close(out.get()) != ARCHIVE_OK)
    throw RunError(fmt::format("libarchive: {}", archive_error_string(out.get())));
}

Files read_tar(const std::string& path) {
  const std::uintmax_t size = checked_size(path);
  require_not_compressed(path);
  const Reader in(archive_read_new(), archive_read_free);
  archive_read_support_format_tar(in.get());
  archive_read_support_filter_none(in.get());
  Files files;
  std::string last;
  archive_entry* entry = nullptr;
  int code = archive_read_open_filename(in.get(), path.c_str(), 1 << 16);
  while (code == ARCHIVE_OK && (code = archive_read_next_header(in.get(), &entry)) == ARCHIVE_OK) {
    last = checked_name(entry);
    files[last] = read_content(in.get(), entry, last, size);
    if (files.size() > kMaxFiles) throw MalformedError(fmt::format("more than {} files", kMaxFiles));
  }
  if (code != ARCHIVE_EOF) broken_header(in.get(), path, last);
  if (files.empty()) throw MalformedError("the archive contains no files");
  return files;
}

std::string file_in_tar(const std::string& bytes, const std::string& name) {
  const Reader in(archive_read_new(), archive_read_free);
  archive_read_support_format_tar(in.get());
  if (archive_read_open_memory(in.get(), bytes.data(), bytes.size()) != ARCHIVE_OK)
    throw MalformedError("not a tar archive");
  archive_entry* entry = nullptr;
  while (archive_read_next_header(in.get(), &entry) == ARCHIVE_OK)
    if (name == archive_entry_pathname(entry)) return read_content(in.get(), entry, name, bytes.size());
  throw MalformedError("is missing");
}

std::string tar_difference(const std::string& path, const Files& files, std::time_t time) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), std::fclose);
  if (!file) throw InputError(fmt::format("{}: cannot be read", path));
  std::vector<char> existing;
  std::size_t at = 0;
  std::string found;
  write_tar(files, time, [&](const char* bytes, std::size_t size) {
    existing.resize(size);
    const std::size_t got = found.empty() ? std::fread(existing.data(), 1, size, file.get()) : 0;
    const auto same =
        std::mismatch(existing.begin(), existing.begin() + long(got), bytes).first - existing.begin();
    if (found.empty() && std::size_t(same) < size)
      found = fmt::format("{} (byte {}) differs from what the program writes",
                          part_at(files, at + std::size_t(same)), at + std::size_t(same));
    at += size;
  });
  if (found.empty() && std::fgetc(file.get()) != EOF)
    found = fmt::format("the end of the archive: there are bytes after it (byte {})", at);
  return found;
}

}  // namespace bristle::archive
