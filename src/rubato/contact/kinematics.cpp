// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/kinematics.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <array>

namespace rubato::contact {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;

/// v / |v| and the matrix that turns dv into its variation.
struct Unit {
  Vector3d direction;
  Matrix3d derivative;

  explicit Unit(const Vector3d& v) {
    const double inverse_length = 1 / v.norm();
    direction = inverse_length * v;
    derivative = inverse_length * (Matrix3d::Identity() - direction * direction.transpose());
  }
};

/// v ↦ a × v
Matrix3d cross_matrix(const Vector3d& a) {
  Matrix3d m;
  m << 0, -a[2], a[1], a[2], 0, -a[0], -a[1], a[0], 0;
  return m;
}

/// A face at a reference point.
struct PlaceOnFace {
  FaceShape shape;
  FaceGeometry at;

  PlaceOnFace(const Face& face, const FaceCoordinates& coordinates, const Eigen::Vector2d& xi)
      : shape(face_shape(face.type, xi)), at(face_geometry(face.type, coordinates, shape)) {}
};

/// Builds one point's kinematics step by step; lives only as long as evaluate_kinematics.
///
/// Derivatives are taken with respect to the point's few motions first (see the header), which stand in this
/// order, `components` columns each: r, m_a of the clamped place, those of the free place unless it is the
/// same (Inside), δn_s when the slave turns the normal (Turned).
template <int Dimension, bool Inside, bool Turned> class Evaluation {
public:
  Evaluation(const Zone& zone, const SlavePoint& point, const Pair& pair, const Configuration& configuration,
             Kinematics& out)
      : zone_(zone), point_(point), projection_(pair.projection), configuration_(configuration),
        face_(zone.master.faces[static_cast<std::size_t>(pair.master_face)]), out_(out),
        coordinates_(deformed(face_, configuration)), clamped_(face_, coordinates_, projection_.clamped),
        slave_position_(position(point, configuration)),
        slave_count_(static_cast<Index>(point.nodes.size())) {}

  void run() {
    collect_nodes();
    if constexpr (Inside) {
      vary_projection(clamped_);
      vary_frame();
    } else {
      const PlaceOnFace free(face_, coordinates_, projection_.xi);
      collect_free_weights(free.shape);
      vary_projection(free);
      if (zone_.settings.clamped_normal == deck::ClampedNormal::code_aster)
        vary_frame(free);
      else
        vary_frame();
    }
    measure_gap();
    measure_slip();
    expand(d_projection_, out_.d_projection);
    expand(d_normal_, out_.d_normal);
    expand(d_tangent_[0], out_.d_tangent[0]);
    expand(d_tangent_[1], out_.d_tangent[1]);
  }

private:
  static constexpr int components = Dimension + 1;
  static constexpr int place_columns = (1 + Dimension) * components;
  static constexpr int free_start = Inside ? 0 : place_columns;
  static constexpr int turning_start = free_start + place_columns;
  static constexpr int columns = turning_start + (Turned ? components : 0);
  template <int Rows> using Local = Eigen::Matrix<double, Rows, columns>;

  /// The components of a motion among the columns: 0 is r, 1 + a is m_a.
  template <class Matrix> static auto motion(Matrix&& matrix, int start, int which) {
    return matrix.template middleCols<components>(start + which * components);
  }
  static auto in_space(const Vector3d& v) { return v.head<components>().transpose(); }

  void collect_nodes() {
    out_.components = components;
    out_.parametric_dimension = Dimension;
    out_.nodes.assign(point_.nodes.begin(), point_.nodes.end());
    out_.nodes.insert(out_.nodes.end(), face_.node_span().begin(), face_.node_span().end());
    const auto count = static_cast<Index>(out_.nodes.size());
    out_.shape.resize(count);
    out_.shape_slope.setZero(count, 2);
    for (Index i = 0; i < slave_count_; ++i)
      out_.shape[i] = point_.shape[static_cast<std::size_t>(i)];
    for (Index j = 0; j < face_.node_count; ++j) {
      const auto node = static_cast<std::size_t>(j);
      out_.shape[slave_count_ + j] = -clamped_.shape.values[node];
      for (int a = 0; a < Dimension; ++a)
        out_.shape_slope(slave_count_ + j, a) = -gradient(clamped_.shape, j, a);
    }
  }

  static double gradient(const FaceShape& shape, Index node, int direction) {
    return shape.gradients[static_cast<std::size_t>(node * Dimension + direction)];
  }

  void collect_free_weights(const FaceShape& shape) {
    for (Index j = 0; j < face_.node_count; ++j) {
      free_weights_(0, j) = -shape.values[static_cast<std::size_t>(j)];
      for (int a = 0; a < Dimension; ++a)
        free_weights_(1 + a, j) = gradient(shape, j, a);
    }
  }

  void vary_projection(const PlaceOnFace& free) {
    const Vector3d r = slave_position_ - free.at.position;
    Eigen::Matrix<double, Dimension, columns> right = Eigen::Matrix<double, Dimension, columns>::Zero();
    Eigen::Matrix<double, Dimension, Dimension> slope;
    for (int a = 0; a < Dimension; ++a) {
      const Vector3d t = free.at.tangents.col(a);
      motion(right.row(a), free_start, 0) = in_space(t);
      motion(right.row(a), free_start, 1 + a) = in_space(r);
      for (int b = 0; b < Dimension; ++b)
        slope(a, b) = t.dot(free.at.tangents.col(b)) - r.dot(curvature(free, a, b));
    }
    d_free_.setZero();
    d_free_.template topRows<Dimension>() = slope.inverse() * right;
    if constexpr (Inside)
      d_projection_ = d_free_;
    else
      d_projection_ = projection_.clamp_derivative * d_free_;
  }

  static const Vector3d& curvature(const PlaceOnFace& place, int a, int b) {
    return place.at.curvatures[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)];
  }

