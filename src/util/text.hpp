#pragma once

#include <string>
#include <vector>

namespace bristle {

// " (did you mean x?)" for the known word nearest to this one; empty if none is near.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& known);

// The text as one word of a shell's command line.
std::string shell_quoted(const std::string& text);

// Untrusted text with control characters, which would command a terminal, written as \x1b.
std::string printable(const std::string& text);

std::string replace_all(std::string text, const std::string& what, const std::string& by);

// "a, b, c" as {a, b, c}: lists of commits in /provenance.
std::vector<std::string> split_list(const std::string& text);

}  // namespace bristle
