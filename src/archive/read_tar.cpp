#include "archive/read_tar.hpp"

#include "util/error.hpp"
#include "util/file.hpp"

#include <archive.h>
#include <archive_entry.h>
#include <fmt/format.h>
#include <algorithm>
#include <cctype>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>

namespace bristle::archive {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kTypeOffset = 156;  // of the entry's type in its header
constexpr std::uintmax_t kMaxArchiveBytes = std::uintmax_t(4) << 30;
constexpr std::size_t kMaxFiles = 10000;

std::string bytes_at(const std::string& path, std::size_t offset, std::size_t count) {
  std::ifstream in(path, std::ios::binary);
  std::string bytes(count, '\0');
  in.seekg(std::streamoff(offset));
  in.read(bytes.data(), std::streamsize(count));
  bytes.resize(std::size_t(in.gcount()));
  return bytes;
}

bool portable(char c) { return std::isalnum(static_cast<unsigned char>(c)) || std::strchr("._-/", c); }

// Escapes control characters, as names come from an untrusted archive and are printed on the terminal.
std::string quoted(const std::string& name) {
  std::string out;
  for (const char c : name.substr(0, 100))
    out += c >= ' ' && c <= '~' ? std::string(1, c)
                                : fmt::format("\\x{:02x}", unsigned(static_cast<unsigned char>(c)));
  return '"' + out + '"';
}

// The name of a file in its raw header, which may be damaged.
std::string raw_name(const std::string& path, std::size_t header) {
  const std::string block = bytes_at(path, header, kTarBlock);
  if (block.size() < 345 + 155) return "";
  const std::string name(block.c_str(), strnlen(block.c_str(), 100));
  const std::string prefix(block.c_str() + 345, strnlen(block.c_str() + 345, 155));
  return prefix.empty() ? name : prefix + "/" + name;
}

std::string compression(const std::string& start) {
  const std::pair<const char*, std::string> known[] = {{"gzip", "\x1f\x8b"},
                                                       {"xz",
                                                        "\xfd"
                                                        "7zXZ"},
                                                       {"zstd", "\x28\xb5\x2f\xfd"},
                                                       {"bzip2", "BZh"},
                                                       {"zip", "PK"}};
  for (const auto& [name, magic] : known)
    if (start.compare(0, magic.size(), magic) == 0) return name;
  return "";
}

class TarReader {
 public:
  explicit TarReader(const std::string& path) : path_(path), in_(archive_read_new(), archive_read_free) {
    std::error_code error;
    if (!fs::exists(path, error))
      throw InputError(fmt::format("{}: no such file; `make archive` makes one", path));
    if (const std::string what = not_a_file(path); !what.empty())
      throw InputError(fmt::format("{}: {}", path, what));
    size_ = fs::file_size(path, error);
    if (error || !std::ifstream(path)) throw InputError(fmt::format("{}: cannot be read", path));
    if (size_ == 0) throw MalformedError("the file is empty");
    if (size_ > kMaxArchiveBytes)
      throw MalformedError(
          fmt::format("{} bytes exceed the maximum of {} for an archive", size_, kMaxArchiveBytes));
    if (const std::string how = compression(bytes_at(path, 0, 8)); !how.empty())
      throw MalformedError(fmt::format(
          "the file is compressed ({}); archives are uncompressed tar files: unpack it first", how));
    archive_read_support_format_tar(in_.get());
    archive_read_support_filter_none(in_.get());
    if (archive_read_open_filename(in_.get(), path.c_str(), 1 << 16) != ARCHIVE_OK) broken_header();
  }

  Files read() {
    Files files;
    while (const auto entry = next()) {
      const std::string name = checked_name(*entry, files);
      if (files.size() == kMaxFiles) throw MalformedError(fmt::format("more than {} files", kMaxFiles));
      last_ = name;
      const std::string& content = files[name] = read_content(*entry, name);
      header_ += kTarBlock + (content.size() + kTarBlock - 1) / kTarBlock * kTarBlock;
    }
    if (files.empty()) throw MalformedError("the archive contains no files");
    return files;
  }

