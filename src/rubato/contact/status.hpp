// SPDX-License-Identifier: LGPL-3.0-or-later
/// Statuses of contact points.
#pragma once

#include <cstdint>
#include <string_view>

namespace rubato::contact {

enum class Status : std::uint8_t { open, stick, slip };

std::string_view to_string(Status status);

} // namespace rubato::contact
