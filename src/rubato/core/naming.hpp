// SPDX-License-Identifier: LGPL-3.0-or-later
/// Words and names as messages show them.
#pragma once

#include <string>
#include <vector>

namespace rubato {

/// `word` between quotes as a sentence may show it: long ones are cut.
std::string shown(const std::string& word);

/// The candidate nearest to `word` by edit distance, or an empty string when none is near enough to be meant.
std::string nearest_word(const std::string& word, const std::vector<std::string>& candidates);

/// "; did you mean 'step'?", or, when no candidate is near, "; expected one of a, b, c".
std::string suggestion(const std::string& word, const std::vector<std::string>& candidates);

/// "a, b, c" where ", " is put between.
std::string joined(const std::vector<std::string>& words, const std::string& between);

/// Whether a name that the user chose may be a column or a folder of the results: up to 100 letters, digits,
/// "_" and "-".
bool is_name(const std::string& text);

} // namespace rubato
