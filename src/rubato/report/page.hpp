// SPDX-License-Identifier: LGPL-3.0-or-later
/// The page of a report, put together from the files of the folder web.
#pragma once

#include "rubato/report/blob.hpp"

#include <nlohmann/json_fwd.hpp>

#include <ostream>
#include <span>
#include <string>

namespace rubato::report {

/// Writes the whole page: styles, data, arrays and scripts are in it, nothing is loaded from elsewhere.
/// `data` is what the scripts find in rubato.data.
void write_page(std::ostream& to, const std::string& title, const nlohmann::ordered_json& data,
                std::span<const Blob> blobs);

} // namespace rubato::report
