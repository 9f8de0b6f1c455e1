// SPDX-License-Identifier: LGPL-3.0-or-later
/// Element matrices and strains of one bulk cell, on its undeformed shape, small strains.
///
/// Local dof = node · d + component, d = 2 or 3 displacement components. `points` are the node coordinates of
/// the cell in the order of its type (2D: z is ignored; axisymmetric: x is the radius, y the axis). Integrals
/// are over the volume: 2D ones carry the thickness, axisymmetric ones the whole ring, 2πr. Strains and
/// stresses are Voigt vectors as material/law.hpp orders them. Nothing here checks the cell's shape:
/// cell_faults (bulk.hpp) does, once, beforehand. What these functions give for an inverted cell is
/// meaningless, possibly not finite, but no crash. All throw std::invalid_argument when the type is no bulk
/// cell of the physics (HEXA8 in plane stress, SEG2 ever).
#pragma once

#include "rubato/cell/shape_table.hpp"
#include "rubato/cell/topology.hpp"
#include "rubato/element/section.hpp"
#include "rubato/material/law.hpp"
#include "rubato/study/study.hpp"

#include <Eigen/Core>

#include <span>

namespace rubato::element {

/// Element stiffness ∫ Bᵀ D B into `k`, square of size nodes · d, of a law with a constant tangent D.
void stiffness(CellType type, std::span<const Eigen::Vector3d> points, const material::Law& law,
               const Section& section, Eigen::Ref<Eigen::MatrixXd> k);

/// The same of any symmetric D, square of size strain_size.
void stiffness(CellType type, std::span<const Eigen::Vector3d> points, const material::Tangent& tangent,
               const Section& section, Eigen::Ref<Eigen::MatrixXd> k);

/// Consistent mass ∫ ρ N_i N_j into `m`, square of size nodes: the same for each component, so the whole
/// element matrix is m ⊗ 1.
void mass(CellType type, std::span<const Eigen::Vector3d> points, double density, const Section& section,
          Eigen::Ref<Eigen::MatrixXd> m);

/// Σ N_i x_i at the points of a table, a column each.
Eigen::Matrix3Xd places(const cell::ShapeTable& table, std::span<const Eigen::Vector3d> points);

/// The stiffness of a D, symmetric, at each point of cell::stiffness_rule.
void varying_stiffness(CellType type, std::span<const Eigen::Vector3d> points,
                       std::span<const material::Tangent> tangents, const Section& section,
                       Eigen::Ref<Eigen::MatrixXd> k);

/// The consistent mass of a density > 0 at each point of cell::mass_rule.
void varying_mass(CellType type, std::span<const Eigen::Vector3d> points, std::span<const double> densities,
                  const Section& section, Eigen::Ref<Eigen::MatrixXd> m);

/// Lumped mass of each node into `m` (size nodes), positive and adding up to the cell's mass. Linear cells:
/// row sums. Quadratic cells, where row sums may be negative: diagonal scaling of E. Hinton, T. Rock, O. C.
/// Zienkiewicz, A note on mass lumping and related processes in the finite element method, Earthq. Eng.
/// Struct. Dyn. 4 (1976) 245–249.
void lumped_mass(CellType type, std::span<const Eigen::Vector3d> points, double density,
                 const Section& section, Eigen::Ref<Eigen::VectorXd> m);

/// The same of a density at each point of cell::mass_rule.
void varying_lumped_mass(CellType type, std::span<const Eigen::Vector3d> points,
                         std::span<const double> densities, const Section& section,
                         Eigen::Ref<Eigen::VectorXd> m);

/// Strains at the points of cell::stiffness_rule into the columns of `strain` (strain_size × points);
/// `displacement` has nodes · d numbers.
void strains(CellType type, std::span<const Eigen::Vector3d> points, study::Physics physics,
             std::span<const double> displacement, Eigen::Ref<Eigen::MatrixXd> strain);

/// Forces of stresses that nodal values make, Σ_q w_q B_qᵀ σ_q N_j(q) at the points of cell::stiffness_rule
/// into `g` (nodes · d × nodes); `stress`: strain_size × points, by a nodal value of 1.
void stress_forces(CellType type, std::span<const Eigen::Vector3d> points, const Section& section,
                   const Eigen::MatrixXd& stress, Eigen::Ref<Eigen::MatrixXd> g);

/// Volume times weight (measure included) of each point of cell::stiffness_rule into `volume`.
void point_volumes(CellType type, std::span<const Eigen::Vector3d> points, const Section& section,
                   Eigen::Ref<Eigen::VectorXd> volume);

/// The smallest Jacobian determinant at the points of cell::stiffness_rule and cell::mass_rule: positive for
/// a cell that can be computed with. [length^dimension of the cell over that of its reference cell]
double worst_jacobian(CellType type, std::span<const Eigen::Vector3d> points);

} // namespace rubato::element