 private:
  struct Found {
    archive_entry* entry;
    std::string name;
  };

  [[noreturn]] void broken_header() {
    const char* reason = archive_error_string(in_.get());
    throw MalformedError(fmt::format(
        "{}: its tar header (byte {}{}) is damaged, or this is no tar archive: {}",
        quoted(raw_name(path_, header_)), header_, last_.empty() ? "" : fmt::format(", after {}", last_),
        reason ? reason : "unknown reason"));
  }

  std::unique_ptr<Found> next() {
    archive_entry* entry = nullptr;
    const int code = archive_read_next_header(in_.get(), &entry);
    if (code == ARCHIVE_EOF) return nullptr;
    if (code != ARCHIVE_OK) broken_header();
    const char* name = archive_entry_pathname(entry);
    return std::make_unique<Found>(Found{entry, name ? name : ""});
  }

  // Checks that the entry is a plain ustar file, with a harmless name that follows those before it in order.
  std::string checked_name(const Found& found, const Files& files) const {
    const auto refuse = [&](const std::string& why) {
      throw MalformedError(fmt::format("{}: {}", quoted(found.name), why));
    };
    if (archive_entry_hardlink(found.entry) || archive_entry_filetype(found.entry) == AE_IFLNK)
      refuse("is a link; an archive contains plain files only");
    if (archive_entry_filetype(found.entry) == AE_IFDIR)
      refuse("is a folder's own entry; an archive contains plain files only");
    if (archive_entry_filetype(found.entry) != AE_IFREG)
      refuse("is a device or another special file; an archive contains plain files only");
    // Extended headers precede the header of the file, so header_ would then point to one.
    if (archive_format(in_.get()) != ARCHIVE_FORMAT_TAR_USTAR ||
        bytes_at(path_, header_ + kTypeOffset, 1) != "0")
      refuse("is not in the ustar format; the archive was packed by another program");
    if (found.name.empty() || !std::all_of(found.name.begin(), found.name.end(), portable))
      refuse("names may contain only letters, digits and . _ - /");
    if (found.name.front() == '/') refuse("is an absolute path");
    for (const fs::path& part : fs::path(found.name))
      if (part == ".." || part == ".") refuse("leads out of the archive");
    if (found.name.back() == '/' || found.name.find("//") != std::string::npos) refuse("has empty parts");
    if (files.contains(found.name)) refuse("occurs twice");
    if (!files.empty() && found.name < files.rbegin()->first)
      refuse(fmt::format("is out of order: it comes after {}", files.rbegin()->first));
    return found.name;
  }

  std::string read_content(const Found& found, const std::string& name) {
    const la_int64_t size = archive_entry_size(found.entry);
    const std::uintmax_t from = header_ + kTarBlock;
    if (size < 0 || from > size_ || std::uintmax_t(size) > size_ - from)
      throw MalformedError(fmt::format(
          "{}: its header declares {} bytes, more than remain in the archive; it may be truncated", name,
          size));
    std::string content;
    content.reserve(std::size_t(size));
    const void* block = nullptr;
    std::size_t count = 0;
    la_int64_t offset = 0;
    for (;;) {
      const int code = archive_read_data_block(in_.get(), &block, &count, &offset);
      if (code == ARCHIVE_EOF) break;
      if (code != ARCHIVE_OK || offset != la_int64_t(content.size()))
        throw MalformedError(
            fmt::format("{}: its content cannot be read: {}", name,
                        code == ARCHIVE_OK ? "it is sparse" : archive_error_string(in_.get())));
      content.append(static_cast<const char*>(block), count);
    }
    if (content.size() != std::size_t(size))
      throw MalformedError(
          fmt::format("{}: has {} bytes, but its header declares {}", name, content.size(), size));
    return content;
  }

  std::string path_, last_;
  std::unique_ptr<::archive, int (*)(::archive*)> in_;
  std::uintmax_t size_ = 0;
  std::size_t header_ = 0;  // offset of the next entry's header
};

}  // namespace

Files read_tar(const std::string& path) { return TarReader(path).read(); }

}  // namespace bristle::archive
