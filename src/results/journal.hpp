#pragma once

#include "results/journal_line.hpp"

#include <cstdint>
#include <set>
#include <string>
#include <unordered_map>

namespace bristle::results {

// Key of a point in journals: SHA-256 of canonical_point() and kNumericsVersion.
std::string point_key(const Experiment& experiment, std::size_t index);

// Whether the program cannot be built again from its commit: there were uncommitted changes, or it is
// unknown.
bool is_dirty(const std::string& commit);

// The finished points of a run, in FILE.h5.journal beside the result FILE.h5, from which the next run resumes
// if this one ends early. One line per point: the SHA-256 of the rest of the line, and JSON with numbers that
// read back exactly (docs/results-format.md). Truncated and damaged lines are ignored; their points are
// computed again.
class Journal {
 public:
  // Creates the file and its folder if necessary, and locks it until the destructor runs or the process ends.
  // commit is that of this program; if it is clean, points computed by programs with uncommitted changes are
  // ignored. clear removes all points. Throws InputError if the file cannot be written or is not a journal,
  // RunError if another run holds the lock.
  Journal(const std::string& result, const std::string& commit, bool clear);
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  const std::string& path() const { return path_; }
  bool has(const std::string& key) const { return entries_.contains(key); }
  // Throws RunError if the line has changed since the journal was opened.
  JournalLine read(const std::string& key) const;

  // Hands the record to the operating system; it is on the disk some seconds later, or after sync(). Throws
  // RunError, for instance if the disk is full; the earlier points remain.
  void append(const std::string& key, PointRecord record) { append({key, commit_, std::move(record)}); }
  void sync();

  // Copies the points with these keys, as far as journals of other results in the same folder contain them in
  // this format.
  void adopt(const RecordFormat& format, std::set<std::string> keys);

 private:
  struct Entry {
    std::uint64_t offset, length;
  };

  void scan();
  bool accepts(const LineHead& head) const;
  void append(const JournalLine& line);

  std::string path_, commit_;
  int file_ = -1;
  std::uint64_t end_ = 0;  // of the last complete line
  long synced_ = 0;        // time of the last sync(), s
  std::unordered_map<std::string, Entry> entries_;
};

}  // namespace bristle::results
