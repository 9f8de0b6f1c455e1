// SPDX-License-Identifier: LGPL-3.0-or-later
/// Drawings as files.
#pragma once

#include <filesystem>
#include <string>

namespace rubato::plot {

/// Throws InputError when the name does not end in .svg or .png.
void require_picture_name(const std::filesystem::path& path);

/// Writes an SVG document as it is, or, where the name ends in .png, its picture with a pixel for each of its
/// units. Throws InputError when the file cannot be made, WriteError when it cannot be written to its end; a
/// former file is still there then.
void write_picture(const std::filesystem::path& path, const std::string& svg);

} // namespace rubato::plot
