// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/model/neutral_motions.hpp"

#include "rubato/contact/small_vectors.hpp"
#include "rubato/linalg/dense_decompositions.hpp"
#include "rubato/linalg/dense_products.hpp"
#include "rubato/load/follower_pressure.hpp"
#include "rubato/model/model.hpp"
#include "rubato/model/surface_normals.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace rubato::model {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// ν·r against n·r, root mean squares: what averages leave on a surface that is carried into itself.
constexpr double carried_into_itself = 0.15;
/// Means of n·r over faces against n·r likewise. They vanish on segments between places of a circle and are
/// parts of n·r on triangles between places of a sphere: nodes in the middle of flat sides have them.
constexpr double one_sided = 0.65;
/// n·r against |r|, root mean squares: of a circle of ten cells. Corners of a box have more.
constexpr double coarsest = 0.34;
/// Facets that resist by less do not: such motions contact leaves alone.
constexpr double not_resisted = 1e-6;
/// Corners on the rim of a surface, whose normals are averaged on one side only, are left out where the
/// others have this part of it at least.
constexpr double enough = 0.5;
/// What the work of a load on a motion may be, in parts of the square of n·r against |r|: the mass of facets
/// is off its place by that order.
constexpr double off_its_place = 0.3;

/// How a place moves in each of some motions, a column each.
MatrixXd moves_of(const RigidMotions& rigid, std::span<const RigidMotion> motions, const Vector3d& place) {
  MatrixXd moves(3, static_cast<Index>(motions.size()));
  for (std::size_t k = 0; k < motions.size(); ++k)
    contact::set_column(static_cast<Index>(k), rigid.at(motions[k], place), moves);
  return moves;
}

/// nᵀ moves
VectorXd along_of(const Vector3d& normal, const MatrixXd& moves) {
  VectorXd along(moves.cols());
  for (Index k = 0; k < along.size(); ++k)
    along[k] = normal[0] * moves(0, k) + normal[1] * moves(1, k) + normal[2] * moves(2, k);
  return along;
}

/// a + factor · b
MatrixXd sum_of(const MatrixXd& a, double factor, const MatrixXd& b) {
  MatrixXd sum = a;
  for (Index k = 0; k < sum.size(); ++k)
    sum.data()[k] += factor * b.data()[k];
  return sum;
}

/// Mean squares over a body's contact surfaces, as forms of its loose motions.
struct Forms {
  MatrixXd averaged;  ///< (ν·r)²
  MatrixXd one_sided; ///< the square of the mean of n·r over a face
  MatrixXd faceted;   ///< (n·r)²
  MatrixXd moved;     ///< |r|²
};

class SurfaceForms {
public:
  SurfaceForms(const Model& model, const RigidMotions& rigid, std::span<const RigidMotion> motions)
      : model_(model), rigid_(rigid), motions_(motions) {
    const auto count = static_cast<Index>(motions.size());
    const MatrixXd zero = MatrixXd::Zero(count, count);
    forms_ = {zero, zero, zero, zero};
  }

  void add(const contact::Surface& surface) {
    auto corners = face_corners(model_.mesh, surface);
    const auto averages = averaged_normals(surface, corners);
    std::erase_if(corners, [&](const auto& corner) { return !is_ours(surface, corner); });
    add_faces(surface, corners);
    leave_rim_out(surface, corners);
    for (const auto& corner : corners)
      add_corner(surface, corner, averages[static_cast<std::size_t>(corner.position)]);
  }

  const Forms& forms() const { return forms_; }

private:
  bool is_ours(const contact::Surface& surface, const FaceCorner& corner) const {
    const auto index = surface.nodes[static_cast<std::size_t>(corner.position)];
    return rigid_.bodies().of(index) == motions_.front().body;
  }

