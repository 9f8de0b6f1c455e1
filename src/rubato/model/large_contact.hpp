// SPDX-License-Identifier: LGPL-3.0-or-later
/// Zones with so many points that what all of them do to one another does not fit into the memory.
#pragma once

#include "rubato/model/fwd.hpp"

#include <string>
#include <vector>

namespace rubato::model {

/// A sentence for each zone of an implicit run for which a step would form a dense matrix of more than
/// 2 GB if all of its points touched at once: where points share multipliers, or only contact holds bodies.
/// Others are solved for without such a matrix.
std::vector<std::string> notes_on_large_contact(const Model& model);

} // namespace rubato::model
