// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/kinematics.hpp"

#include "rubato/contact/obstacle_kinematics.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <optional>

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
/// order, `components` columns each: e, m_a of the clamped place, those of the free place unless it is the
/// same (Inside), δn_s when the slave turns the normal (Turned).
template <int Dimension, bool Inside, bool Turned> class Evaluation {
public:
  Evaluation(const Zone& zone, const SlavePoint& point, const Pair& pair, const Configuration& configuration,
             Kinematics& out)
      : zone_(zone), point_(point), projection_(pair.projection), configuration_(configuration),
        face_(zone.master.faces[static_cast<std::size_t>(pair.master_face)]), out_(out),
        coordinates_(deformed(face_, configuration)),
        clamped_(face_geometry(face_.type, coordinates_, projection_.clamped)),
        slave_position_(position(point, configuration)),
        slave_count_(static_cast<Index>(point.nodes.size())) {
    if (!adds_free_tangents())
      return;
    free_ = face_geometry(face_.type, coordinates_, projection_.xi);
    added_tangents_ = clamped_.tangents + free_->tangents;
  }

  /// All but derivatives.
  void measure() {
    collect_nodes();
    set_master_frame();
    if constexpr (Turned)
      set_turned_frame(slave_normal());
    measure_gap();
    measure_slip();
  }

  /// Derivatives of what has been measured.
  void differentiate() {
    collect_slopes();
    if constexpr (!Inside) {
      if (!free_)
        free_ = face_geometry(face_.type, coordinates_, projection_.xi);
      collect_free_weights();
    }
    vary_projection();
    set_master_frame();
    vary_frame();
    if constexpr (Turned)
      turn_to_slave();
    vary_gap();
    vary_slip();
    expand();
  }

private:
  static constexpr int components = Dimension + 1;
  static constexpr int place_columns = (1 + Dimension) * components;
  static constexpr int free_start = Inside ? 0 : place_columns;
  static constexpr int turning_start = free_start + place_columns;
  static constexpr int columns = turning_start + (Turned ? components : 0);
  template <int Rows> using Local = Eigen::Matrix<double, Rows, columns>;
  /// Rows of what all derivatives are made of.
  enum Row : int { xi1, xi2, alpha, beta, gamma, row_count };

  /// The components of a motion among the columns: 0 is e, 1 + a is m_a.
  template <class Matrix> static auto motion(Matrix&& matrix, int start, int which) {
    return matrix.template middleCols<components>(start + which * components);
  }
  static auto in_space(const Vector3d& v) { return v.head<components>().transpose(); }

  void collect_nodes() {
    out_.stencil.components = components;
    out_.parametric_dimension = Dimension;
    const auto count = slave_count_ + face_.node_count;
    out_.stencil.nodes.resize(static_cast<std::size_t>(count));
    std::ranges::copy(face_.node_span(), std::ranges::copy(point_.nodes, out_.stencil.nodes.begin()).out);
    out_.stencil.weights.resize(count);
    for (Index i = 0; i < slave_count_; ++i)
      out_.stencil.weights[i] = point_.shape[static_cast<std::size_t>(i)];
    const auto values = face_values(face_.type, projection_.clamped);
    for (Index j = 0; j < face_.node_count; ++j)
      out_.stencil.weights[slave_count_ + j] = -values[static_cast<std::size_t>(j)];
  }

  void collect_slopes() {
    const auto shape = face_shape(face_.type, projection_.clamped);
    out_.shape_slope.setZero(out_.stencil.weights.size(), 2);
    for (Index j = 0; j < face_.node_count; ++j)
      for (int a = 0; a < Dimension; ++a)
        out_.shape_slope(slave_count_ + j, a) = -gradient(shape, j, a);
  }

  static double gradient(const FaceShape& shape, Index node, int direction) {
    return shape.gradients[static_cast<std::size_t>(node * Dimension + direction)];
  }

  void collect_free_weights() {
    const auto shape = face_shape(face_.type, projection_.xi);
    for (Index j = 0; j < face_.node_count; ++j) {
      free_weights_(0, j) = -shape.values[static_cast<std::size_t>(j)];
      for (int a = 0; a < Dimension; ++a)
        free_weights_(1 + a, j) = gradient(shape, j, a);
    }
  }

  /// dξ̄, and dξ where it differs.
  void vary_projection() {
    const auto& place = free();
    const Vector3d r = slave_position_ - place.position;
    Eigen::Matrix<double, Dimension, columns> right = Eigen::Matrix<double, Dimension, columns>::Zero();
    Eigen::Matrix<double, Dimension, Dimension> slope;
    for (int a = 0; a < Dimension; ++a) {
      const Vector3d t = place.tangents.col(a);
      motion(right.row(a), free_start, 0) = in_space(t);
      motion(right.row(a), free_start, 1 + a) = in_space(r);
      for (int b = 0; b < Dimension; ++b)
        slope(a, b) = t.dot(place.tangents.col(b)) - r.dot(curvature(place, a, b));
    }
    d_free_.setZero();
    d_free_.template topRows<Dimension>() = slope.inverse() * right;
    if constexpr (Inside)
      rows_.template topRows<2>() = d_free_;
    else
      rows_.template topRows<2>() = projection_.clamp_derivative * d_free_;
  }

  static const Vector3d& curvature(const FaceGeometry& place, int a, int b) {
    return place.curvatures[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)];
  }

  /// Adds v · d x,_a at a reference point that moves by d_xi.
  template <class Rows>
  static void add_tangent(const Vector3d& v, int a, const FaceGeometry& place, int start, const Rows& d_xi,
                          Local<1>& sum) {
    motion(sum, start, 1 + a) += in_space(v);
    for (int b = 0; b < Dimension; ++b)
      sum += v.dot(curvature(place, a, b)) * d_xi.row(b);
  }

  /// The frame at the clamped place or, with Code_Aster, at the sum of both places' tangents t_a.
  void set_master_frame() {
    const auto& t = directions();
    set_frame(t.col(0).cross(t.col(1)).normalized(), t.col(0).normalized());
  }

  const Eigen::Matrix<double, 3, 2>& directions() const {
    return adds_free_tangents() ? added_tangents_ : clamped_.tangents;
  }
  bool adds_free_tangents() const {
    return !Inside && zone_.settings.clamped_normal == study::ClampedNormal::code_aster;
  }

  /// How that frame turns follows from n·dt_a = −t_a·dn and τ₂·dt₁ = |t₁| τ₂·dτ₁.
  void vary_frame() {
    const auto& t = directions();
    const auto along_tangent = [&](const Vector3d& v, int a) {
      Local<1> sum = Local<1>::Zero();
      add_tangent(v, a, clamped_, 0, rows_.template topRows<2>(), sum);
      if (adds_free_tangents())
        add_tangent(v, a, free(), free_start, d_free_, sum);
      return sum;
    };
    const double inverse_length = 1 / t.col(0).norm();
    rows_.row(beta) = inverse_length * along_tangent(normal(), 0);
    if constexpr (Dimension == 2) {
      rows_.row(alpha) = inverse_length * along_tangent(tangent(1), 0);
      rows_.row(gamma) = (along_tangent(normal(), 1) - t.col(1).dot(tangent(0)) * rows_.row(beta)) /
                         t.col(1).dot(tangent(1));
    } else {
      rows_.row(alpha).setZero();
      rows_.row(gamma).setZero();
    }
  }

  const FaceGeometry& free() const {
    if constexpr (Inside)
      return clamped_;
    else
      return *free_;
  }

  const Vector3d& normal() const { return out_.normal; }
  Vector3d tangent(int a) const { return out_.tangents.col(a); }
  void set_frame(const Vector3d& unit_normal, const Vector3d& first_tangent) {
    out_.normal = unit_normal;
    out_.tangents.col(0) = first_tangent;
    out_.tangents.col(1) = unit_normal.cross(first_tangent);
  }

  PlaceOnFace place_of(const PointOnFace& on) const {
    const auto& face = zone_.slave.faces[static_cast<std::size_t>(on.face)];
    return {face, deformed(face, configuration_), on.xi};
  }

  static Vector3d area_vector(const PlaceOnFace& place) {
    return place.at.tangents.col(0).cross(place.at.tangents.col(1));
  }

  /// n_s, the unit of the sum over the slave faces at the point of their unit normals.
  Vector3d slave_normal() const {
    Vector3d sum = Vector3d::Zero();
    for (const auto& on : point_.stands_on)
      sum += area_vector(place_of(on)).normalized();
    return sum.normalized();
  }

  void vary_slave_normal() {
    Vector3d sum = Vector3d::Zero();
    auto& variation = out_.d_slave_normal;
    variation.setZero(3, slave_count_ * components);
    for (const auto& on : point_.stands_on) {
      const auto place = place_of(on);
      const Unit unit(area_vector(place));
      sum += unit.direction;
      const Matrix3d by_first = -(unit.derivative * cross_matrix(place.at.tangents.col(1)));
      const Matrix3d by_second = unit.derivative * cross_matrix(place.at.tangents.col(0));
      const auto& face = zone_.slave.faces[static_cast<std::size_t>(on.face)];
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
  }

  Index local_slave_node(mesh::NodeIndex node) const {
    Index i = 0;
    while (point_.nodes[static_cast<std::size_t>(i)] != node)
      ++i;
    return i;
  }

  bool averages() const { return zone_.settings.normal == study::ContactNormal::average; }

  /// From the master's frame to one with the normal −n_s or n − n_s, made a unit. τ₁ keeps the master's first
  /// direction as far as the turned normal allows. Returns the normal's length before.
  double set_turned_frame(const Vector3d& slave) {
    const Vector3d direction = (averages() ? normal() : Vector3d::Zero().eval()) - slave;
    const Vector3d turned = direction.normalized();
    const Vector3d along = tangent(0) - tangent(0).dot(turned) * turned;
    set_frame(turned, along.normalized());
    return direction.norm();
  }

  void turn_to_slave() {
    const Vector3d n = normal(), t1 = tangent(0), t2 = tangent(1);
    const Local<row_count> master = rows_;
    vary_slave_normal();
    const double length = set_turned_frame(slave_normal());
    const double part = t1.dot(normal());
    const double along = (t1 - part * normal()).norm();
    const auto against_normal = [&](const Vector3d& v) { // −v·dn
      Local<1> row = Local<1>::Zero();
      motion(row, turning_start, 0) = in_space(v);
      if (averages())
        row += v.dot(t1) * master.row(beta) + v.dot(t2) * master.row(gamma);
      return (row / length).eval();
    };
    rows_.row(beta) = against_normal(tangent(0));
    rows_.row(gamma) = against_normal(tangent(1));
    rows_.row(alpha) = (tangent(1).dot(t2) * master.row(alpha) + tangent(1).dot(n) * master.row(beta) +
                        part * rows_.row(gamma)) /
                       along;
  }

  Vector3d apart() const { return slave_position_ - clamped_.position; }

  void measure_gap() { out_.gap = normal().dot(apart()); }

  void vary_gap() {
    factors_.row(0).setZero();
    factors_(0, beta) = -apart().dot(tangent(0));
    factors_(0, gamma) = -apart().dot(tangent(1));
    for (int a = 0; a < Dimension; ++a)
      factors_(0, xi1 + a) = -normal().dot(clamped_.tangents.col(a));
  }

  Vector3d increment(Index node) const {
    return configuration_.increment(out_.stencil.nodes[static_cast<std::size_t>(node)]);
  }

  void measure_slip() {
    moved_ = out_.stencil.sum([&](auto node) { return configuration_.increment(node); });
    out_.slip.setZero();
    for (int a = 0; a < Dimension; ++a)
      out_.slip[a] = tangent(a).dot(moved_);
  }

  void vary_slip() {
    Eigen::Matrix<double, 3, 2> moved_slope = Eigen::Matrix<double, 3, 2>::Zero();
    for (Index i = slave_count_; i < out_.stencil.weights.size(); ++i)
      for (int a = 0; a < Dimension; ++a)
        moved_slope.col(a) += out_.shape_slope(i, a) * increment(i);
    const Eigen::Vector2d along = out_.tangents.transpose() * moved_;
    const double across = normal().dot(moved_);
    factors_.template block<2, 2>(1, xi1) = out_.tangents.transpose() * moved_slope;
    factors_.template block<2, 3>(1, alpha) =
        Eigen::Matrix<double, 2, 3>{{along[1], across, 0}, {-along[0], 0, across}};
    if constexpr (Dimension == 1)
      factors_.row(2).setZero();
  }

  using Block = Eigen::Matrix<double, row_count, components>;

  /// From derivatives by the motions to those by q, node by node.
  void expand() const {
    const Index unknowns = out_.unknowns();
    out_.d_projection.resize(2, unknowns);
    out_.d_normal.resize(3, unknowns);
    for (auto& variation : out_.d_tangent)
      variation.resize(3, unknowns);
    out_.d_gap.resize(unknowns);
    out_.d_slip.resize(2, unknowns);
    Block by_approach = motion(rows_, 0, 0);
    if constexpr (!Inside)
      by_approach += motion(rows_, free_start, 0);
    for (Index i = 0; i < slave_count_; ++i) {
      Block rows = out_.stencil.weights[i] * by_approach;
      if constexpr (Turned)
        rows += motion(rows_, turning_start, 0) *
                motion(out_.d_slave_normal, 0, static_cast<int>(i)).template topRows<components>();
      write(i, rows);
    }
    for (Index j = 0; j < face_.node_count; ++j) {
      const Index node = slave_count_ + j;
      Block rows = out_.stencil.weights[node] * motion(rows_, 0, 0);
      for (int a = 0; a < Dimension; ++a)
        rows -= out_.shape_slope(node, a) * motion(rows_, 0, 1 + a);
      if constexpr (!Inside)
        for (int k = 0; k <= Dimension; ++k)
          rows += free_weights_(k, j) * motion(rows_, free_start, k);
      write(node, rows);
    }
  }

  void write(Index node, const Block& rows) const {
    const Vector3d n = normal(), t1 = tangent(0), t2 = tangent(1);
    const double shape = out_.stencil.weights[node];
    for (int c = 0; c < components; ++c) {
      const Index column = node * components + c;
      const double a = rows(alpha, c), b = rows(beta, c), g = rows(gamma, c);
      out_.d_projection.col(column) = rows.col(c).template head<2>();
      out_.d_normal.col(column) = -b * t1 - g * t2;
      out_.d_tangent[0].col(column) = a * t2 + b * n;
      out_.d_tangent[1].col(column) = g * n - a * t1;
      const Vector3d measures =
          Vector3d(n[c], t1[c], Dimension == 2 ? t2[c] : 0.0) * shape + factors_.lazyProduct(rows.col(c));
      out_.d_gap[column] = measures[0];
      out_.d_slip.col(column) = measures.template tail<2>();
    }
  }

  const Zone& zone_;
  const SlavePoint& point_;
  const Projection& projection_;
  const Configuration& configuration_;
  const Face& face_;
  Kinematics& out_;
  FaceCoordinates coordinates_;
  FaceGeometry clamped_;
  std::optional<FaceGeometry> free_;           ///< where it differs and has been asked for
  Eigen::Matrix<double, 3, 2> added_tangents_; ///< of both, where the frame takes them
  Vector3d slave_position_;
  Index slave_count_;
  Vector3d moved_; ///< the point relative to its place on the master, since the start of the step
  /// What a master node's displacement is multiplied with in the free place's motions, one a row.
  Eigen::Matrix<double, 1 + Dimension, 9> free_weights_;
  Local<2> d_free_;
  /// dξ̄ and how the frame turns: dτ₁ = α τ₂ + β n, dτ₂ = −α τ₁ + γ n, dn = −β τ₁ − γ τ₂.
  Local<row_count> rows_;
  /// dg and dΔs_a are n·e and τ_a·e plus these factors times the rows.
  Eigen::Matrix<double, 3, row_count> factors_;
};

