// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/plot/rsvg_library.hpp"

namespace rubato::plot {

const RsvgCalls& rsvg() {
  static const RsvgCalls calls{DynamicLibrary({.soname = RUBATO_RSVG_LIBRARY,
                                               .package = RUBATO_RSVG_PACKAGE,
                                               .users = "PNG files",
                                               .otherwise = " or write an SVG file"})};
  return calls;
}

} // namespace rubato::plot
