#pragma once

#include <optional>
#include <string>
#include <vector>

namespace bristle {

// Returns " (did you mean x?)" with the known word of the smallest edit distance, in which capitals and small
// letters are the same, or with the shortest word that continues this one after "_"; empty if no word is
// similar, such as a single letter that is another one.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& known);

// Returns the number that the text states, rounded to the nearest double: 0 or infinity beyond the range of
// doubles. Returns none if the text states no number.
std::optional<double> number_in(const std::string& text);

// Returns the text quoted as one word of a shell command.
std::string shell_quoted(const std::string& text);
// Returns the shell command of these arguments.
std::string shell_command(const std::vector<std::string>& arguments);

// Returns untrusted text with control characters, except the characters in `kept`, replaced by escapes such
// as \x1b, because a terminal would execute them.
std::string printable(const std::string& text, const std::string& kept = "");

// Writes the text to standard error. If standard error is closed or on a full disk, only the text is lost: a
// message must not end the command that it is about.
void write_stderr(const std::string& text);
// Writes lines that may hold untrusted text to standard error, with their control characters, except line
// feeds, replaced by escapes.
void write_message(const std::string& text);

// Returns the text in lines of at most `columns` characters, broken at spaces. The first line is to follow
// `indent` characters; the others begin with as many spaces. A longer word has a line of its own.
std::string wrapped(const std::string& text, std::size_t columns, std::size_t indent);

// Returns the lines of a text, each in lines of at most `columns` characters, of which those after the first
// are indented by four more spaces. Rows of a table, which have spaces side by side, stay as they are.
std::string wrapped_lines(const std::string& text, std::size_t columns);

// Returns the rows of a table as lines: the first cells begin, and the others end at the same character.
std::string aligned(const std::vector<std::vector<std::string>>& rows);

// Returns the number of significant digits of a value that its error leaves, 2 to `most`; `most` without an
// error.
int digits_left(double value, double error, int most);

// Returns the width of the terminal that standard output is, at least 40; 100 if it is none.
std::size_t terminal_columns();

// Splits "a, b, c", the format of lists of commits in /provenance, into {a, b, c}.
std::vector<std::string> split_list(const std::string& text);

}  // namespace bristle