/// Calls `visit` with the evaluation that is compiled for the point.
template <int Dimension, bool Inside, class Visit>
void with_turned(const Zone& zone, const SlavePoint& point, const Pair& pair,
                 const Configuration& configuration, Kinematics& into, const Visit& visit) {
  if (zone.settings.normal == study::ContactNormal::master)
    visit(Evaluation<Dimension, Inside, false>(zone, point, pair, configuration, into));
  else
    visit(Evaluation<Dimension, Inside, true>(zone, point, pair, configuration, into));
}

template <int Dimension, class Visit>
void with_clamped(const Zone& zone, const SlavePoint& point, const Pair& pair,
                  const Configuration& configuration, Kinematics& into, const Visit& visit) {
  if (pair.projection.inside())
    with_turned<Dimension, true>(zone, point, pair, configuration, into, visit);
  else
    with_turned<Dimension, false>(zone, point, pair, configuration, into, visit);
}

template <class Visit>
void with_evaluation(const Zone& zone, const SlavePoint& point, const Pair& pair,
                     const Configuration& configuration, Kinematics& into, const Visit& visit) {
  if (configuration.dofs->components == 2)
    with_clamped<1>(zone, point, pair, configuration, into, visit);
  else
    with_clamped<2>(zone, point, pair, configuration, into, visit);
}

void add_offset(const Zone& zone, const SlavePoint& point, double t, Kinematics& k) {
  k.gap_origin = -zone.offset.at(point.place, t);
  k.gap -= k.gap_origin;
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
  if (zone.obstacle)
    evaluate_before(*zone.obstacle, point, configuration, into);
  else
    with_evaluation(zone, point, pair, configuration, into, [](auto&& evaluation) {
      evaluation.measure();
      evaluation.differentiate();
    });
  add_offset(zone, point, configuration.t, into);
}

void measure_kinematics(const Zone& zone, const SlavePoint& point, const Pair& pair,
                        const Configuration& configuration, Kinematics& into) {
  if (zone.obstacle)
    evaluate_before(*zone.obstacle, point, configuration, into);
  else
    with_evaluation(zone, point, pair, configuration, into, [](auto&& evaluation) { evaluation.measure(); });
  add_offset(zone, point, configuration.t, into);
}

} // namespace rubato::contact
