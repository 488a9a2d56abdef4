#pragma once

#include "results/record.hpp"

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace bristle::results {

// Returns the key of a point in journals: SHA-256 of Sweep::key() and kNumericsVersion.
std::string point_key(const Sweep& sweep, std::size_t index);

// Returns true if the program cannot be built again from its commit: there were uncommitted changes, or the
// commit is unknown.
bool is_dirty(const std::string& commit);

inline constexpr const char* kJournalSchema = "bristle-journal/2";
inline constexpr std::size_t kDigestLength = 64;  // length of the SHA-256 with which a line begins

// The start of a line: which finished point it has, and where the point was computed. layout: the digest of
// the layout of the point's record. All members but schema are empty if the line is of another schema or
// malformed.
struct JournalStart {
  std::string schema, key, commit, host, layout;
};
struct JournalLine : JournalStart {
  PointRecord record;
};

// Returns the line of a point with its line feed: the SHA-256 of the rest, and JSON with numbers that read
// back exactly, in the order of the record's layout. Numbers that are not finite are words.
std::string encode(const std::string& key, const std::string& commit, const std::string& host,
                   const PointRecord& record);
// Reads a line, without its line feed, that encode() has written. Returns none if the line is truncated,
// damaged, of another schema or layout, or if its record is not consistent.
std::optional<JournalLine> decode(std::string_view line, const Layout& layout);
// Reads only the start of the line, but checks the digest of the whole line. Returns none if the line is
// truncated or damaged.
std::optional<JournalStart> decode_start(std::string_view line);

// Calls visit for every line of the journal at path that a program of this commit uses. Points computed by
// programs with uncommitted changes are used by such programs only.
void read_journal(const std::string& path, const std::string& commit,
                  const std::function<void(const JournalStart&)>& visit);
// Returns the paths of all journals in the folder of a result, in ascending order.
std::vector<std::string> journals_beside(const std::string& result);

// Keeps the finished points of a run, from which the next run resumes if this one ends early. Ignores
// truncated and damaged lines; their points are computed again.
class Journal {
 public:
  // Creates the file and its folder if necessary, and locks the file until the destructor runs or the process
  // ends. commit: the commit of this program. ignore: points in the file stay there, but count as missing
  // until they are appended again. Throws InputError if the file cannot be written or is not a journal,
  // RunError if another run holds the lock.
  Journal(const std::string& path, const std::string& commit, bool ignore);
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  const std::string& path() const { return path_; }
  bool has(const std::string& key) const { return entries_.contains(key); }
  // Returns a point; none if the journal does not have it in this layout.
  std::optional<JournalLine> find(const std::string& key, const Layout& layout) const;
  // Returns a point. Throws RunError if its line has changed since the journal was opened.
  JournalLine read(const std::string& key, const Layout& layout) const;

  // Hands the record to the operating system; it is on the disk some seconds later, or after sync(). Throws
  // RunError, for instance if the disk is full; the earlier points remain.
  void append(const std::string& key, const PointRecord& record);
  void sync();

  // Copies points (key -> place, for messages) from another journal, as far as it has them in this layout.
  // Reads the whole file the first time, and again if its size has changed. Throws InputError if both
  // journals have one of the points with different numbers.
  void adopt(const std::string& other, const Layout& layout,
             const std::map<std::string, std::string>& points);
  // Removes the other journal if this one has all its points, unless a run is writing it. Call sync() before.
  void remove_copied(const std::string& other) const;

 private:
  struct Entry {
    std::uint64_t offset, length;
  };
  using Entries = std::unordered_map<std::string, Entry>;  // by key
  struct Other {
    std::uintmax_t size;
    Entries entries;
  };

  void scan();
  void append_text(const std::string& key, const std::string& text);
  const Entries& entries_of(const std::string& other);

  std::string path_, commit_;
  int file_ = -1;
  std::uint64_t end_ = 0;  // end of the last complete line
  long synced_ = 0;        // time of the last sync(), s
  Entries entries_;
  std::map<std::string, Other> others_;  // other journals that were read, by path
};

}  // namespace bristle::results