  MatrixXd moves_at(const contact::Surface& surface, const FaceCorner& corner) const {
    const auto index = surface.nodes[static_cast<std::size_t>(corner.position)];
    return moves_of(rigid_, motions_, model_.mesh.points[static_cast<std::size_t>(index)]);
  }

  static void leave_rim_out(const contact::Surface& surface, std::vector<FaceCorner>& corners) {
    const auto rim = rim_of(surface);
    double all = 0;
    double inside = 0;
    for (const auto& corner : corners) {
      all += corner.area;
      inside += rim[static_cast<std::size_t>(corner.position)] != 0 ? 0 : corner.area;
    }
    if (inside >= enough * all)
      std::erase_if(corners,
                    [&](const auto& corner) { return rim[static_cast<std::size_t>(corner.position)] != 0; });
  }

  void add_faces(const contact::Surface& surface, std::span<const FaceCorner> corners) {
    for (std::size_t i = 0; i < corners.size();) {
      const int face = corners[i].face;
      VectorXd flow = VectorXd::Zero(forms_.moved.cols());
      double area = 0;
      for (; i < corners.size() && corners[i].face == face; ++i) {
        const auto along = along_of(corners[i].normal, moves_at(surface, corners[i]));
        for (Index k = 0; k < flow.size(); ++k)
          flow[k] += corners[i].area * along[k];
        area += corners[i].area;
      }
      linalg::add_square(1 / area, flow, forms_.one_sided);
    }
  }

  void add_corner(const contact::Surface& surface, const FaceCorner& corner, const Vector3d& average) {
    const MatrixXd moves = moves_at(surface, corner);
    linalg::add_square(corner.area, along_of(average, moves), forms_.averaged);
    linalg::add_square(corner.area, along_of(corner.normal, moves), forms_.faceted);
    for (Index j = 0; j < moves.cols(); ++j)
      for (Index i = 0; i < moves.cols(); ++i)
        forms_.moved(i, j) +=
            corner.area * (moves(0, i) * moves(0, j) + moves(1, i) * moves(1, j) + moves(2, i) * moves(2, j));
  }

  const Model& model_;
  const RigidMotions& rigid_;
  std::span<const RigidMotion> motions_;
  Forms forms_;
};

/// Of the vectors in a subspace, which columns span, those with low ≤ v·A v/v·B v ≤ high: columns that span
/// them, with v·B v = 1.
MatrixXd with_quotient(const MatrixXd& a, const MatrixXd& b, const MatrixXd& subspace, double low,
                       double high) {
  if (subspace.cols() == 0)
    return subspace;
  const auto within = [&](const MatrixXd& form) {
    return linalg::product(linalg::transposed_product(subspace, form), subspace);
  };
  const auto [values, vectors] = linalg::generalized_eigen(within(a), within(b));
  std::vector<Index> chosen;
  for (Index i = 0; i < values.size(); ++i)
    if (values[i] >= low && values[i] <= high)
      chosen.push_back(i);
  MatrixXd wanted(vectors.rows(), static_cast<Index>(chosen.size()));
  for (std::size_t k = 0; k < chosen.size(); ++k)
    std::copy_n(&vectors(0, chosen[k]), vectors.rows(),
                wanted.data() + static_cast<Index>(k) * wanted.rows());
  return linalg::product(subspace, wanted);
}

constexpr double square(double value) {
  return value * value;
}

/// A surface on one line or at one place doesn't tell motions apart.
bool tells_motions_apart(const MatrixXd& moved) {
  const auto values = linalg::symmetric_eigenvalues(moved);
  return values[0] > square(not_resisted) * values[values.size() - 1];
}

/// Coefficients of the motions that facets alone resist, a column each.
MatrixXd resisted_by_facets(const Forms& forms) {
  const auto count = forms.moved.cols();
  if (!tells_motions_apart(forms.moved))
    return MatrixXd(count, 0);
  const double part = square(carried_into_itself);
  const MatrixXd along = sum_of(forms.averaged, part / square(one_sided), forms.one_sided);
  const MatrixXd allowed = sum_of(forms.faceted, square(square(not_resisted)), forms.moved);
  const MatrixXd smooth = with_quotient(along, allowed, MatrixXd::Identity(count, count), -part, part);
  return with_quotient(forms.faceted, forms.moved, smooth, square(not_resisted), square(coarsest));
}

