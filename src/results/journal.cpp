#include "results/journal.hpp"

#include "experiment/experiment.hpp"
#include "results/version.hpp"
#include "util/error.hpp"
#include "util/file.hpp"
#include "util/sha.hpp"

#include <fmt/format.h>
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

// Calls visit(line, offset) for every line that ends with a line feed. Returns the end of the last of them.
template <class Visit>
std::uint64_t each_line(const std::string& path, Visit visit) {
  std::ifstream in(path, std::ios::binary);
  std::uint64_t end = 0;
  for (std::string line; std::getline(in, line) && !in.eof(); end += line.size() + 1) visit(line, end);
  return end;
}

// Whether the file can be the remainder of a journal after a crash: the start of a line, which is a checksum
// followed by JSON, or the zeros that a power cut leaves.
bool may_be_truncated_journal(const std::string& path) {
  std::string start(64 + std::strlen(kAfterChecksum), '\0');
  std::ifstream(path, std::ios::binary).read(start.data(), std::streamsize(start.size()));
  for (std::size_t i = 0; i < start.size(); ++i) {
    const char c = start[i];
    const bool fits = i < 64 ? (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f') : c == kAfterChecksum[i - 64];
    if (c != '\0' && !fits) return false;
  }
  return true;
}

}  // namespace

std::string point_key(const Experiment& experiment, std::size_t index) {
  return sha256_of(
      fmt::format("numerics {}: {}", kNumericsVersion, experiment::canonical_point(experiment, index)));
}

bool is_dirty(const std::string& commit) { return commit.ends_with("-dirty") || commit == "unknown"; }

Journal::Journal(const std::string& result, const std::string& commit, bool clear)
    : path_(result + kJournalExtension), commit_(commit), file_(lock_file(result, path_)) {
  try {
    scan();
    if (clear) {
      entries_.clear();
      end_ = 0;
    }
    if (ftruncate(file_, off_t(end_)) != 0)
      throw RunError(fmt::format("{}: {}", path_, std::strerror(errno)));
  } catch (...) {
    ::close(file_);
    throw;
  }
}

Journal::~Journal() { ::close(file_); }

void Journal::scan() {
  bool known = false;
  end_ = each_line(path_, [&](const std::string& line, std::uint64_t offset) {
    const auto head = head_of(line);
    if (!head) return;
    if (head->schema != kJournalSchema)
      throw InputError(fmt::format(
          "{}: schema {}, but this program writes {}; move the file, or use the program that wrote it", path_,
          head->schema, kJournalSchema));
    if (accepts(*head)) entries_[head->key] = {offset, line.size()};
    known = true;
  });
  if (!known && !may_be_truncated_journal(path_))
    throw InputError(fmt::format(
        "{}: not a journal of bristle; move the file: the run writes its journal to this path", path_));
}

bool Journal::accepts(const LineHead& head) const { return is_dirty(commit_) || !is_dirty(head.commit); }

JournalLine Journal::read(const std::string& key) const {
  const Entry& entry = entries_.at(key);
  std::string text(entry.length, '\0');
  const ssize_t got = pread(file_, text.data(), text.size(), off_t(entry.offset));
  if (got == ssize_t(entry.length))
    if (const auto line = decode(text); line && line->key == key) return *line;
  throw RunError(fmt::format("{}: changed while in use; run the same command again", path_));
}

void Journal::append(const JournalLine& line) {
  const std::string text = encode(line);
  for (std::size_t written = 0; written < text.size();) {
    const ssize_t n = pwrite(file_, text.data() + written, text.size() - written, off_t(end_ + written));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) throw RunError(fmt::format("{}: {}", path_, std::strerror(n < 0 ? errno : ENOSPC)));
    written += std::size_t(n);
  }
  entries_[line.key] = {end_, text.size() - 1};
  end_ += text.size();
  if (std::time(nullptr) >= synced_ + kSyncSeconds) sync();
}

void Journal::sync() {
  if (fdatasync(file_) != 0) throw RunError(fmt::format("{}: {}", path_, std::strerror(errno)));
  synced_ = std::time(nullptr);
}

void Journal::adopt(const RecordFormat& format, std::set<std::string> keys) {
  fs::path folder = fs::path(path_).parent_path();
  if (folder.empty()) folder = ".";
  for (const auto& other : fs::directory_iterator(folder)) {
    const std::string name = other.path().string();
    if (!name.ends_with(kJournalExtension) || !other.is_regular_file() || fs::equivalent(other.path(), path_))
      continue;
    each_line(name, [&](const std::string& text, std::uint64_t) {
      const auto head = head_of(text);
      if (!head || !keys.contains(head->key) || !accepts(*head)) return;
      if (const auto line = decode(text); line && fits(line->record, format)) {
        append(*line);
        keys.erase(line->key);
      }
    });
    if (keys.empty()) return;
  }
}

}  // namespace bristle::results