  /// Adds d x,_a at a reference point that moves by d_xi.
  void add_tangent(int a, const PlaceOnFace& place, int start, const Local<2>& d_xi, Local<3>& sum) const {
    motion(sum, start, 1 + a).template topRows<components>().diagonal().array() += 1;
    for (int b = 0; b < Dimension; ++b)
      sum += curvature(place, a, b) * d_xi.row(b);
  }

  /// The frame at the clamped place or, with Code_Aster, at the sum of both places' tangents.
  template <class... Free> void vary_frame(const Free&... free) {
    Eigen::Matrix<double, 3, 2> t = clamped_.at.tangents;
    std::array<Local<3>, Dimension> dt;
    for (int a = 0; a < Dimension; ++a) {
      auto& variation = dt[static_cast<std::size_t>(a)];
      variation.setZero();
      add_tangent(a, clamped_, 0, d_projection_, variation);
      (add_tangent(a, free, free_start, d_free_, variation), ...);
      ((t.col(a) += free.at.tangents.col(a)), ...);
    }
    const Vector3d t1 = t.col(0);
    const Vector3d t2 = t.col(1);
    const Unit first(t1);
    const Unit master(t1.cross(t2));
    out_.normal = master.direction;
    d_normal_ = -(master.derivative * cross_matrix(t2)) * dt[0];
    if constexpr (Dimension == 2)
      d_normal_ += (master.derivative * cross_matrix(t1)) * dt[1];
    out_.tangents.col(0) = first.direction;
    d_tangent_[0] = first.derivative * dt[0];
    if constexpr (Turned)
      turn_to_slave();
    finish_tangents();
  }

