// SPDX-License-Identifier: LGPL-3.0-or-later
/// What goes wrong, as sentences and exit codes.
#pragma once

#include <functional>

namespace rubato::app {

/// Does `work` and returns its exit code. Exceptions become sentences on standard error and exit codes.
int reported(const std::function<int()>& work);

/// Ends the program without asking the libraries: one that could not write a file may break down over it.
[[noreturn]] void leave(int code);

} // namespace rubato::app
