// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/kinematics.hpp"

#include "rubato/fem/reference_cell.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <array>

namespace rubato::contact {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// Shape functions of a face at one reference point.
struct FaceShape {
  std::array<double, 9> values{};
  std::array<double, 18> gradients{};
  int dimension = 2;

  FaceShape(mesh::CellType type, const Vector2d& xi) {
    const auto& cell = fem::reference_cell(type);
    dimension = cell.dimension;
    const Vector3d at(xi[0], xi[1], 0);
    cell.values(at, std::span(values).first(static_cast<std::size_t>(cell.node_count)));
    cell.gradients(at, std::span(gradients).first(static_cast<std::size_t>(cell.node_count * dimension)));
  }
  double value(Eigen::Index node) const { return values[static_cast<std::size_t>(node)]; }
  double gradient(Eigen::Index node, int direction) const {
    return gradients[static_cast<std::size_t>(node * dimension + direction)];
  }
};

/// v / |v| and the matrix that turns dv into its variation.
struct Unit {
  Vector3d direction;
  Matrix3d derivative;

  explicit Unit(const Vector3d& v) {
    const double length = v.norm();
    direction = v / length;
    derivative = (Matrix3d::Identity() - direction * direction.transpose()) / length;
  }
};

Matrix3d cross_matrix(const Vector3d& v) {
  Matrix3d m;
  m << 0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0;
  return m;
}

/// d(a × b) = a × db − b × da
Variation<3> cross_variation(const Vector3d& a, const Variation<3>& da, const Vector3d& b,
                             const Variation<3>& db) {
  return cross_matrix(a) * db - cross_matrix(b) * da;
}

/// Builds one point's kinematics step by step; lives only as long as evaluate_kinematics.
class Evaluation {
public:
  Evaluation(const Zone& zone, const SlavePoint& point, const Pair& pair, const Configuration& configuration)
      : zone_(zone), point_(point), pair_(pair), configuration_(configuration),
        face_(zone.master.faces[static_cast<std::size_t>(pair.master_face)]),
        coordinates_(deformed(face_, configuration)), free_(face_.type, pair.projection.xi),
        clamped_(face_.type, pair.projection.clamped),
        at_free_(face_geometry(face_.type, coordinates_, pair.projection.xi)),
        at_clamped_(face_geometry(face_.type, coordinates_, pair.projection.clamped)) {
    slave_count_ = static_cast<Eigen::Index>(point.nodes.size());
    out_.components = configuration.dofs->components;
    out_.parametric_dimension = parametric_dimension(face_.type);
  }

  Kinematics run() {
    collect_nodes();
    vary_projection();
    build_frame();
    measure_gap();
    measure_slip();
    return std::move(out_);
  }

private:
  Eigen::Index unknowns() const { return out_.unknowns(); }

  /// Adds factor · d(displacement of local node) to the rows of a variation.
  void add_node(Variation<3>& variation, Eigen::Index node, double factor) const {
    for (int i = 0; i < out_.components; ++i)
      variation(i, node * out_.components + i) += factor;
  }

  /// Adds v · d(displacement of local node) to a row.
  template <class Row> void add_node_along(Row&& row, Eigen::Index node, const Vector3d& v) const {
    for (int i = 0; i < out_.components; ++i)
      row[node * out_.components + i] += v[i];
  }

  void collect_nodes() {
    out_.nodes = point_.nodes;
    out_.nodes.insert(out_.nodes.end(), face_.node_span().begin(), face_.node_span().end());
    const auto count = static_cast<Eigen::Index>(out_.nodes.size());
    out_.shape = VectorXd::Zero(count);
    out_.shape_slope = Eigen::Matrix<double, Eigen::Dynamic, 2>::Zero(count, 2);
    for (Eigen::Index i = 0; i < slave_count_; ++i)
      out_.shape[i] = point_.shape[static_cast<std::size_t>(i)];
    for (Eigen::Index j = 0; j < face_.node_count; ++j) {
      out_.shape[slave_count_ + j] = -clamped_.value(j);
      for (int a = 0; a < out_.parametric_dimension; ++a)
        out_.shape_slope(slave_count_ + j, a) = -clamped_.gradient(j, a);
    }
  }

  void vary_projection() {
    const int dimension = out_.parametric_dimension;
    const Vector3d r = position(point_, configuration_) - at_free_.position;
    Variation<2> right = Variation<2>::Zero(2, unknowns());
    for (int a = 0; a < dimension; ++a) {
      const Vector3d t = at_free_.tangents.col(a);
      for (Eigen::Index i = 0; i < slave_count_; ++i)
        add_node_along(right.row(a), i, out_.shape[i] * t);
      for (Eigen::Index j = 0; j < face_.node_count; ++j)
        add_node_along(right.row(a), slave_count_ + j, free_.gradient(j, a) * r - free_.value(j) * t);
    }
    Eigen::Matrix2d slope = Eigen::Matrix2d::Identity();
    for (int a = 0; a < dimension; ++a)
      for (int b = 0; b < dimension; ++b)
        slope(a, b) = at_free_.tangents.col(a).dot(at_free_.tangents.col(b)) -
                      r.dot(at_free_.curvatures[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)]);
    d_free_ = slope.inverse() * right;
    out_.d_projection = pair_.projection.clamp_derivative * d_free_;
  }

