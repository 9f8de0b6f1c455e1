// SPDX-License-Identifier: LGPL-3.0-or-later
/// Inside the module only: equations between nodes, and the axes that lines of a node refer to.
#pragma once

#include "rubato/inp/reading.hpp"

#include <Eigen/Core>

#include <optional>
#include <string_view>
#include <vector>

namespace rubato::inp {

Eigen::Vector3d point_of(const Reading& reading, std::int32_t node);

/// Columns: the unit vectors of the degrees of freedom 1 to 3 of lines that name the node.
Eigen::Matrix3d axes_of(const Reading& reading, std::int32_t node);
bool has_own_axes(const Reading& reading, std::int32_t node);
/// Columns: the axes at a place.
Eigen::Matrix3d axes_at(const LocalAxes& axes, const Eigen::Vector3d& place);

/// Σ coefficient · displacement over nodes, of which a node may come several times.
class Sum {
public:
  void add(std::int32_t node, const Eigen::Vector3d& coefficients);
  const std::vector<std::pair<std::int32_t, Eigen::Vector3d>>& terms() const { return terms_; }

private:
  std::vector<std::pair<std::int32_t, Eigen::Vector3d>> terms_;
};
/// The sum is 0. Coefficients that are rounding beside the largest are left out.
void add_equation(Reading& reading, const Sum& sum, std::string_view label, const Word& at);

/// A single node.
std::optional<std::int32_t> one_node(Reading& reading, int scope, const Word& word);

/// Adds the displacement along `direction` of a place that moves with a reference and its rotations, times
/// the factor: u + θ × (place − point of the reference).
void add_carried(const Reading& reading, std::int32_t reference, const Eigen::Vector3d& place,
                 const Eigen::Vector3d& direction, double factor, Sum& sum);

/// Returns whether an element that deforms has the node.
bool is_of_body(const Reading& reading, std::int32_t node);

/// Parts of a target whose nodes have the same axes; the whole where no node has axes of its own.
std::vector<Target> with_equal_axes(const Reading& reading, const Target& target);
/// Returns whether no element, equation, spring or mass has the nodes, and adds a note if so.
bool is_unused(Reading& reading, const Target& target, const Word& at);
/// The node that has the rotations where the degree of freedom (from 0) is one, and that of the node then.
void turn_to_rotation(const Reading& reading, Target& target, int& dof);

/// Displacements of nodes without elements that nothing uses are held: they mean nothing.
void hold_unused(Reading& reading);

} // namespace rubato::inp
