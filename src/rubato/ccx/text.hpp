// SPDX-License-Identifier: LGPL-3.0-or-later
/// Inside the module only: numbers, labels and lines as CalculiX reads them.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rubato::ccx {

/// The number with a point and all its digits, or with as many as 20 characters hold: CalculiX reads no more
/// of a field.
std::string shown_number(double value);

/// "1, 2, 3" with at most `most` entries a line; each line ends with a line break.
std::string rows_of(std::span<const std::string> entries, std::size_t most = 12);
std::string rows_of(std::span<const std::int64_t> numbers);

/// Labels that differ in any case, each made of letters, digits, "_" and "-", a letter first, of at most 70
/// characters.
class Labels {
public:
  /// A label for a name of a kind ("NSET"), which no other one of the kind has.
  std::string chosen(std::string_view kind, std::string_view name);

private:
  std::map<std::string, std::set<std::string>, std::less<>> taken_; ///< folded, by kind
};

} // namespace rubato::ccx
