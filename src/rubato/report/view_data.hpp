// SPDX-License-Identifier: LGPL-3.0-or-later
/// The mesh and the fields of a run as the page's view draws them: quantised, compressed, and thinned out
/// where they would not fit.
#pragma once

#include "rubato/report/blob.hpp"
#include "rubato/results/stored_fields.hpp"

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace rubato::report {

/// Copies share their description.
class ViewData {
  std::shared_ptr<nlohmann::ordered_json> kept_;

public:
  ViewData();

  /// dimension, bodies, cells by type, box, counts; `fields` with names, components and `levels`; `instants`;
  /// `stored_instants`; `ranges`: of each field, instant and component the least value and the step
  nlohmann::ordered_json& description;
  std::vector<Blob> blobs;
  std::size_t stored_instants = 0;
  std::size_t shown_instants = 0;
};

/// How coarse fields other than the displacement become, one after another, before instants are left out.
inline constexpr std::array<std::uint16_t, 9> coarser_levels{0xFFFE, 0x3FFE, 0x1FFE, 0xFFE, 0x7FE,
                                                             0x3FE,  0x1FE,  0xFE,   0x7E};

/// `prefix` begins the names of the arrays. `room`: bytes that they may take together; where all instants do
/// not fit even with the coarsest fields, every second one, third one … is kept, and the last. `fields` must
/// hold an instant at least. Throws InputError when fields cannot be read.
ViewData view_data(const results::StoredFields& fields, const std::string& prefix, std::size_t room);

} // namespace rubato::report
