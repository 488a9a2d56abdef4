#pragma once

#include "results/record.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace bristle {

// A line of a journal: one finished point.
struct JournalLine {
  std::string key, commit;
  PointRecord record;
};

constexpr const char* kJournalSchema = "bristle-journal/1";

// Text with its line feed. Checksum and JSON; numbers that are not finite are words.
std::string encode(const JournalLine& line);
// None if it is torn or damaged. line is without its line feed.
std::optional<JournalLine> decode(std::string_view line);
// Key and commit alone, of a line whose checksum holds.
std::optional<JournalLine> head_of(std::string_view line);
// The schema of a line whose checksum holds.
std::optional<std::string> schema_of(std::string_view line);

}  // namespace bristle
