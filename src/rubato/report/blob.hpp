// SPDX-License-Identifier: LGPL-3.0-or-later
/// Arrays of a page as text.
#pragma once

#include <string>

namespace rubato::report {

/// An array as text, by the name under which the page's scripts find it.
struct Blob {
  std::string name;
  std::string text;
};

} // namespace rubato::report