  /// n_s, the unit of the sum over the slave faces at the point of their unit normals; fills its variation.
  Vector3d slave_normal() {
    Vector3d sum = Vector3d::Zero();
    auto& variation = out_.d_slave_normal;
    variation.setZero(3, slave_count_ * components);
    for (const auto& on : point_.stands_on) {
      const auto& face = zone_.slave.faces[static_cast<std::size_t>(on.face)];
      const PlaceOnFace place(face, deformed(face, configuration_), on.xi);
      const Vector3d t1 = place.at.tangents.col(0);
      const Vector3d t2 = place.at.tangents.col(1);
      const Unit unit(t1.cross(t2));
      sum += unit.direction;
      const Matrix3d by_first = -(unit.derivative * cross_matrix(t2));
      const Matrix3d by_second = unit.derivative * cross_matrix(t1);
      for (Index i = 0; i < face.node_count; ++i) {
        auto block = variation.template middleCols<components>(
            components * local_slave_node(face.nodes[static_cast<std::size_t>(i)]));
        block += gradient(place.shape, i, 0) * by_first.leftCols<components>();
        if constexpr (Dimension == 2)
          block += gradient(place.shape, i, 1) * by_second;
      }
    }
    const Unit slave(sum);
    for (Index i = 0; i < slave_count_; ++i) {
      auto block = variation.template middleCols<components>(i * components);
      block = (slave.derivative * block).eval();
    }
    return slave.direction;
  }

  Index local_slave_node(mesh::NodeIndex node) const {
    Index i = 0;
    while (point_.nodes[static_cast<std::size_t>(i)] != node)
      ++i;
    return i;
  }

  void turn_to_slave() {
    Vector3d direction = -slave_normal();
    Local<3> d_direction = Local<3>::Zero();
    motion(d_direction, turning_start, 0).template topRows<components>().diagonal().setConstant(-1);
    if (zone_.settings.normal == deck::ContactNormal::average) {
      direction += out_.normal;
      d_direction += d_normal_;
    }
    const Unit turned(direction);
    out_.normal = turned.direction;
    d_normal_ = turned.derivative * d_direction;
    // τ₁ keeps the master's first direction as far as the turned normal allows.
    const Vector3d along = out_.tangents.col(0);
    const double part = along.dot(out_.normal);
    const Local<1> d_part = along.transpose() * d_normal_ + out_.normal.transpose() * d_tangent_[0];
    const Unit first(along - part * out_.normal);
    d_tangent_[0] = first.derivative * (d_tangent_[0] - part * d_normal_ - out_.normal * d_part).eval();
    out_.tangents.col(0) = first.direction;
  }

  void finish_tangents() {
    const Vector3d t1 = out_.tangents.col(0);
    out_.tangents.col(1) = out_.normal.cross(t1);
    d_tangent_[1] = cross_matrix(out_.normal) * d_tangent_[0] - cross_matrix(t1) * d_normal_;
  }

  void measure_gap() {
    const Vector3d apart = slave_position_ - clamped_.at.position;
    out_.gap = out_.normal.dot(apart);
    Local<1> d_gap = apart.transpose() * d_normal_;
    motion(d_gap, 0, 0) += in_space(out_.normal);
    for (int a = 0; a < Dimension; ++a)
      d_gap -= out_.normal.dot(clamped_.at.tangents.col(a)) * d_projection_.row(a);
    expand(d_gap, out_.d_gap);
  }

  void measure_slip() {
    Vector3d moved = Vector3d::Zero();
    Eigen::Matrix<double, 3, 2> moved_slope = Eigen::Matrix<double, 3, 2>::Zero();
    for (Index i = 0; i < out_.shape.size(); ++i) {
      const Vector3d increment = configuration_.increment(out_.nodes[static_cast<std::size_t>(i)]);
      moved += out_.shape[i] * increment;
      moved_slope += increment * out_.shape_slope.row(i);
    }
    out_.slip.setZero();
    Local<2> d_slip = Local<2>::Zero();
    for (int a = 0; a < Dimension; ++a) {
      const Vector3d tau = out_.tangents.col(a);
      out_.slip[a] = tau.dot(moved);
      d_slip.row(a) = moved.transpose() * d_tangent_[static_cast<std::size_t>(a)] +
                      (tau.transpose() * moved_slope) * d_projection_;
      motion(d_slip.row(a), 0, 0) += in_space(tau);
    }
    expand(d_slip, out_.d_slip);
  }