/// The work of a load on each motion, and the most that it could be.
struct Work {
  VectorXd done;
  double most = 0;
};

Work work_of(const Model& model, const RigidMotions& rigid, std::span<const RigidMotion> motions,
             const MatrixXd& coefficients, const VectorXd& force) {
  Work work{VectorXd::Zero(coefficients.cols()), 0};
  const int components = model.dofs.components;
  for (const auto node : model.dofs.nodes) {
    if (rigid.bodies().of(node) != motions.front().body)
      continue;
    Vector3d push = Vector3d::Zero();
    for (int a = 0; a < components; ++a)
      push[a] = force[model.dofs.dof(node, 0) + a];
    const auto moves = linalg::product(
        moves_of(rigid, motions, model.mesh.points[static_cast<std::size_t>(node)]), coefficients);
    const auto done = along_of(push, moves);
    double moved = 0;
    for (Index k = 0; k < moves.size(); ++k)
      moved += moves.data()[k] * moves.data()[k];
    for (Index k = 0; k < done.size(); ++k)
      work.done[k] += done[k];
    work.most += contact::length_of(push) * std::sqrt(moved);
  }
  return work;
}

/// Parts of a run at whose ends a load that changes otherwise than by a factor is looked at.
constexpr int looks = 8;

/// What the loads push with, each a pattern whose size does not matter.
std::vector<VectorXd> load_patterns(const Model& model) {
  std::vector<VectorXd> patterns;
  const VectorXd none = VectorXd::Zero(model.dofs.dof_count);
  const auto& time = model.study.time;
  const auto look = [&](const auto& add) {
    for (int i = 0; i <= looks; ++i)
      add(time.begin + i * (time.end - time.begin) / looks, patterns.emplace_back(none));
  };
  for (const auto& force : model.forces) {
    patterns.push_back(force.pattern);
    for (const auto& field : force.fields)
      look([&](double t, VectorXd& pattern) { load::add_field_force(field, t, pattern); });
  }
  for (const auto& follower : model.followers)
    look([&](double t, VectorXd& pattern) { load::add_follower_force(follower, none, t, pattern); });
  return patterns;
}

/// Leaves out what loads work on: they move such a body without end, or until it hangs below its support.
MatrixXd without_work(const Model& model, const RigidMotions& rigid, std::span<const RigidMotion> motions,
                      const MatrixXd& faceted, MatrixXd coefficients) {
  for (const auto& pattern : load_patterns(model)) {
    if (coefficients.cols() == 0)
      return coefficients;
    const auto [done, most] = work_of(model, rigid, motions, coefficients, pattern);
    const auto forms = linalg::product(linalg::transposed_product(coefficients, faceted), coefficients);
    double facets = forms(0, 0);
    for (Index k = 1; k < forms.cols(); ++k)
      facets = std::max(facets, forms(k, k));
    if (done.norm() <= off_its_place * facets * most)
      continue;
    const MatrixXd directions = linalg::orthogonal_factor(done);
    MatrixXd others(directions.rows(), coefficients.cols() - 1);
    std::copy_n(directions.data() + directions.size() - others.size(), others.size(), others.data());
    coefficients = linalg::product(coefficients, others);
  }
  return coefficients;
}

