#include "results/journal_line.hpp"

#include "util/error.hpp"
#include "util/json.hpp"
#include "util/sha.hpp"

#include <fmt/format.h>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>

namespace bristle::results {
namespace {

using Buffer = fmt::memory_buffer;
constexpr std::size_t kDigestLength = 64;

void put(Buffer& out, std::string_view text) { out.append(text); }

void put(Buffer& out, double x) {
  if (std::isnan(x)) put(out, R"("nan")");
  else if (std::isinf(x)) put(out, x > 0 ? R"("inf")" : R"("-inf")");
  else if (x == 0 && std::signbit(x)) put(out, "-0.0");  // other programs read -0 as an integer
  else fmt::format_to(std::back_inserter(out), "{}", x);
}

template <class Item>
void put(Buffer& out, const std::vector<Item>& items) {
  put(out, "[");
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (i > 0) put(out, ",");
    put(out, items[i]);
  }
  put(out, "]");
}

template <class Value>
void put(Buffer& out, const std::map<std::string, Value>& members) {
  const char* before = "{";
  for (const auto& [name, value] : members) {
    fmt::format_to(std::back_inserter(out), R"({}"{}":)", before, name);
    put(out, value);
    before = ",";
  }
  put(out, members.empty() ? "{}" : "}");
}

// Reads the JSON that encode() writes: its keys in their order, without blanks. Throws MalformedError for
// anything else.
class LineReader {
 public:
  explicit LineReader(std::string_view text) : rest_(text) {}

  bool take(std::string_view token) {
    if (!rest_.starts_with(token)) return false;
    rest_.remove_prefix(token.size());
    return true;
  }
  void expect(std::string_view token) {
    if (!take(token)) fail();
  }
  std::string word() {
    expect("\"");
    const auto end = rest_.find('"');
    if (end == std::string_view::npos) fail();
    std::string word(rest_.substr(0, end));
    rest_.remove_prefix(end + 1);
    return word;
  }
  std::vector<double> numbers() {
    return list<double>([this] { return number(); });
  }
  Rows rows() {
    return list<std::vector<double>>([this] { return numbers(); });
  }
  // Calls read(name) in front of the value of every member of an object.
  template <class Read>
  void members(Read read) {
    expect("{");
    if (take("}")) return;
    do {
      const std::string name = word();
      expect(":");
      read(name);
    } while (take(","));
    expect("}");
  }
  // The rest is a text, which may contain escapes, and the end of the object.
  std::string last_text() {
    if (!rest_.ends_with('}')) fail();
    const Json text = Json::parse(rest_.substr(0, rest_.size() - 1), nullptr, false);
    if (!text.is_string()) fail();
    return text;
  }
  void expect_end() const {
    if (!rest_.empty()) fail();
  }

 private:
  [[noreturn]] static void fail() { throw MalformedError("not a line of a journal"); }

  double number() {
    if (rest_.starts_with('"')) return number_of(word());
    double x = 0;
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), x);
    if (error != std::errc() || !std::isfinite(x)) fail();
    rest_.remove_prefix(std::size_t(end - rest_.data()));
    return x;
  }
  static double number_of(const std::string& word) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    if (word == "nan") return std::numeric_limits<double>::quiet_NaN();
    if (word == "inf") return infinity;
    if (word == "-inf") return -infinity;
    fail();
  }
  template <class Item, class Read>
  std::vector<Item> list(Read read) {
    std::vector<Item> items;
    expect("[");
    if (take("]")) return items;
    do items.push_back(read());
    while (take(","));
    expect("]");
    return items;
  }

  std::string_view rest_;
};

LineHead read_head(LineReader& in) {
  LineHead head;
  in.expect(R"({"schema":)");
  head.schema = in.word();
  if (head.schema != kJournalSchema) return head;
  in.expect(R"(,"key":)");
  head.key = in.word();
  in.expect(R"(,"commit":)");
  head.commit = in.word();
  return head;
}

PointRecord read_numbers(LineReader& in) {
  PointRecord record;
  in.expect(R"(,"values":)");
  in.members(
      [&](const std::string& name) { record.values.emplace_hint(record.values.end(), name, in.numbers()); });
  in.expect(R"(,"tables":)");
  in.members([&](const std::string& name) { record.tables[name] = in.rows(); });
  if (in.take(R"(,"failure":)")) {
    record.failure = in.last_text();
    return record;
  }
  in.expect("}");
  in.expect_end();
  return record;
}

// What read() makes of the JSON of a line. None if the checksum does not match, or if it is not JSON of a
// journal.
template <class Read>
auto checked(std::string_view line, Read read) -> std::optional<decltype(read(std::declval<LineReader&>()))> {
  if (line.size() <= kDigestLength || line[kDigestLength] != ' ') return {};
  const std::string_view json = line.substr(kDigestLength + 1);
  if (sha256_of(json) != line.substr(0, kDigestLength)) return {};
  try {
    LineReader in(json);
    return read(in);
  } catch (const MalformedError&) {
    return {};
  }
}

}  // namespace

std::string encode(const JournalLine& line) {
  Buffer json;
  fmt::format_to(std::back_inserter(json), R"({{"schema":"{}","key":"{}","commit":"{}","values":)",
                 kJournalSchema, line.key, line.commit);
  put(json, line.record.values);
  put(json, R"(,"tables":)");
  put(json, line.record.tables);
  if (!line.record.failure.empty()) put(json, R"(,"failure":)" + Json(line.record.failure).dump());
  put(json, "}");
  const std::string_view text(json.data(), json.size());
  return fmt::format("{} {}\n", sha256_of(text), text);
}

std::optional<JournalLine> decode(std::string_view line) {
  const auto read = checked(line, [](LineReader& in) -> std::optional<JournalLine> {
    LineHead head = read_head(in);
    if (head.schema != kJournalSchema) return {};
    return JournalLine{head.key, head.commit, read_numbers(in)};
  });
  return read.value_or(std::nullopt);
}

std::optional<LineHead> head_of(std::string_view line) { return checked(line, read_head); }

}  // namespace bristle::results
