// SPDX-License-Identifier: LGPL-3.0-or-later
/// The files of the folder web, which the build puts into the library.
#pragma once

#include <stdexcept>
#include <string_view>

namespace rubato::report {

/// The text of a file by its path below the folder. Throws std::out_of_range when there is none of that name.
std::string_view asset(std::string_view name);

} // namespace rubato::report
