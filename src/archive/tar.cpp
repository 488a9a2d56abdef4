#include "archive/tar.hpp"

#include "util/error.hpp"

#include <archive.h>
#include <archive_entry.h>
#include <fmt/format.h>
#include <algorithm>
#include <memory>
#include <vector>

namespace bristle::archive {
namespace {

constexpr std::size_t kRecord = 20 * kTarBlock;

std::size_t padded(std::size_t size) { return (size + kTarBlock - 1) / kTarBlock * kTarBlock; }

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

std::string file_in_tar(const std::string& bytes, const std::string& name) {
  const std::unique_ptr<::archive, int (*)(::archive*)> in(archive_read_new(), archive_read_free);
  archive_read_support_format_tar(in.get());
  if (archive_read_open_memory(in.get(), bytes.data(), bytes.size()) != ARCHIVE_OK)
    throw MalformedError("not a tar archive");
  archive_entry* entry = nullptr;
  while (archive_read_next_header(in.get(), &entry) == ARCHIVE_OK) {
    if (name != archive_entry_pathname(entry)) continue;
    std::string text;
    char buffer[65536];
    for (la_ssize_t n = 0; (n = archive_read_data(in.get(), buffer, sizeof buffer)) != 0;) {
      if (n < 0) throw MalformedError("the tar archive is damaged");
      text.append(buffer, std::size_t(n));
    }
    return text;
  }
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
