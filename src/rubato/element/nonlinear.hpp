// SPDX-License-Identifier: LGPL-3.0-or-later
/// Internal forces, tangent and energy of one bulk cell whose law may be nonlinear and whose motion may be
/// large. Everything refers to the undeformed shape: with w the volume of a point, F = 1 + ∂u/∂X and P the
/// first Piola stress
///
///   f = Σ w (∂F/∂u)ᵀ:P        K = Σ w (∂F/∂u)ᵀ:A:(∂F/∂u),   A = ∂P/∂F
///
/// Local dof, points, section and units are those of element.hpp. Nothing here checks the undeformed shape:
/// cell_faults (domain/bulk.hpp) does. No memory is allocated.
///
/// full             the rule of cell::stiffness_rule for everything
/// mean_dilatation  the change of volume of a point is that of its cell: J. C. Simo, R. L. Taylor, K. S.
///                  Pister, CMAME 51 (1985) 177–208; small strain: T. J. R. Hughes, Int. J. Numer. Meth. Eng.
///                  15 (1980) 1413–1418. In TRIA7, QUAD8, QUAD9, HEXA20 and HEXA27 it is a linear function
///                  of the place (nonlinear/dilatation_space.hpp). Of these QUAD8 and HEXA20 have one
///                  displacement mode more, a bubble (nonlinear/bubble_cell.hpp)
/// enhanced         strain from displacement modes of the cell's own: R. L. Taylor, P. J. Beresford, E. L.
///                  Wilson, Int. J. Numer. Meth. Eng. 10 (1976) 1211–1219; J. C. Simo, M. S. Rifai, ibid. 29
///                  (1990) 1595–1638; J. C. Simo, F. Armero, ibid. 33 (1992) 1413–1449
/// reduced          one point, which has the means of the gradients over the volume, and forces against what
///                  it does not see: D. P. Flanagan, T. Belytschko, ibid. 17 (1981) 679–706
/// lower_order      2 × 2 points in QUAD8, 2 × 2 × 2 in HEXA20, and no forces against what they do not see:
///                  one motion of a QUAD8, six of a HEXA20 (O. C. Zienkiewicz, R. L. Taylor, J. M. Too, ibid.
///                  3 (1971) 275–290)
#pragma once

#include "rubato/element/element.hpp"
#include "rubato/element/failure.hpp"
#include "rubato/element/point_laws.hpp"
#include "rubato/element/point_record.hpp"

#include <Eigen/Core>

#include <span>

namespace rubato::element {

/// The strain that the law sees, and what its stress is conjugate to.
enum class StrainKind {
  small,          ///< ε = sym ∂u/∂X, σ
  green_lagrange, ///< E = ½(FᵀF − 1), S
  logarithmic     ///< E = ½ ln FᵀF, T
};

enum class Formulation { full, mean_dilatation, enhanced, reduced, lower_order };

/// What keeps reduced cells in shape (nonlinear/hourglass_control.hpp).
struct HourglassControl {
  double modulus = 0; ///< shear modulus of the law where nothing has happened [stress]
  double limit = 0;   ///< strain from which on it resists with a constant stress; 0: never
};

/// What is the same for all cells of a kind. In plane stress the law is one that gives stresses with zz = 0
/// and the tangent that belongs to them.
struct CellKind {
  CellType type = CellType::hexa8;
  Section section;
  StrainKind strain = StrainKind::small;
  Formulation formulation = Formulation::full;
  HourglassControl hourglass = {}; ///< reduced cells only
};

/// Returns whether the kind exists: `full` for every bulk cell, `mean_dilatation` for all but TRIA3, TETRA4
/// and pyramids and not in plane stress, `enhanced` for QUAD4 and HEXA8 with small or Green–Lagrange strain,
/// `reduced` for QUAD4 and HEXA8, `lower_order` for QUAD8 and HEXA20.
bool is_offered(const CellKind& kind);

/// Points of cell::stiffness_rule; 1 of reduced cells, those of lower_order_rule (lower_order.hpp) of cells
/// of lower order.
int point_count(const CellKind& kind);

/// Unknowns of the cell's own. enhanced: 4 in QUAD4, 9 in HEXA8, there 12 in small strain; mean_dilatation: 2
/// in QUAD8, 3 in HEXA20; 0 in all others.
int mode_count(const CellKind& kind);

/// Numbers that a cell remembers: the states of its points, then its own unknowns. They are 0 at first.
int state_size_of_cell(const CellKind& kind, int law_state_size);

/// How far the cell's own unknowns are solved.
struct ModeIteration {
  double relative = 1e-11; ///< forces on the modes by the larger of `force` and the cell's own
  double force = 0;        ///< the largest Result::mode_force of the domain's cells, where it is known
  int most_iterations = 25;
};

struct CellInput {
  std::span<const Eigen::Vector3d> points; ///< of the undeformed cell
  std::span<const double> displacement;    ///< nodes · d
  std::span<const double> old;             ///< state_size_of_cell numbers, at the start of the step
  material::StepInfo step = {};
  ModeIteration modes = {};
  /// What expands freely (α ΔT), one a point; empty: nothing. Taken from the strain of the kind; hyperelastic
  /// laws: xx = yy = zz > −1 without shears, the law sees F/(1 + xx) and stores by undeformed volume.
  std::span<const material::Strain6> free_strain = {};
};

/// Where results go; what is empty is not wanted.
struct CellOutput {
  std::span<double> now;     ///< state_size_of_cell numbers, not the memory of `old`
  std::span<double> force;   ///< nodes · d; never empty
  std::span<double> tangent; ///< square of nodes · d, symmetric (of a law whose tangent is not: its
                             ///< symmetric part)
  std::span<PointRecord> records = {}; ///< one a point
};

struct CellResult {
  Failure failure = Failure::none;
  int point = -1;        ///< where it failed; −1: of the cell
  double stored = 0;     ///< Σ volume · stored
  double hourglass = 0;  ///< stored in hourglasses of a reduced cell [force · length]
  double mode_force = 0; ///< largest Σ w |P| |∂H/∂α|: what forces on modes are compared with

  explicit operator bool() const { return failure == Failure::none; }
};

/// Evaluates a cell. Where it fails, what was written has no meaning. Throws std::invalid_argument for a kind
/// that is not offered.
CellResult evaluate(const CellKind& kind, const PointLaws& laws, const CellInput& input,
                    const CellOutput& output);

/// CellResult::hourglass of a cell with that displacement: 0 of all but reduced cells.
double hourglass_energy(const CellKind& kind, std::span<const Eigen::Vector3d> points,
                        std::span<const double> displacement);

} // namespace rubato::element
