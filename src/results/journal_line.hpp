#pragma once

#include "results/record.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace bristle::results {

// A line of a journal: one finished point.
struct JournalLine {
  std::string key, commit;
  PointRecord record;
};

// The start of a line. Of another schema than kJournalSchema, key and commit remain empty.
struct LineHead {
  std::string schema, key, commit;
};

constexpr const char* kJournalSchema = "bristle-journal/1";

// The line with its line feed: checksum and JSON. Numbers that are not finite are written as words.
std::string encode(const JournalLine& line);
// The opposite, of a line without its line feed. None if the line is truncated or damaged.
std::optional<JournalLine> decode(std::string_view line);
// The head of a line, without its record. None if the checksum does not match.
std::optional<LineHead> head_of(std::string_view line);

}  // namespace bristle::results
