// SPDX-License-Identifier: LGPL-3.0-or-later
/// Measurements as parts of docs/performance.md.
#pragma once

#include "study.hpp"
#include <filesystem>
#include <span>
#include <string>

namespace rubato::bench {

/// The processor, its memory and the day, in one line.
std::string machine_line();

/// A Markdown table, one row a study, and under it the exponents of what is fitted.
std::string table_of(std::span<const Measurement> measurements);

/// A Markdown table of what Google Benchmark wrote as JSON: time and counters of each kernel.
std::string table_of_kernels(const std::filesystem::path& json);

/// Replaces what stands between the lines `<!-- NAME -->` and `<!-- end of NAME -->` of a page. Throws
/// std::runtime_error when the page does not have them.
void write_part(const std::filesystem::path& page, const std::string& name, const std::string& text);

} // namespace rubato::bench