  /// d x,_a at a reference point that moves by d_xi.
  Variation<3> vary_tangent(int a, const FaceShape& shape, const FaceGeometry& at,
                            const Variation<2>& d_xi) const {
    Variation<3> variation = Variation<3>::Zero(3, unknowns());
    if (a >= out_.parametric_dimension)
      return variation;
    for (Eigen::Index j = 0; j < face_.node_count; ++j)
      add_node(variation, slave_count_ + j, shape.gradient(j, a));
    for (int b = 0; b < out_.parametric_dimension; ++b)
      variation += at.curvatures[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)] * d_xi.row(b);
    return variation;
  }

  void build_frame() {
    std::array<Vector3d, 2> t;
    std::array<Variation<3>, 2> dt;
    const bool accumulate =
        zone_.settings.clamped_normal == deck::ClampedNormal::code_aster && !pair_.projection.inside();
    for (int a = 0; a < 2; ++a) {
      const auto i = static_cast<std::size_t>(a);
      t[i] = at_clamped_.tangents.col(a);
      dt[i] = vary_tangent(a, clamped_, at_clamped_, out_.d_projection);
      if (accumulate && a < out_.parametric_dimension) {
        t[i] += at_free_.tangents.col(a);
        dt[i] += vary_tangent(a, free_, at_free_, d_free_);
      }
    }
    const Unit first(t[0]);
    const Unit master(t[0].cross(t[1]));
    out_.normal = master.direction;
    out_.d_normal = master.derivative * cross_variation(t[0], dt[0], t[1], dt[1]);
    out_.tangents.col(0) = first.direction;
    out_.d_tangent[0] = first.derivative * dt[0];
    if (zone_.settings.normal != deck::ContactNormal::master)
      turn_to_slave();
    finish_tangents();
  }

  /// Σ over the slave faces at the point of their unit normals, with its variation.
  void slave_normal(Vector3d& sum, Variation<3>& variation) const {
    sum.setZero();
    variation = Variation<3>::Zero(3, unknowns());
    for (const auto& place : point_.stands_on) {
      const auto& face = zone_.slave.faces[static_cast<std::size_t>(place.face)];
      const auto at = face_geometry(face.type, deformed(face, configuration_), place.xi);
      const FaceShape shape(face.type, place.xi);
      std::array<Variation<3>, 2> dt;
      for (int a = 0; a < 2; ++a) {
        auto& variation_of_tangent = dt[static_cast<std::size_t>(a)];
        variation_of_tangent = Variation<3>::Zero(3, unknowns());
        for (int i = 0; a < out_.parametric_dimension && i < face.node_count; ++i)
          add_node(variation_of_tangent, local_slave_node(face.nodes[static_cast<std::size_t>(i)]),
                   shape.gradient(i, a));
      }
      const Unit unit(at.tangents.col(0).cross(at.tangents.col(1)));
      sum += unit.direction;
      variation += unit.derivative * cross_variation(at.tangents.col(0), dt[0], at.tangents.col(1), dt[1]);
    }
  }

  Eigen::Index local_slave_node(mesh::NodeIndex node) const {
    Eigen::Index i = 0;
    while (point_.nodes[static_cast<std::size_t>(i)] != node)
      ++i;
    return i;
  }

  void turn_to_slave() {
    Vector3d sum;
    Variation<3> d_sum;
    slave_normal(sum, d_sum);
    const Unit slave(sum);
    Vector3d direction = -slave.direction;
    Variation<3> d_direction = -slave.derivative * d_sum;
    if (zone_.settings.normal == deck::ContactNormal::average) {
      direction += out_.normal;
      d_direction += out_.d_normal;
    }
    const Unit turned(direction);
    out_.normal = turned.direction;
    out_.d_normal = turned.derivative * d_direction;
    // τ₁ keeps the master's first direction as far as the turned normal allows.
    const Vector3d along = out_.tangents.col(0);
    const double part = along.dot(out_.normal);
    const Variation<1> d_part =
        along.transpose() * out_.d_normal + out_.normal.transpose() * out_.d_tangent[0];
    const Unit first(along - part * out_.normal);
    out_.d_tangent[0] =
        first.derivative * (out_.d_tangent[0] - part * out_.d_normal - out_.normal * d_part).eval();
    out_.tangents.col(0) = first.direction;
  }

  void finish_tangents() {
    const Vector3d t1 = out_.tangents.col(0);
    out_.tangents.col(1) = out_.normal.cross(t1);
    out_.d_tangent[1] = cross_variation(out_.normal, out_.d_normal, t1, out_.d_tangent[0]);
  }

  /// v·d(x_s − x_m(ξ̄)) with ξ̄ held.
  Variation<1> along_shape(const Vector3d& v) const {
    Variation<1> row = Variation<1>::Zero(unknowns());
    for (Eigen::Index i = 0; i < out_.shape.size(); ++i)
      add_node_along(row, i, out_.shape[i] * v);
    return row;
  }

  void measure_gap() {
    const Vector3d apart = position(point_, configuration_) - at_clamped_.position;
    out_.gap = out_.normal.dot(apart);
    out_.d_gap = along_shape(out_.normal) + apart.transpose() * out_.d_normal;
    for (int a = 0; a < out_.parametric_dimension; ++a)
      out_.d_gap -= out_.normal.dot(at_clamped_.tangents.col(a)) * out_.d_projection.row(a);
  }

  void measure_slip() {
    Vector3d moved = Vector3d::Zero();
    Eigen::Matrix<double, 3, 2> moved_slope = Eigen::Matrix<double, 3, 2>::Zero();
    for (Eigen::Index i = 0; i < out_.shape.size(); ++i) {
      const Vector3d increment = configuration_.increment(out_.nodes[static_cast<std::size_t>(i)]);
      moved += out_.shape[i] * increment;
      moved_slope += increment * out_.shape_slope.row(i);
    }
    out_.d_slip = Variation<2>::Zero(2, unknowns());
    for (int a = 0; a < out_.parametric_dimension; ++a) {
      const Vector3d tau = out_.tangents.col(a);
      out_.slip[a] = tau.dot(moved);
      out_.d_slip.row(a) = along_shape(tau) +
                           moved.transpose() * out_.d_tangent[static_cast<std::size_t>(a)] +
                           (tau.transpose() * moved_slope) * out_.d_projection;
    }
  }

  const Zone& zone_;
  const SlavePoint& point_;
  const Pair& pair_;
  const Configuration& configuration_;
  const Face& face_;
  FaceCoordinates coordinates_;
  FaceShape free_;
  FaceShape clamped_;
  FaceGeometry at_free_;
  FaceGeometry at_clamped_;
  Eigen::Index slave_count_ = 0;
  Variation<2> d_free_;
  Kinematics out_;
};

} // namespace

