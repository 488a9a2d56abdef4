#pragma once

#include <string>
#include <vector>

namespace bristle {

// " (did you mean x?)" with the known word of the smallest edit distance; empty if none is similar.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& known);

// The text quoted as one word of a shell command.
std::string shell_quoted(const std::string& text);

// Untrusted text with control characters replaced by escapes such as \x1b, as a terminal would execute them.
std::string printable(const std::string& text);

std::string replace_all(std::string text, const std::string& what, const std::string& by);

// Splits "a, b, c", the format of lists of commits in /provenance, into {a, b, c}.
std::vector<std::string> split_list(const std::string& text);

}  // namespace bristle
