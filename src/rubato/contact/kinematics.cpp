// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/kinematics.hpp"

#include "rubato/contact/averaged_normal.hpp"
#include "rubato/contact/given_normal.hpp"
#include "rubato/contact/motion_rows.hpp"
#include "rubato/contact/obstacle_kinematics.hpp"
#include "rubato/contact/small_vectors.hpp"

#include <algorithm>
#include <array>
#include <optional>

namespace rubato::contact {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

/// Builds one point's kinematics step by step; lives only as long as evaluate_kinematics.
///
/// Derivatives are taken with respect to the point's few motions first (see the header), in this order: e,
/// m_a of the clamped place; the same of the free place unless both places agree; δ(n_s − n_m) when these
/// give the normal. Loops over motions have bounds of run time: only the dimension is worth instructions of
/// its own.
template <int Dimension> class Evaluation {
public:
  Evaluation(const Zone& zone, const SlavePoint& point, const Pair& pair, const Configuration& configuration,
             Kinematics& out)
      : zone_(zone), point_(point), projection_(pair.projection), configuration_(configuration),
        face_index_(pair.master_face), face_(zone.master.faces[static_cast<std::size_t>(pair.master_face)]),
        out_(out), inside_(pair.projection.inside()), turned_(gives_normal(zone.settings)),
        slave_count_(static_cast<Index>(point.nodes.size())), coordinates_(deformed(face_, configuration)),
        clamped_(face_geometry(face_.type, coordinates_, projection_.clamped)),
        slave_position_(position(point, configuration)) {
    if (!adds_free_tangents())
      return;
    free_ = face_geometry(face_.type, coordinates_, projection_.xi);
    for (int a = 0; a < 2; ++a)
      for (int i = 0; i < 3; ++i)
        added_tangents_(i, a) = clamped_.tangents(i, a) + free_->tangents(i, a);
  }

  /// All but derivatives.
  void measure() {
    collect_nodes();
    set_master_frame();
    if (turned_)
      set_turned_frame(
          given_.emplace(given_normal(zone_, point_, face_index_, projection_.clamped, configuration_)));
    measure_gap();
    measure_slip();
  }

  /// Derivatives of what has been measured.
  void differentiate() {
    collect_slopes();
    if (!inside_) {
      if (!free_)
        free_ = face_geometry(face_.type, coordinates_, projection_.xi);
      collect_free_weights();
    }
    vary_projection();
    set_master_frame();
    vary_frame();
    if (turned_)
      turn_as_given();
    vary_gap();
    vary_slip();
    expand();
  }

private:
  using Rows = MotionRows<Dimension>;
  using Motion = typename Rows::Motion;
  using Row = typename Rows::Row;
  static constexpr int components = Rows::components;
  static constexpr int place_motions = Rows::place_motions;
  static constexpr std::size_t width = Rows::width;
  /// Rows of what all derivatives are made of. In the plane τ₂ does not turn: α = γ = 0.
  static constexpr int xi = 0;
  static constexpr int beta = Dimension;
  static constexpr int alpha = 3;
  static constexpr int gamma = 4;
  static constexpr int row_count = Dimension == 2 ? 5 : 2;
  /// The entries of one node, by row and component.
  using Block = std::array<Motion, row_count>;

  /// Where the motions of the free place and δ(n_s − n_m) stand among all.
  int free_start() const { return inside_ ? 0 : place_motions; }
  int turning() const { return free_start() + place_motions; }
  int motion_count() const { return turning() + (turned_ ? 1 : 0); }

  void clear(Row& row) const { Rows::clear(motion_count(), row); }
  void add(double factor, const Row& row, Row& to) const { Rows::add(motion_count(), factor, row, to); }
  static void add(double factor, const Vector3d& v, Motion& to) { Rows::add(factor, v, to); }
  static void add(double factor, const Motion& motion, Motion& to) { Rows::add(factor, motion, to); }
  static Motion& motion(Row& row, int which) { return row[static_cast<std::size_t>(which)]; }
  static const Motion& motion(const Row& row, int which) { return row[static_cast<std::size_t>(which)]; }
  Row& row(int which) { return rows_[static_cast<std::size_t>(which)]; }
  const Row& row(int which) const { return rows_[static_cast<std::size_t>(which)]; }

  void collect_nodes() {
    out_.stencil.components = components;
    out_.parametric_dimension = Dimension;
    const auto own = slave_count_ + face_.node_count;
    out_.stencil.nodes.resize(static_cast<std::size_t>(own));
    const auto nodes = face_.node_span();
    std::copy(nodes.begin(), nodes.end(),
              std::copy(point_.nodes.begin(), point_.nodes.end(), out_.stencil.nodes.begin()));
    if (averages_master(zone_.settings))
      append_ring(zone_.master, face_index_, point_.nodes.size(), out_.stencil.nodes);
    const auto count = static_cast<Index>(out_.stencil.nodes.size());
    out_.stencil.weights.resize(count);
    out_.stencil.weights.tail(count - own).setZero();
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
        out_.shape_slope(slave_count_ + j, a) = -shape.gradient(j, a, Dimension);
  }

  void collect_free_weights() {
    const auto shape = face_shape(face_.type, projection_.xi);
    for (Index j = 0; j < face_.node_count; ++j) {
      auto& weights = free_weights_[static_cast<std::size_t>(j)];
      weights[0] = -shape.values[static_cast<std::size_t>(j)];
      for (int a = 0; a < Dimension; ++a)
        weights[static_cast<std::size_t>(1 + a)] = shape.gradient(j, a, Dimension);
    }
  }

  using Square = std::array<std::array<double, Dimension>, Dimension>;

  static Square inverse_of(const Square& m) {
    if constexpr (Dimension == 1) {
      return {{{1 / m[0][0]}}};
    } else {
      const double inverse = 1 / (m[0][0] * m[1][1] - m[1][0] * m[0][1]);
      return {{{m[1][1] * inverse, -m[0][1] * inverse}, {-m[1][0] * inverse, m[0][0] * inverse}}};
    }
  }

  /// dξ̄, and dξ where it differs.
  void vary_projection() {
    const auto& place = free();
    const Vector3d r = difference_of(slave_position_, place.position);
    std::array<Vector3d, Dimension> t;
    for (int a = 0; a < Dimension; ++a)
      t[static_cast<std::size_t>(a)] = column_of(place.tangents, a);
    Square slope;
    for (std::size_t a = 0; a < Dimension; ++a)
      for (std::size_t b = 0; b < Dimension; ++b)
        slope[a][b] = dot(t[a], t[b]) - dot(r, place.curvatures[a][b]);
    const auto inverse = inverse_of(slope);
    for (std::size_t a = 0; a < Dimension; ++a) {
      auto& row = inside_ ? rows_[a] : d_free_[a];
      clear(row);
      for (std::size_t b = 0; b < Dimension; ++b) {
        add(inverse[a][b], t[b], motion(row, free_start()));
        add(inverse[a][b], r, motion(row, free_start() + 1 + static_cast<int>(b)));
      }
    }
    if (!inside_)
      clamp_projection();
  }

  void clamp_projection() {
    for (int a = 0; a < Dimension; ++a) {
      clear(row(a));
      for (int b = 0; b < Dimension; ++b)
        add(projection_.clamp_derivative(a, b), d_free_[static_cast<std::size_t>(b)], row(a));
    }
  }

  /// Adds v · d x,_a at a reference point that moves by d_xi, whose motions begin at `start`.
  template <class Rows>
  void add_tangent(const Vector3d& v, int a, const FaceGeometry& place, int start, const Rows& d_xi,
                   Row& sum) const {
    add(1, v, motion(sum, start + 1 + a));
    for (std::size_t b = 0; b < Dimension; ++b)
      if (const double bend = dot(v, place.curvatures[static_cast<std::size_t>(a)][b]); bend != 0)
        add(bend, d_xi[b], sum);
  }

  /// The frame at the clamped place or, with Code_Aster, at the sum of both places' tangents t_a.
  void set_master_frame() {
    const Vector3d t1 = direction(0);
    set_frame(unit_of(cross(t1, direction(1))), unit_of(t1));
  }

  Vector3d direction(int a) const {
    return column_of(adds_free_tangents() ? added_tangents_ : clamped_.tangents, a);
  }
  bool adds_free_tangents() const {
    return !inside_ && zone_.settings.clamped_normal == study::ClampedNormal::code_aster;
  }

  /// v · dt_a of the tangent that the frame takes.
  Row along_tangent(const Vector3d& v, int a) const {
    Row sum;
    clear(sum);
    add_tangent(v, a, clamped_, 0, rows_, sum);
    if (adds_free_tangents())
      add_tangent(v, a, free(), free_start(), d_free_, sum);
    return sum;
  }

  /// How that frame turns follows from n·dt_a = −t_a·dn and τ₂·dt₁ = |t₁| τ₂·dτ₁.
  void vary_frame() {
    const double inverse_length = 1 / length_of(direction(0));
    set_row(beta, inverse_length, along_tangent(normal(), 0));
    if constexpr (Dimension == 2) {
      set_row(alpha, inverse_length, along_tangent(tangent(1), 0));
      const Vector3d t = direction(1);
      auto turn = along_tangent(normal(), 1);
      add(-dot(t, tangent(0)), row(beta), turn);
      set_row(gamma, 1 / dot(t, tangent(1)), turn);
    }
  }

  void set_row(int which, double factor, const Row& from) {
    Rows::assign(motion_count(), factor, from, row(which));
  }

  const FaceGeometry& free() const { return inside_ ? clamped_ : *free_; }

  const Vector3d& normal() const { return out_.normal; }
  Vector3d tangent(int a) const { return column_of(out_.tangents, a); }
  void set_frame(const Vector3d& unit_normal, const Vector3d& first_tangent) {
    const Vector3d second_tangent = cross(unit_normal, first_tangent);
    out_.normal = unit_normal;
    for (int i = 0; i < 3; ++i) {
      out_.tangents(i, 0) = first_tangent[i];
      out_.tangents(i, 1) = second_tangent[i];
    }
  }

  /// From the master's frame to one with the given normal. τ₁ keeps the master's first direction as far as
  /// the normal allows. Returns the length of what the normal is the unit of.
  double set_turned_frame(const GivenNormal& given) {
    const Vector3d direction = given.adds_face ? sum_of(normal(), given.sum) : given.sum;
    const Vector3d turned = unit_of(direction);
    set_frame(turned, unit_of(part_across(turned, tangent(0))));
    return length_of(direction);
  }

  void turn_as_given() {
    const Vector3d n = normal(), t1 = tangent(0), t2 = tangent(1);
    const auto master = rows_;
    vary_given_normal(zone_, point_, face_index_, projection_.clamped, configuration_, out_.stencil.nodes,
                      out_.d_given_normal);
    const double length = set_turned_frame(*given_);
    const auto against_normal = [&](const Vector3d& v, int which) { // −v·dn
      Row sum;
      clear(sum);
      add(1, v, motion(sum, turning()));
      for (std::size_t a = 0; a < Dimension; ++a)
        add(-dot(v, given_->by_place[a]), rows_[a], sum);
      if (given_->adds_face) {
        add(dot(v, t1), master[beta], sum);
        if constexpr (Dimension == 2)
          add(dot(v, t2), master[gamma], sum);
      }
      set_row(which, 1 / length, sum);
    };
    against_normal(tangent(0), beta);
    if constexpr (Dimension == 2) {
      against_normal(tangent(1), gamma);
      const double part = dot(t1, normal());
      const double along = length_of(part_across(normal(), t1));
      Row sum;
      clear(sum);
      add(dot(tangent(1), t2), master[alpha], sum);
      add(dot(tangent(1), n), master[beta], sum);
      add(part, row(gamma), sum);
      set_row(alpha, 1 / along, sum);
    }
  }

  Vector3d apart() const { return difference_of(slave_position_, clamped_.position); }

  void measure_gap() { out_.gap = dot(normal(), apart()); }

  void vary_gap() {
    const Vector3d r = apart();
    auto& factors = factors_[0];
    for (int a = 0; a < Dimension; ++a)
      factors[static_cast<std::size_t>(a)] = -dot(normal(), column_of(clamped_.tangents, a));
    factors[beta] = -dot(r, tangent(0));
    if constexpr (Dimension == 2) {
      factors[alpha] = 0;
      factors[gamma] = -dot(r, tangent(1));
    }
  }

  void measure_slip() {
    moved_ = out_.stencil.sum([&](auto node) { return configuration_.increment(node); });
    out_.slip.setZero();
    for (int a = 0; a < Dimension; ++a)
      out_.slip[a] = dot(tangent(a), moved_);
  }

  void vary_slip() {
    std::array<Vector3d, Dimension> moved_slope;
    moved_slope.fill(Vector3d(0, 0, 0));
    for (Index i = slave_count_; i < out_.stencil.weights.size(); ++i) {
      const Vector3d increment = configuration_.increment(out_.stencil.nodes[static_cast<std::size_t>(i)]);
      for (std::size_t a = 0; a < Dimension; ++a)
        add_scaled(out_.shape_slope(i, static_cast<Index>(a)), increment, moved_slope[a]);
    }
    for (std::size_t b = 0; b < Dimension; ++b)
      for (std::size_t a = 0; a < Dimension; ++a)
        factors_[1 + b][a] = dot(tangent(static_cast<int>(b)), moved_slope[a]);
    const double across = dot(normal(), moved_);
    factors_[1][beta] = across;
    if constexpr (Dimension == 2) {
      factors_[1][alpha] = dot(tangent(1), moved_);
      factors_[1][gamma] = 0;
      factors_[2][beta] = 0;
      factors_[2][alpha] = -dot(tangent(0), moved_);
      factors_[2][gamma] = across;
    }
  }

  /// From derivatives by the motions to those by q, node by node.
  void expand() const {
    const Index unknowns = out_.unknowns();
    out_.d_projection.resize(2, unknowns);
    out_.d_normal.resize(3, unknowns);
    for (auto& variation : out_.d_tangent)
      variation.resize(3, unknowns);
    out_.d_gap.resize(unknowns);
    out_.d_slip.resize(2, unknowns);
    for (Index i = 0; i < slave_count_; ++i)
      write_turned(i, of_slave_node(i));
    for (Index j = 0; j < face_.node_count; ++j)
      write_turned(slave_count_ + j, of_master_node(j));
    for (Index i = slave_count_ + face_.node_count; i < out_.stencil.weights.size(); ++i)
      write_turned(i, Block{});
  }

  /// With what the node adds by the given normal.
  void write_turned(Index node, Block&& block) const {
    if (turned_)
      add_turning(node, block);
    write(node, block);
  }

  Block of_slave_node(Index node) const {
    const double weight = out_.stencil.weights[node];
    Block block;
    for (std::size_t k = 0; k < row_count; ++k)
      for (std::size_t c = 0; c < width; ++c)
        block[k][c] = weight * (inside_ ? rows_[k][0][c] : rows_[k][0][c] + rows_[k][place_motions][c]);
    return block;
  }

  void add_turning(Index node, Block& block) const {
    for (std::size_t k = 0; k < row_count; ++k)
      for (int d = 0; d < components; ++d)
        for (int c = 0; c < components; ++c)
          block[k][static_cast<std::size_t>(c)] += motion(rows_[k], turning())[static_cast<std::size_t>(d)] *
                                                   out_.d_given_normal(d, node * components + c);
  }

  Block of_master_node(Index of_face) const {
    const Index node = slave_count_ + of_face;
    const double weight = out_.stencil.weights[node];
    Block block;
    for (std::size_t k = 0; k < row_count; ++k) {
      for (std::size_t c = 0; c < width; ++c)
        block[k][c] = weight * rows_[k][0][c];
      for (int a = 0; a < Dimension; ++a)
        add(-out_.shape_slope(node, a), motion(rows_[k], 1 + a), block[k]);
      if (!inside_)
        for (std::size_t m = 0; m < place_motions; ++m)
          add(free_weights_[static_cast<std::size_t>(of_face)][m], rows_[k][place_motions + m], block[k]);
    }
    return block;
  }

  void write(Index node, const Block& rows) const {
    const Vector3d n = normal(), t1 = tangent(0), t2 = tangent(1);
    const double shape = out_.stencil.weights[node];
    for (int c = 0; c < components; ++c) {
      const Index column = node * components + c;
      Factors of;
      for (std::size_t k = 0; k < row_count; ++k)
        of[k] = rows[k][static_cast<std::size_t>(c)];
      double a = 0, g = 0;
      if constexpr (Dimension == 2) {
        a = of[alpha];
        g = of[gamma];
      }
      const double b = of[beta];
      for (int i = 0; i < 3; ++i) {
        out_.d_normal(i, column) = -b * t1[i] - g * t2[i];
        out_.d_tangent[0](i, column) = a * t2[i] + b * n[i];
        out_.d_tangent[1](i, column) = g * n[i] - a * t1[i];
      }
      out_.d_projection(0, column) = of[xi];
      out_.d_projection(1, column) = Dimension == 2 ? of[xi + 1] : 0;
      out_.d_gap[column] = measured(n[c] * shape, factors_[0], of);
      out_.d_slip(0, column) = measured(t1[c] * shape, factors_[1], of);
      out_.d_slip(1, column) = Dimension == 2 ? measured(t2[c] * shape, factors_[Dimension], of) : 0;
    }
  }

  using Factors = std::array<double, row_count>;
  static double measured(double approach, const Factors& factors, const Factors& rows) {
    double sum = 0;
    for (std::size_t k = 0; k < row_count; ++k)
      sum += factors[k] * rows[k];
    return approach + sum;
  }

  const Zone& zone_;
  const SlavePoint& point_;
  const Projection& projection_;
  const Configuration& configuration_;
  int face_index_;
  const Face& face_;
  Kinematics& out_;
  bool inside_; ///< the free place is the clamped one
  bool turned_; ///< the normal is not the face's alone
  Index slave_count_;
  FaceCoordinates coordinates_;
  FaceGeometry clamped_;
  std::optional<FaceGeometry> free_;           ///< where it differs and has been asked for
  Eigen::Matrix<double, 3, 2> added_tangents_; ///< of both, where the frame takes them
  Vector3d slave_position_;
  std::optional<GivenNormal> given_; ///< where the normal is not the face's alone
  Vector3d moved_; ///< the point relative to its place on the master, since the start of the step
  /// The factor of each master node's displacement in the motions of the free place.
  std::array<std::array<double, place_motions>, 9> free_weights_;
  std::array<Row, Dimension> d_free_;
  /// dξ̄ and how the frame turns: dτ₁ = α τ₂ + β n, dτ₂ = −α τ₁ + γ n, dn = −β τ₁ − γ τ₂.
  std::array<Row, row_count> rows_;
  /// dg and dΔs_a are n·e and τ_a·e plus these factors times the rows.
  std::array<Factors, 1 + Dimension> factors_;
};

/// Calls `visit` with the evaluation that is compiled for the dimension.
template <class Visit>
void with_evaluation(const Zone& zone, const SlavePoint& point, const Pair& pair,
                     const Configuration& configuration, Kinematics& into, const Visit& visit) {
  if (configuration.dofs->components == 2)
    visit(Evaluation<1>(zone, point, pair, configuration, into));
  else
    visit(Evaluation<2>(zone, point, pair, configuration, into));
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