Kinematics evaluate_kinematics(const Zone& zone, const SlavePoint& point, const Pair& pair,
                               const Configuration& configuration) {
  return Evaluation(zone, point, pair, configuration).run();
}

Kinematics with_held_frame(Kinematics k) {
  const auto unknowns = k.unknowns();
  k.d_projection = Variation<2>::Zero(2, unknowns);
  k.d_normal = Variation<3>::Zero(3, unknowns);
  k.d_tangent.fill(Variation<3>::Zero(3, unknowns));
  k.shape_slope.setZero();
  k.d_gap = Variation<1>::Zero(unknowns);
  k.d_slip = Variation<2>::Zero(2, unknowns);
  for (Eigen::Index node = 0; node < k.shape.size(); ++node)
    for (int i = 0; i < k.components; ++i) {
      const auto column = node * k.components + i;
      k.d_gap[column] = k.shape[node] * k.normal[i];
      for (int a = 0; a < k.parametric_dimension; ++a)
        k.d_slip(a, column) = k.shape[node] * k.tangents(i, a);
    }
  return k;
}

Kinematics held_between(const Kinematics& a, const Kinematics& b) {
  Kinematics k = a;
  k.nodes.insert(k.nodes.end(), b.nodes.begin(), b.nodes.end());
  k.shape.resize(a.shape.size() + b.shape.size());
  k.shape << 0.5 * a.shape, 0.5 * b.shape;
  k.shape_slope.resize(k.shape.size(), 2);
  k.normal = (a.normal + b.normal).normalized();
  const Vector3d along = a.tangents.col(0) + b.tangents.col(0);
  k.tangents.col(0) = (along - along.dot(k.normal) * k.normal).normalized();
  k.tangents.col(1) = k.normal.cross(Vector3d(k.tangents.col(0)));
  k.gap = 0.5 * (a.gap + b.gap);
  k.slip = 0.5 * (a.slip + b.slip);
  return with_held_frame(std::move(k));
}

void measure_in_held_frame(Kinematics& k, const Configuration& configuration) {
  Vector3d apart = Vector3d::Zero();
  Vector3d moved = Vector3d::Zero();
  for (std::size_t node = 0; node < k.nodes.size(); ++node) {
    const double shape = k.shape[static_cast<Eigen::Index>(node)];
    apart += shape * configuration.position(k.nodes[node]);
    moved += shape * configuration.increment(k.nodes[node]);
  }
  k.gap = k.normal.dot(apart);
  for (int a = 0; a < k.parametric_dimension; ++a)
    k.slip[a] = k.tangents.col(a).dot(moved);
}

} // namespace rubato::contact
