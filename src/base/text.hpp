// Words in messages: users' own in quotes, and the word that a misspelt one was meant to be.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace stillpoint {

/// 'word' for a message: control characters are escaped, so that no scene can drive a terminal, and the end of a very
/// long word is left out.
std::string in_quotes(std::string_view word);

/// The candidate with the smallest edit distance to word, for "did you mean"; empty if none is near.
std::string nearest(const std::string& word, const std::vector<std::string>& candidates);

/// "unknown value 'x'; did you mean 'y'?", or with the values on offer if none is near.
std::string unknown_word(const std::string& what, const std::string& word, const std::vector<std::string>& candidates);

}  // namespace stillpoint