/// What the soft springs of a body do when it moves, as a form of two motions [force/length].
double spring_form(const Model& model, const RigidMotions& rigid, const RigidMotion& a,
                   const RigidMotion& b) {
  double sum = 0;
  for (const auto& spring : model.springs) {
    const auto node = model.dofs.nodes[static_cast<std::size_t>(spring.dof / model.dofs.components)];
    if (rigid.bodies().of(node) != a.body)
      continue;
    const auto& place = model.mesh.points[static_cast<std::size_t>(node)];
    const int axis = spring.dof % model.dofs.components;
    sum += spring.stiffness * rigid.at(a, place)[axis] * rigid.at(b, place)[axis];
  }
  return sum;
}

/// Whether springs pull a body along a motion when it is shifted: where they do, its place there is theirs to
/// say.
bool is_pulled_when_shifted(const Model& model, const RigidMotions& rigid, const RigidMotion& motion) {
  const double along = spring_form(model, rigid, motion, motion);
  for (int axis = 0; axis < model.dofs.components; ++axis) {
    RigidMotion shift{.body = motion.body};
    shift.shift[axis] = 1;
    const double across = spring_form(model, rigid, shift, shift);
    const double both = spring_form(model, rigid, motion, shift);
    if (both * both > square(off_its_place) * along * across && contact::length_of(motion.turn) > 0)
      return true;
  }
  return false;
}

RigidMotion combined(std::span<const RigidMotion> motions, const double* coefficients) {
  RigidMotion sum{.body = motions.front().body};
  for (std::size_t k = 0; k < motions.size(); ++k) {
    contact::add_scaled(coefficients[k], motions[k].shift, sum.shift);
    contact::add_scaled(coefficients[k], motions[k].turn, sum.turn);
  }
  return sum;
}

bool touches(const RigidMotions& rigid, int body, const contact::Surface& surface) {
  return std::ranges::any_of(surface.nodes, [&](auto node) { return rigid.bodies().of(node) == body; });
}

/// The contact surfaces of a body; none when one of them has friction.
std::vector<const contact::Surface*> smooth_surfaces(const Model& model, const RigidMotions& rigid,
                                                     int body) {
  std::vector<const contact::Surface*> surfaces;
  for (const auto& zone : model.zones)
    for (const auto* surface : {&zone.master, &zone.slave}) {
      if (!touches(rigid, body, *surface))
        continue;
      if (zone.settings.friction > 0)
        return {};
      surfaces.push_back(surface);
    }
  return surfaces;
}

/// Of one body.
std::vector<RigidMotion> neutral_of(const Model& model, const RigidMotions& rigid,
                                    std::span<const RigidMotion> motions) {
  const auto surfaces = smooth_surfaces(model, rigid, motions.front().body);
  if (surfaces.empty())
    return {};
  SurfaceForms sum(model, rigid, motions);
  for (const auto* surface : surfaces)
    sum.add(*surface);
  const auto& forms = sum.forms();
  const MatrixXd found = without_work(model, rigid, motions, forms.faceted, resisted_by_facets(forms));
  std::vector<RigidMotion> neutral;
  for (Index k = 0; k < found.cols(); ++k)
    neutral.push_back(combined(motions, &found(0, k)));
  auto apart = rigid.told_apart(neutral);
  std::erase_if(apart, [&](const auto& motion) { return is_pulled_when_shifted(model, rigid, motion); });
  return apart;
}

} // namespace

std::vector<RigidMotion> neutral_motions(const Model& model, const RigidMotions& rigid) {
  std::vector<RigidMotion> neutral;
  if (model.study.physics == study::Physics::axisymmetric)
    return neutral;
  const auto loose = rigid.loose_alone();
  for (std::size_t first = 0; first < loose.size();) {
    const auto next =
        std::ranges::find_if(loose.begin() + static_cast<std::ptrdiff_t>(first), loose.end(),
                             [&](const auto& motion) { return motion.body != loose[first].body; });
    const auto last = static_cast<std::size_t>(next - loose.begin());
    std::ranges::move(neutral_of(model, rigid, std::span(loose).subspan(first, last - first)),
                      std::back_inserter(neutral));
    first = last;
  }
  return neutral;
}

} // namespace rubato::model
