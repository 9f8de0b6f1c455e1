// SPDX-License-Identifier: LGPL-3.0-or-later
/// Arrays as text that a browser reads back: in zlib's format, then base64. The page's script `data.js`
/// undoes it.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace rubato::report {

/// Differences of neighbours (modulo 2^16), first their low bytes, then their high ones: of smooth fields
/// these compress best.
std::string packed(std::span<const std::uint16_t> numbers);

/// The same in four bytes each, modulo 2^32.
std::string packed(std::span<const std::uint32_t> numbers);

/// The same of their bits.
std::string packed(std::span<const float> numbers);

} // namespace rubato::report
