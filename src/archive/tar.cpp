#include "archive/tar.hpp"

#include "util/error.hpp"
#include "util/file.hpp"
#include "json/json.hpp"

#include <archive.h>
#include <archive_entry.h>
#include <fmt/format.h>
#include <algorithm>
#include <cctype>
#include <cstring>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

namespace bristle::archive {
namespace fs = std::filesystem;
namespace {

constexpr std::uintmax_t kMaxArchiveBytes = std::uintmax_t(4) << 30;
constexpr std::size_t kMaxFiles = 10000;
constexpr std::size_t kTarBlock = 512;  // bytes
constexpr std::size_t kRecord = 20 * kTarBlock;

std::size_t padded(std::size_t size) { return (size + kTarBlock - 1) / kTarBlock * kTarBlock; }

using Handle = std::unique_ptr<::archive, int (*)(::archive*)>;
using Entry = std::unique_ptr<archive_entry, void (*)(archive_entry*)>;

la_ssize_t append(::archive*, void* out, const void* bytes, std::size_t size) {
  static_cast<std::string*>(out)->append(static_cast<const char*>(bytes), size);
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

// Returns the name of the part of the archive that contains the byte at this offset.
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

// Returns the name quoted and as ASCII, because names come from an untrusted archive and are printed on the
// terminal.
std::string quoted(const std::string& name) {
  return Json(name.substr(0, 100)).dump(-1, ' ', true, Json::error_handler_t::replace);
}

// Returns the name of an entry. Throws MalformedError for an entry that could do harm if the archive were
// unpacked.
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

// Returns the content of an entry. Throws MalformedError if the entry declares more than `most` bytes, or if
// its content cannot be read.
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

[[noreturn]] void broken_header(::archive* in, const std::string& bytes, const std::string& last) {
  const auto at = std::size_t(std::max<la_int64_t>(archive_read_header_position(in), 0));
  const std::string name = bytes.substr(std::min(at, bytes.size()), 100);  // of a header that may be damaged
  throw MalformedError(fmt::format("{}: its tar header (byte {}{}) is damaged, or this is no tar archive: {}",
                                   quoted(name.c_str()), at, last.empty() ? "" : ", after " + last,
                                   archive_error_string(in)));
}

void require_not_compressed(const std::string& bytes) {
  const std::pair<const char*, std::string> known[] = {{"gzip", "\x1f\x8b"},
                                                       {"xz",
                                                        "\xfd"
                                                        "7zXZ"},
                                                       {"zstd", "\x28\xb5\x2f\xfd"},
                                                       {"bzip2", "BZh"},
                                                       {"zip", "PK"}};
  for (const auto& [name, magic] : known)
    if (bytes.starts_with(magic))
      throw MalformedError(fmt::format(
          "the file is compressed ({}); archives are uncompressed tar files: unpack it first", name));
}

Handle tar_reader() {
  Handle in(archive_read_new(), archive_read_free);
  archive_read_support_format_tar(in.get());
  archive_read_support_filter_none(in.get());
  return in;
}

}  // namespace

std::string write_tar(const Files& files, std::time_t time) {
  std::string bytes;
  const Handle out(archive_write_new(), archive_write_free);
  archive_write_set_format_ustar(out.get());
  archive_write_add_filter_none(out.get());
  archive_write_set_bytes_per_block(out.get(), kRecord);
  archive_write_set_bytes_in_last_block(out.get(), kRecord);
  if (archive_write_open(out.get(), &bytes, nullptr, append, nullptr) != ARCHIVE_OK)
    throw RunError(fmt::format("libarchive: {}", archive_error_string(out.get())));
  for (const auto& [name, content] : files) write_file(out.get(), name, content, time);
  if (archive_write_close(out.get()) != ARCHIVE_OK)
    throw RunError(fmt::format("libarchive: {}", archive_error_string(out.get())));
  return bytes;
}

std::string read_archive(const std::string& path) {
  std::error_code error;
  if (!fs::exists(path, error))
    throw InputError(fmt::format("{}: no such file; `make archive` makes one", path));
  if (const std::string what = not_a_file(path); !what.empty())
    throw InputError(fmt::format("{}: {}", path, what));
  if (const std::uintmax_t size = fs::file_size(path, error); !error && size > kMaxArchiveBytes)
    throw MalformedError(
        fmt::format("{} bytes exceed the maximum of {} for an archive", size, kMaxArchiveBytes));
  return read_file(path, kMaxArchiveBytes);
}

Files read_tar(const std::string& bytes) {
  if (bytes.empty()) throw MalformedError("the file is empty");
  require_not_compressed(bytes);
  const Handle in = tar_reader();
  Files files;
  std::string last;
  archive_entry* entry = nullptr;
  int code = archive_read_open_memory(in.get(), bytes.data(), bytes.size());
  while (code == ARCHIVE_OK && (code = archive_read_next_header(in.get(), &entry)) == ARCHIVE_OK) {
    last = checked_name(entry);
    files[last] = read_content(in.get(), entry, last, bytes.size());
    if (files.size() > kMaxFiles) throw MalformedError(fmt::format("more than {} files", kMaxFiles));
  }
  if (code != ARCHIVE_EOF) broken_header(in.get(), bytes, last);
  if (files.empty()) throw MalformedError("the archive contains no files");
  return files;
}

std::string file_in_tar(const std::string& bytes, const std::string& name) {
  const Handle in = tar_reader();
  if (archive_read_open_memory(in.get(), bytes.data(), bytes.size()) != ARCHIVE_OK)
    throw MalformedError("not a tar archive");
  archive_entry* entry = nullptr;
  while (archive_read_next_header(in.get(), &entry) == ARCHIVE_OK)
    if (name == archive_entry_pathname(entry)) return read_content(in.get(), entry, name, bytes.size());
  throw MalformedError("is missing");
}

std::string tar_difference(const std::string& bytes, const Files& files, std::time_t time) {
  const std::string written = write_tar(files, time);
  const auto at = std::size_t(std::ranges::mismatch(bytes, written).in1 - bytes.begin());
  if (at < written.size())
    return fmt::format("{} (byte {}) differs from what the program writes", part_at(files, at), at);
  return at == bytes.size() ? ""
                            : fmt::format("the end of the archive: there are bytes after it (byte {})", at);
}

}  // namespace bristle::archive
