#include "results/journal.hpp"
#include "util/error.hpp"
#include "util/sha.hpp"

#include <fmt/format.h>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>

namespace bristle::results {
namespace {

// JSON has no numbers that are not finite.
const std::pair<const char*, double> kNumberWords[] = {
    {"nan", std::numeric_limits<double>::quiet_NaN()}, {"inf", INFINITY}, {"-inf", -INFINITY}};

// Returns the JSON of a line without its digest; none if the line is truncated or damaged.
std::optional<std::string_view> intact(std::string_view line) {
  if (line.size() <= kDigestLength || line[kDigestLength] != ' ') return {};
  const std::string_view text = line.substr(kDigestLength + 1);
  if (sha256_of(text) != line.substr(0, kDigestLength)) return {};
  return text;
}

// Reads the JSON that encode() writes. Each function returns false for any other text.
class LineReader {
 public:
  explicit LineReader(std::string_view text) : rest_(text) {}

  bool schema(JournalStart& out) { return literal(R"({"schema":)") && word(out.schema); }
  bool start(JournalStart& out) {
    return schema(out) && out.schema == kJournalSchema && literal(R"(,"key":)") && word(out.key) &&
           literal(R"(,"commit":)") && word(out.commit) && literal(R"(,"host":)") && word(out.host) &&
           literal(R"(,"layout":)") && word(out.layout);
  }
  bool record(PointRecord& out) {
    const auto columns = [&] {
      Rows& rows = out.tables.emplace_back();
      return list([&] { return numbers(rows.emplace_back()); });
    };
    return literal(R"(,"values":)") && numbers(out.values) && literal(R"(,"tables":)") && list(columns) &&
           (rest_ == "}" || failure(out.failure));
  }

 private:
  bool literal(std::string_view text) {
    if (!rest_.starts_with(text)) return false;
    rest_.remove_prefix(text.size());
    return true;
  }
  // Reads a text without escapes.
  bool word(std::string& out) {
    if (!literal("\"")) return false;
    const std::size_t end = rest_.find_first_of("\"\\");
    if (end == rest_.npos || rest_[end] == '\\') return false;
    out = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    return true;
  }
  bool number(double& out) {
    for (const auto& [word, value] : kNumberWords)
      if (rest_.starts_with('"') && rest_.substr(1).starts_with(word)) {
        out = value;
        rest_.remove_prefix(1 + std::string_view(word).size());
        return literal("\"");
      }
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), out);
    if (error != std::errc() || !std::isfinite(out)) return false;
    rest_.remove_prefix(std::size_t(end - rest_.data()));
    return true;
  }
  template <class Element>
  bool list(Element element) {
    if (!literal("[")) return false;
    for (bool first = true; !rest_.starts_with(']'); first = false)
      if (!(first || literal(",")) || !element()) return false;
    rest_.remove_prefix(1);
    return true;
  }
  bool numbers(std::vector<double>& out) {
    return list([&] { return number(out.emplace_back()); });
  }
  // Reads the last member, a text with any escapes.
  bool failure(std::string& out) {
    if (!literal(R"(,"failure":)") || !rest_.ends_with('}')) return false;
    try {
      const Json text = parse_json(std::string(rest_.substr(0, rest_.size() - 1)));
      if (!text.is_string()) return false;
      out = text;
      return true;
    } catch (const InputError&) {
      return false;
    }
  }

  std::string_view rest_;
};

class LineWriter {
 public:
  void add(std::string_view text) { text_.append(text); }
  void add_word(const char* name, const std::string& word) {
    fmt::format_to(std::back_inserter(text_), R"(,"{}":{})", name, Json(word).dump());
  }
  template <class List, class Add>
  void add_list(const List& list, const Add& add_element) {
    text_.push_back('[');
    bool first = true;
    for (const auto& element : list) {
      if (!first) text_.push_back(',');
      first = false;
      add_element(element);
    }
    text_.push_back(']');
  }
  void add_numbers(const std::vector<double>& numbers) {
    add_list(numbers, [&](double x) {
      if (std::isfinite(x)) fmt::format_to(std::back_inserter(text_), "{}", x);
      else add(std::isnan(x) ? R"("nan")" : x > 0 ? R"("inf")" : R"("-inf")");
    });
  }
  std::string_view text() const { return {text_.data(), text_.size()}; }

 private:
  fmt::memory_buffer text_;
};

}  // namespace

std::string encode(const std::string& key, const std::string& commit, const std::string& host,
                   const PointRecord& record) {
  LineWriter out;
  out.add(fmt::format(R"({{"schema":"{}")", kJournalSchema));
  out.add_word("key", key);
  out.add_word("commit", commit);
  out.add_word("host", host);
  out.add_word("layout", record.layout->digest());
  out.add(R"(,"values":)");
  out.add_numbers(record.values);
  out.add(R"(,"tables":)");
  out.add_list(record.tables, [&](const Rows& rows) {
    out.add_list(rows, [&](const std::vector<double>& column) { out.add_numbers(column); });
  });
  if (!record.failure.empty()) out.add_word("failure", record.failure);
  out.add("}");
  return fmt::format("{} {}\n", sha256_of(out.text()), out.text());
}

std::optional<JournalLine> decode(std::string_view line, const Layout& layout) {
  const auto text = intact(line);
  if (!text) return {};
  JournalLine out;
  out.record.layout = layout;
  LineReader reader(*text);
  if (!reader.start(out) || out.layout != layout->digest()) return {};
  out.record.values.reserve(layout->variables.size());
  if (!reader.record(out.record) || !is_consistent(out.record)) return {};
  return out;
}

std::optional<JournalStart> decode_start(std::string_view line) {
  const auto text = intact(line);
  if (!text) return {};
  JournalStart out;
  if (LineReader(*text).start(out)) return out;
  JournalStart other;
  if (!LineReader(*text).schema(other)) return {};
  return other;
}

}  // namespace bristle::results
