// SPDX-License-Identifier: LGPL-3.0-or-later
/// Contact by nodes whose slave has its nodes farther apart than its master.
#pragma once

#include "rubato/model/fwd.hpp"

#include <string>
#include <vector>

namespace rubato::model {

/// A sentence for each zone by nodes whose slave nodes are more than 1.2 times as far apart as those of a
/// master that deforms. Nothing keeps the master's nodes between slave nodes out of the slave.
std::vector<std::string> notes_on_coarse_slaves(const Model& model);

} // namespace rubato::model