  /// Derivatives by the motions → derivatives by q.
  template <int Rows> void expand(const Local<Rows>& by_motions, Variation<Rows>& by_q) const {
    using Block = Eigen::Matrix<double, Rows, components>;
    by_q.resize(Rows, out_.unknowns());
    Block by_approach = motion(by_motions, 0, 0);
    if constexpr (!Inside)
      by_approach += motion(by_motions, free_start, 0);
    for (Index i = 0; i < slave_count_; ++i) {
      auto block = motion(by_q, 0, static_cast<int>(i));
      block = out_.shape[i] * by_approach;
      if constexpr (Turned)
        block += motion(by_motions, turning_start, 0) *
                 motion(out_.d_slave_normal, 0, static_cast<int>(i)).template topRows<components>();
    }
    for (Index j = 0; j < face_.node_count; ++j) {
      const Index node = slave_count_ + j;
      Block block = out_.shape[node] * motion(by_motions, 0, 0);
      for (int a = 0; a < Dimension; ++a)
        block -= out_.shape_slope(node, a) * motion(by_motions, 0, 1 + a);
      if constexpr (!Inside)
        for (int k = 0; k <= Dimension; ++k)
          block += free_weights_(k, j) * motion(by_motions, free_start, k);
      motion(by_q, 0, static_cast<int>(node)) = block;
    }
  }

  const Zone& zone_;
  const SlavePoint& point_;
  const Projection& projection_;
  const Configuration& configuration_;
  const Face& face_;
  Kinematics& out_;
  FaceCoordinates coordinates_;
  PlaceOnFace clamped_;
  Vector3d slave_position_;
  Index slave_count_;
  /// What a master node's displacement is multiplied with in the free place's motions, one a row.
  Eigen::Matrix<double, 1 + Dimension, 9> free_weights_;
  Local<2> d_free_;
  Local<2> d_projection_;
  Local<3> d_normal_;
  std::array<Local<3>, 2> d_tangent_;
};

template <int Dimension, bool Inside>
void evaluate_turned(const Zone& zone, const SlavePoint& point, const Pair& pair,
                     const Configuration& configuration, Kinematics& into) {
  if (zone.settings.normal == deck::ContactNormal::master)
    Evaluation<Dimension, Inside, false>(zone, point, pair, configuration, into).run();
  else
    Evaluation<Dimension, Inside, true>(zone, point, pair, configuration, into).run();
}

template <int Dimension>
void evaluate_clamped(const Zone& zone, const SlavePoint& point, const Pair& pair,
                      const Configuration& configuration, Kinematics& into) {
  if (pair.projection.inside())
    evaluate_turned<Dimension, true>(zone, point, pair, configuration, into);
  else
    evaluate_turned<Dimension, false>(zone, point, pair, configuration, into);
}

} // namespace

Kinematics evaluate_kinematics(const Zone& zone, const SlavePoint& point, const Pair& pair,
                               const Configuration& configuration) {
  Kinematics kinematics;
  evaluate_kinematics(zone, point, pair, configuration, kinematics);
  return kinematics;
}

void evaluate_kinematics(const Zone& zone, const SlavePoint& point, const Pair& pair,
                         const Configuration& configuration, Kinematics& into) {
  if (configuration.dofs->components == 2)
    evaluate_clamped<1>(zone, point, pair, configuration, into);
  else
    evaluate_clamped<2>(zone, point, pair, configuration, into);
}

Kinematics with_held_frame(Kinematics k) {
  const auto unknowns = k.unknowns();
  k.d_projection.setZero(2, unknowns);
  k.d_normal.setZero(3, unknowns);
  for (auto& variation : k.d_tangent)
    variation.setZero(3, unknowns);
  k.d_slave_normal.resize(3, 0);
  k.shape_slope.setZero();
  k.d_gap.resize(unknowns);
  k.d_slip.setZero(2, unknowns);
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
