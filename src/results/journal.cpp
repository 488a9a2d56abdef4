#include "results/journal.hpp"

#include "experiment/experiment.hpp"
#include "results/version.hpp"
#include "util/error.hpp"
#include "util/file.hpp"
#include "util/process.hpp"
#include "util/sha.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <unistd.h>

namespace bristle::results {
namespace fs = std::filesystem;
namespace {

constexpr const char* kJournalExtension = ".journal";
constexpr const char* kAfterChecksum = R"( {"schema":"bristle-journal/)";
constexpr long kSyncSeconds = 2;

// Returns the key of a line in the form that encode() writes; the line need not be intact.
std::optional<std::string> key_of(std::string_view line) {
  static const std::string before = fmt::format(R"( {{"schema":"{}","key":")", kJournalSchema);
  if (line.size() < kDigestLength + before.size() || line.substr(kDigestLength, before.size()) != before)
    return {};
  const std::string_view rest = line.substr(kDigestLength + before.size());
  return std::string(rest.substr(0, rest.find('"')));
}

// Calls visit(line, offset) for every line that ends with a line feed. Returns the end of the last such line.
// Throws unless all lines were read, because what follows the last one may be removed.
template <class Visit>
std::uint64_t each_line(const std::string& path, Visit visit) {
  std::ifstream in = open_input(path);
  std::uint64_t end = 0;
  std::string line;
  for (; std::getline(in, line) && !in.eof(); end += line.size() + 1) visit(line, end);
  require_read(in, path);
  return end;
}

// Returns true if the file can be what a crash leaves of a journal: the start of a line, which is a checksum
// followed by JSON, or the zeros that a power cut leaves.
bool may_be_truncated_journal(const std::string& path) {
  std::string start(kDigestLength + std::strlen(kAfterChecksum), '\0');
  open_input(path).read(start.data(), std::streamsize(start.size()));
  for (std::size_t i = 0; i < start.size(); ++i) {
    const char c = start[i];
    const bool fits = i < kDigestLength ? (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f')
                                        : c == kAfterChecksum[i - kDigestLength];
    if (c != '\0' && !fits) return false;
  }
  return true;
}

// Returns true if a program of the commit `own` uses the points that a program of the commit `other`
// computed.
bool accepts(const std::string& own, const std::string& other) { return is_dirty(own) || !is_dirty(other); }

}  // namespace

std::string point_key(const Sweep& sweep, std::size_t index) {
  return sha256_of(fmt::format("numerics {}: {}", kNumericsVersion, sweep.key(index)));
}

bool is_dirty(const std::string& commit) { return commit.ends_with("-dirty") || commit == "unknown"; }

void read_journal(const std::string& path, const std::string& commit,
                  const std::function<void(const JournalStart&)>& visit) {
  each_line(path, [&](const std::string& text, std::uint64_t) {
    const auto line = decode_start(text);
    if (line && !line->key.empty() && accepts(commit, line->commit)) visit(*line);
  });
}

std::vector<std::string> journals_beside(const std::string& result) {
  const fs::path folder = fs::path(result).parent_path();
  std::vector<std::string> paths;
  std::error_code none, unread;
  const fs::directory_iterator entries(folder.empty() ? "." : folder, unread);
  if (unread && unread != std::errc::no_such_file_or_directory && unread != std::errc::not_a_directory)
    throw_system_reason(fmt::format("{}: its journals cannot be listed", folder.string()), unread.value());
  for (const auto& entry : entries)
    if (entry.path().extension() == kJournalExtension && entry.is_regular_file(none))
      paths.push_back((folder / entry.path().filename()).string());
  std::ranges::sort(paths);
  return paths;
}

Journal::Journal(const std::string& path, const std::string& commit, bool ignore)
    : path_(path), commit_(commit), file_(lock_file(path, path)) {
  try {
    scan();
    if (ignore) entries_.clear();
    if (ftruncate(file_, off_t(end_)) != 0)
      throw RunError(fmt::format("{}: {}", path_, system_reason(errno)));
  } catch (...) {
    ::close(file_);
    throw;
  }
}

Journal::~Journal() { ::close(file_); }

void Journal::scan() {
  bool known = false;
  end_ = each_line(path_, [&](const std::string& text, std::uint64_t offset) {
    const auto line = decode_start(text);
    if (!line) return;
    if (line->schema != kJournalSchema)
      throw InputError(fmt::format(
          "{}: schema {}, but this program writes {}; move the file, or use the program that wrote it", path_,
          line->schema, kJournalSchema));
    if (!line->key.empty() && accepts(commit_, line->commit)) entries_[line->key] = {offset, text.size()};
    known = true;
  });
  if (!known && !may_be_truncated_journal(path_))
    throw InputError(fmt::format(
        "{}: not a journal of bristle; move the file: the run writes its journal to this path", path_));
}

std::optional<JournalLine> Journal::find(const std::string& key, const Layout& layout) const {
  const auto entry = entries_.find(key);
  if (entry == entries_.end()) return {};
  std::string text(entry->second.length, '\0');
  const ssize_t got = pread(file_, text.data(), text.size(), off_t(entry->second.offset));
  if (got != ssize_t(text.size())) return {};
  auto line = decode(text, layout);
  if (line && line->key != key) line.reset();
  return line;
}

JournalLine Journal::read(const std::string& key, const Layout& layout) const {
  if (auto line = find(key, layout)) return *std::move(line);
  throw RunError(fmt::format("{}: changed while in use; run the same command again", path_));
}

void Journal::append(const std::string& key, const PointRecord& record) {
  append_text(key, encode(key, commit_, host_name(), record));
}

void Journal::append_text(const std::string& key, const std::string& text) {
  for (std::size_t written = 0; written < text.size();) {
    const ssize_t n = pwrite(file_, text.data() + written, text.size() - written, off_t(end_ + written));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) throw RunError(fmt::format("{}: {}", path_, system_reason(n < 0 ? errno : ENOSPC)));
    written += std::size_t(n);
  }
  entries_[key] = {end_, text.size() - 1};
  end_ += text.size();
  if (std::time(nullptr) >= synced_ + kSyncSeconds) sync();
}

