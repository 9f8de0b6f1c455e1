// SPDX-License-Identifier: LGPL-3.0-or-later
/// Two columns of a text file of numbers.
#pragma once

#include "rubato/core/linear_table.hpp"

#include <filesystem>
#include <string>

namespace rubato::deck {

/// Reads the columns of those names as abscissae and values; an empty name of the abscissae is the first
/// column. The first line has the names of the columns; lines that are empty or begin with '#' are passed
/// over. Columns are separated by ',', by ';' or by tabs, whichever the line of names has. Throws InputError
/// at file:line when the file cannot be read, a column is missing, a number is none or is not finite, or
/// abscissae do not ascend.
LinearTable read_csv_table(const std::filesystem::path& file, const std::string& at,
                           const std::string& values);

} // namespace rubato::deck
