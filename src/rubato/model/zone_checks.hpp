// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

/// What a contact zone has to fulfil on its mesh. Each check adds a fault for what it finds and throws
/// nothing.

#include "rubato/constraint/reduction.hpp"
#include "rubato/contact/zone.hpp"
#include "rubato/core/error.hpp"
#include "rubato/domain/dof_map.hpp"
#include "rubato/mesh/mesh.hpp"
#include "rubato/mesh/sheet.hpp"
#include "rubato/model/build.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace rubato::model {

/// Where the study has the name of a zone's surface; `side` is master or slave.
Mention mention_of(const study::ContactZone& settings, const std::string& surface, std::string_view side);
Mention slave_of(const study::ContactZone& settings);
Mention master_of(const study::ContactZone& settings);

/// Nothing but supports moves the nodes of a sheet.
void check_sheets(const mesh::Mesh& mesh, const Mention& name, const mesh::Sheets& sheets,
                  const domain::DofMap& dofs, const constraint::Reduction& reduction,
                  std::vector<Fault>& faults);

/// With fewer points than the multipliers of a face can tell apart, their equations would be dependent; and a
/// rule that misses the shape functions would hand on no uniform pressure.
void check_rule(const study::ContactZone& zone, const contact::Surface& slave, std::vector<Fault>& faults);

/// Nodes of a tied slave have one normal: none of its edges is sharper than 60°.
void check_edges(const contact::Zone& zone, const mesh::Mesh& mesh, std::vector<Fault>& faults);

/// What is added to the gaps is a number at each point when the run begins, and no overlap then where the
/// scheme leaves overlaps of the start as they are.
void check_offset(const contact::Zone& zone, const study::TimeStepping& time, std::vector<Fault>& faults);

/// The friction at each point of a zone where it depends on the place; empty where it does not. Faults, told
/// at `path`, where it is no number or negative.
std::vector<double> friction_shares(const contact::Zone& zone, const std::string& path,
                                    std::vector<Fault>& faults);

/// A tie has to hold something.
void check_tie(const contact::Zone& zone, const mesh::Mesh& mesh, const domain::DofMap& dofs,
               const constraint::Reduction& reduction, std::vector<Fault>& faults);

} // namespace rubato::model