void Journal::sync() {
  if (fdatasync(file_) != 0) throw RunError(fmt::format("{}: {}", path_, system_reason(errno)));
  synced_ = std::time(nullptr);
}

// Returns the lines of another journal by key. The lines may be damaged, because only the start of each is
// read.
const Journal::Entries& Journal::entries_of(const std::string& other) {
  std::error_code none;  // the journal may have been removed since; then it has no lines
  const std::uintmax_t size = fs::file_size(other, none);
  Other& known = others_.try_emplace(other, Other{0, {}}).first->second;
  if (known.size != size) {
    known.entries.clear();
    each_line(other, [&](const std::string& text, std::uint64_t offset) {
      if (const auto key = key_of(text)) known.entries[*key] = {offset, text.size()};
    });
    known.size = size;
  }
  return known.entries;
}

void Journal::adopt(const std::string& other, const Layout& layout,
                    const std::map<std::string, std::string>& points) {
  const Entries& entries = entries_of(other);
  std::ifstream in = open_input(other);
  for (const auto& [key, place] : points) {
    const auto entry = entries.find(key);
    if (entry == entries.end()) continue;
    std::string text(entry->second.length, '\0');
    in.clear();
    in.seekg(std::streamoff(entry->second.offset)).read(text.data(), std::streamsize(text.size()));
    const auto line = decode(text, layout);
    if (!line || line->key != key || !accepts(commit_, line->commit)) continue;
    const auto known = find(key, layout);
    if (!known) append_text(key, text + "\n");
    else if (const auto names = differences(known->record, line->record); !names.empty())
      throw InputError(fmt::format(
          "{} and {} differ at the point {}: {}; move one of them away, and run the same command again",
          path_, other, place, fmt::join(names, ", ")));
  }
}

void Journal::remove_copied(const std::string& other) const {
  int lock = -1;
  bool copied = true;
  try {
    lock = lock_file(other, other);
    each_line(other, [&](const std::string& text, std::uint64_t) {
      if (const auto line = decode_start(text); line && !has(line->key)) copied = false;
    });
  } catch (const std::exception&) {
    copied = false;  // another run is writing the journal, or it cannot be read
  }
  std::error_code ignored;
  if (copied) fs::remove(other, ignored);
  if (lock >= 0) ::close(lock);
}

}  // namespace bristle::results
