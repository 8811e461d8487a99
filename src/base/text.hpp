// Words in messages: quoting of the user's words, and suggestions for misspelt ones.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace stillpoint {

/// A text with its control characters escaped: one line, so that no text from a scene can control a terminal.
std::string one_line(std::string_view text);

/// A number with its noun: "1 spring", "2 springs".
std::string counted(std::size_t number, std::string_view what);

/// The text, with its end replaced by "…" if it is longer than `longest` bytes.
std::string shortened(std::string_view text, std::size_t longest);

/// 'word' for a message: in one line, and without the end of a very long word.
std::string in_quotes(std::string_view word);

/// The candidate with the smallest edit distance to word, for "did you mean"; empty if none is near.
std::string nearest(const std::string& word, const std::vector<std::string>& candidates);

/// "unknown value 'x'; did you mean 'y'?", or with the permitted values if none is near. What
/// other programs call it is near as well ("gravity", "sigma_yy"), and so is its end alone ("rk4" of "erk:rk4").
std::string unknown_word(const std::string& what, const std::string& word, const std::vector<std::string>& candidates);

/// Whether a program may give something this name in scenes; what_a_plain_word_is states the rule for messages.
bool is_plain_word(std::string_view name);
inline constexpr std::string_view what_a_plain_word_is =
    "lower-case letters, digits and hyphens, beginning with a letter";

}  // namespace stillpoint
