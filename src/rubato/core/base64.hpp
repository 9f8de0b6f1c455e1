// SPDX-License-Identifier: LGPL-3.0-or-later
/// Bytes as text (RFC 4648, section 4).
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rubato {

std::string to_base64(std::span<const std::byte> bytes);

/// Letters of the code up to the first padding or to the end; blanks between them count for nothing. Throws
/// std::invalid_argument at any other letter.
std::vector<std::byte> from_base64(std::string_view text);

} // namespace rubato
