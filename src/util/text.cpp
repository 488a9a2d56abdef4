#include "util/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <cctype>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <numeric>
#include <sstream>
#include <sys/ioctl.h>
#include <unistd.h>
#include <utility>

namespace bristle {
namespace {

// Returns the least number of insertions, removals, replacements and exchanges of neighbours that turn a into
// b.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before, last(b.size() + 1), row(b.size() + 1);
  std::iota(last.begin(), last.end(), 0);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1), last[j] + 1, row[j - 1] + 1});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before = last;
    last = row;
  }
  return last[b.size()];
}

std::string small_letters(std::string text) {
  for (char& c : text) c = char(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

}  // namespace

std::string did_you_mean(const std::string& word, const std::vector<std::string>& known) {
  std::string best;
  // If distances are equal without regard to capitals, the distance with regard to them decides.
  std::pair<std::size_t, std::size_t> least = {1 + std::max<std::size_t>(1, word.size() / 3), 0};
  for (const std::string& candidate : known)
    if (const std::pair distance = {edit_distance(small_letters(word), small_letters(candidate)),
                                    edit_distance(word, candidate)};
        distance < least && (candidate.size() != word.size() || 2 * distance.first < word.size())) {
      least = distance;
      best = candidate;
    }
  if (best.empty() && !word.empty())
    for (const std::string& candidate : known)
      if (small_letters(candidate).starts_with(small_letters(word) + "_") &&
          (best.empty() || candidate.size() < best.size()))
        best = candidate;
  return best.empty() ? "" : fmt::format(" (did you mean {}?)", best);
}

int digits_left(double value, double error, int most) {
  if (std::isnan(error)) return most;
  int digits = 1;
  for (double rest = std::abs(value); rest > error && digits < most; rest /= 10) ++digits;
  return std::max(digits, 2);
}

std::optional<double> number_in(const std::string& text) {
  double number = 0;
  const char* end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, number);
  if (parsed.ptr != end || text.empty() || parsed.ec == std::errc::invalid_argument) return {};
  if (parsed.ec == std::errc()) return number;
  return std::strtod(text.c_str(), nullptr);  // 0 or infinity, which from_chars() does not tell apart
}

std::string shell_quoted(const std::string& text) {
  const auto plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || std::strchr("_./=:-", c);
  };
  if (!text.empty() && std::all_of(text.begin(), text.end(), plain)) return text;
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string shell_command(const std::vector<std::string>& arguments) {
  std::vector<std::string> quoted;
  for (const std::string& argument : arguments) quoted.push_back(shell_quoted(argument));
  return fmt::format("{}", fmt::join(quoted, " "));
}

std::string printable(const std::string& text, const std::string& kept) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    // ASCII control characters, and control characters of Unicode that UTF-8 encodes as 0xc2 0x80 to 0xc2
    // 0x9f.
    const bool second = byte >= 0x80 && byte < 0xa0 && i > 0 && text[i - 1] == '\xc2';
    const bool control = (byte < 0x20 || byte == 0x7f || second) && kept.find(text[i]) == kept.npos;
    out += control ? fmt::format("\\x{:02x}", byte) : std::string(1, text[i]);
  }
  return out;
}

void write_message(const std::string& text) { write_stderr(printable(text, "\n")); }

void write_stderr(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

std::string wrapped(const std::string& text, std::size_t columns, std::size_t indent) {
  std::string out;
  std::size_t in_line = indent;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const bool first = in_line == indent;
    if (!first && in_line + 1 + word.size() > columns) {
      out += "\n" + std::string(indent, ' ');
      in_line = indent;
    } else if (!first) {
      out += ' ';
      ++in_line;
    }
    out += word;
    in_line += word.size();
  }
  return out;
}

std::string wrapped_lines(const std::string& text, std::size_t columns) {
  std::string out;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t begin = std::min(line.find_first_not_of(' '), line.size());
    if (line.size() > columns && line.find("  ", begin) == line.npos)
      line = std::string(begin, ' ') + wrapped(line.substr(begin), columns, begin + 4);
    out += line + "\n";
  }
  return out;
}

std::string aligned(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths;
  for (const std::vector<std::string>& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string out;
  for (const std::vector<std::string>& row : rows) {
    std::string line = fmt::format("  {:<{}}", row.front(), widths.front());
    for (std::size_t i = 1; i < row.size(); ++i) line += fmt::format("  {:>{}}", row[i], widths[i]);
    out += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return out;
}

std::size_t terminal_columns() {
  constexpr std::size_t least = 40, otherwise = 100;
  winsize size{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return otherwise;
  return std::max<std::size_t>(least, size.ws_col);
}

std::vector<std::string> split_list(const std::string& text) {
  std::vector<std::string> out;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t to = std::min(text.find(", ", from), text.size());
    out.push_back(text.substr(from, to - from));
    from = to + 2;
  }
  return out;
}

}  // namespace bristle
