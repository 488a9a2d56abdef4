#pragma once

#include "results/journal_line.hpp"

#include <cstdint>
#include <string>
#include <unordered_map>

namespace bristle {

// Key of a point in journals: SHA-256 of what its numbers depend on and of kNumericsVersion.
std::string point_key(const Experiment& experiment, std::size_t index);

// The commit of a program that nobody can build again: it had changes, or none is known.
bool is_dirty(const std::string& commit);

// Finished points, kept beside a result in FILE.h5.journal: whatever ends a run, the next one continues. One
// line per point, the SHA-256 of the rest and JSON with numbers that read back exactly; see
// docs/results-format.md. What is torn or damaged is passed over, so that its point is computed again.
class Journal {
 public:
  // Creates the file and its folder if need be, and keeps other runs off until it is destroyed or the process
  // dies. commit is that of this program; a clean one passes over what a program with uncommitted changes
  // computed. forget: begins anew. Throws InputError if the place cannot be written or holds something else,
  // RunError if another run has it.
  Journal(const std::string& result, const std::string& commit, bool forget);
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  const std::string& path() const { return path_; }
  bool has(const std::string& key) const { return entries_.contains(key); }
  // Throws RunError if it reads otherwise than before.
  JournalLine read(const std::string& key) const;

  // The record is with the system when this returns, and on the disk some seconds later. Throws RunError, for
  // instance for a full disk; what was there before stays.
  void append(const std::string& key, const PointRecord& record) { append({key, commit_, record}); }
  void sync();

  // Takes over, of these points, those that journals of other results in the same folder have.
  void adopt(const Experiment& experiment, const std::vector<std::size_t>& points);

 private:
  struct Entry {
    std::uint64_t offset, length;
  };

  void scan();
  bool trusts(const JournalLine& head) const;
  void append(const JournalLine& line);

  std::string path_, commit_;
  int file_ = -1;
  std::uint64_t end_ = 0;  // of the last whole line
  long synced_ = 0;        // time, s
  std::unordered_map<std::string, Entry> entries_;
};

}  // namespace bristle
