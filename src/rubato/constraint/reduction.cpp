// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/constraint/reduction.hpp"

#include "rubato/core/time_integral.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace rubato::constraint {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

bool are_same(const FieldAtPlace& a, const FieldAtPlace& b) {
  return *a.field == *b.field && a.place == b.place;
}

bool are_same(const RotatedPlace& a, const RotatedPlace& b) {
  return *a.by == *b.by && a.place == b.place && a.axis == b.axis;
}

/// Whether both are the same, or there is neither.
template <class T> bool are_same(const std::shared_ptr<T>& a, const std::shared_ptr<T>& b) {
  return a && b ? are_same(*a, *b) : !a && !b;
}

} // namespace

bool operator==(const ImposedValue& a, const ImposedValue& b) {
  return are_same(a.field, b.field) && are_same(a.rotation, b.rotation) && a.value == b.value &&
         a.function == b.function;
}

double value_at(const ImposedValue& imposed, double t) {
  const double turned = imposed.rotation ? displacement_at(*imposed.rotation->by, imposed.rotation->place,
                                                           t)[imposed.rotation->axis]
                                         : 0.0;
  if (imposed.field)
    return imposed.field->field->at(imposed.field->place, t) + turned;
  return imposed.value * (imposed.function ? rubato::value_at(*imposed.function, t) : 1.0) + turned;
}

double rate_at(const ImposedValue& imposed, double t, int order) {
  const double turned = imposed.rotation ? rate_at(*imposed.rotation->by, imposed.rotation->place, t,
                                                   order)[imposed.rotation->axis]
                                         : 0.0;
  return imposed.value * rubato::rate_at(imposed.function, t, order) + turned;
}

double displacement_of(const PrescribedDof& prescribed, double t) {
  return value_at(prescribed.imposed, t);
}

Reduction::Reduction(int dof_count, std::vector<PrescribedDof> prescribed)
    : Reduction(dof_count, std::move(prescribed), {}, {}) {}

Reduction::Reduction(int dof_count, std::vector<PrescribedDof> prescribed,
                     std::vector<DependentDof> dependents, std::vector<ImposedValue> right_sides)
    : prescribed_(std::move(prescribed)), dependents_(std::move(dependents)),
      right_sides_(std::move(right_sides)), unknown_of_(static_cast<std::size_t>(dof_count), 0) {
  mark_prescribed();
  mark_dependents();
  number_free();
  check_dependents();
  collect_reacting();
}

void Reduction::mark_prescribed() {
  int last = -1;
  for (const auto& entry : prescribed_) {
    if (entry.dof <= last || entry.dof >= dof_count())
      throw std::invalid_argument("prescribed dofs must ascend and be dofs of the domain");
    last = entry.dof;
    unknown_of_[static_cast<std::size_t>(entry.dof)] = prescribed_mark;
  }
}

void Reduction::mark_dependents() {
  int last = -1;
  int mark = first_dependent_mark;
  for (const auto& entry : dependents_) {
    if (entry.dof <= last || entry.dof >= dof_count() || is_prescribed(entry.dof))
      throw std::invalid_argument("dependent dofs must ascend and be dofs of the domain without a support");
    last = entry.dof;
    unknown_of_[static_cast<std::size_t>(entry.dof)] = entry.of.empty() ? prescribed_mark : mark;
    --mark;
  }
}

void Reduction::number_free() {
  for (int dof = 0; dof < dof_count(); ++dof)
    if (auto& unknown = unknown_of_[static_cast<std::size_t>(dof)]; unknown == 0) {
      unknown = static_cast<int>(free_dofs_.size());
      free_dofs_.push_back(dof);
    }
}

void Reduction::check_dependents() const {
  for (const auto& dependent : dependents_)
    for (const auto& term : dependent.of)
      if (term.dof < 0 || term.dof >= dof_count() || unknown_of(term.dof) < 0)
        throw std::invalid_argument("dependent dofs must depend on free ones");
}

void Reduction::collect_reacting() {
  for (const auto& entry : prescribed_)
    reacting_.push_back(entry.dof);
  for (const auto& entry : dependents_) {
    reacting_.push_back(entry.dof);
    for (const auto& term : entry.of)
      reacting_.push_back(term.dof);
  }
  std::ranges::sort(reacting_);
  reacting_.erase(std::unique(reacting_.begin(), reacting_.end()), reacting_.end());
}

void Reduction::carry(Base base, int components) {
  base_ = std::move(base);
  components_ = components;
}

/// s of the dof's axis, or its rate.
double Reduction::base_at(int dof, double t, int order) const {
  if (!is_carried())
    return 0;
  const auto& base = base_.at(static_cast<std::size_t>(dof % components_));
  if (!base)
    return 0;
  constexpr std::array<double, 3> anywhere{};
  if (order > 0)
    return base->multiplied_at(anywhere, t) * rubato::rate_at(base->function, t, order);
  return base->at(anywhere, t);
}

/// Of a prescribed dof.
const PrescribedDof& Reduction::support_of(int dof) const {
  return *std::ranges::lower_bound(prescribed_, dof, {}, &PrescribedDof::dof);
}

double Reduction::displacement(const PrescribedDof& prescribed, double t) const {
  return displacement_of(prescribed, t) + base_at(prescribed.dof, t);
}

bool Reduction::moves(const PrescribedDof& prescribed) const {
  return prescribed.imposed.varies_in_time() ||
         (is_carried() && base_.at(static_cast<std::size_t>(prescribed.dof % components_)).has_value());
}

bool Reduction::moves(const DependentDof& dependent) const {
  const auto varies = [&](const Term& term) {
    return right_sides_[static_cast<std::size_t>(term.dof)].varies_in_time();
  };
  return is_carried() || std::ranges::any_of(dependent.given, varies) ||
         std::ranges::any_of(dependent.prescribed,
                             [&](const Term& term) { return moves(support_of(term.dof)); });
}

/// What a base adds to a dependent dof: s less what s gives of the dofs it depends on; 0 of relations that
/// translations fulfil.
double Reduction::carried_part(const DependentDof& dependent, double t, int order) const {
  if (!is_carried())
    return 0;
  double sum = base_at(dependent.dof, t, order);
  for (const auto* terms : {&dependent.of, &dependent.prescribed})
    for (const auto& term : *terms)
      sum -= term.coefficient * base_at(term.dof, t, order);
  return sum;
}

double Reduction::given_part(const DependentDof& dependent, double t) const {
  double sum = carried_part(dependent, t, 0);
  for (const auto& term : dependent.prescribed)
    sum += term.coefficient * displacement(support_of(term.dof), t);
  for (const auto& term : dependent.given)
    sum += term.coefficient * value_at(right_sides_[static_cast<std::size_t>(term.dof)], t);
  return sum;
}

void Reduction::impose_rates(int order, double t, VectorXd& rates) const {
  const auto given = [&](const PrescribedDof& entry) {
    return rate_at(entry.imposed, t, order) + base_at(entry.dof, t, order);
  };
  for (const auto& entry : prescribed_)
    if (const double rate = given(entry); rate != 0)
      rates[entry.dof] = rate;
  for (const auto& dependent : dependents_) {
    double sum = carried_part(dependent, t, order);
    for (const auto& term : dependent.prescribed)
      sum += term.coefficient * given(support_of(term.dof));
    for (const auto& term : dependent.given)
      sum += term.coefficient * rate_at(right_sides_[static_cast<std::size_t>(term.dof)], t, order);
    if (sum == 0)
      continue;
    for (const auto& term : dependent.of)
      sum += term.coefficient * rates[term.dof];
    rates[dependent.dof] = sum;
  }
}

VectorXd Reduction::gather(const VectorXd& full) const {
  VectorXd unknowns = full(free_dofs_);
  for (const auto& dependent : dependents_)
    for (const auto& term : dependent.of)
      unknowns[unknown_of(term.dof)] += term.coefficient * full[dependent.dof];
  return unknowns;
}

VectorXd Reduction::gather_magnitudes(const VectorXd& full) const {
  VectorXd unknowns = full(free_dofs_);
  for (const auto& dependent : dependents_)
    for (const auto& term : dependent.of)
      unknowns[unknown_of(term.dof)] += std::abs(term.coefficient) * full[dependent.dof];
  return unknowns;
}

VectorXd Reduction::scatter(const VectorXd& unknowns) const {
  VectorXd full = VectorXd::Zero(dof_count());
  full(free_dofs_) = unknowns;
  relate(full);
  return full;
}

void Reduction::relate(VectorXd& rates) const {
  for (const auto& dependent : dependents_) {
    double sum = 0;
    for (const auto& term : dependent.of)
      sum += term.coefficient * rates[term.dof];
    rates[dependent.dof] = sum;
  }
}

SparseMatrix Reduction::reduced(const SparseMatrix& matrix) const {
  if (dependents_.empty())
    return selected(matrix);
  const SparseMatrix t = this->t();
  const SparseMatrix right = matrix * t;
  return SparseMatrix(t.transpose()) * right;
}

SparseMatrix Reduction::t() const {
  std::vector<Eigen::Triplet<double, int>> entries;
  for (int dof = 0; dof < dof_count(); ++dof)
    for_each_unknown(
        dof, [&](int unknown, double coefficient) { entries.emplace_back(dof, unknown, coefficient); });
  SparseMatrix t(dof_count(), unknown_count());
  t.setFromTriplets(entries.begin(), entries.end());
  return t;
}

/// Tᵀ A T where T only selects.
SparseMatrix Reduction::selected(const SparseMatrix& matrix) const {
  const Index size = unknown_count();
  SparseMatrix part(size, size);
  part.resizeNonZeros(matrix.nonZeros());
  int* const starts = part.outerIndexPtr();
  int count = 0;
  for (Index column = 0; column < size; ++column) {
    starts[column] = count;
    for (SparseMatrix::InnerIterator entry(matrix, free_dofs_[static_cast<std::size_t>(column)]); entry;
         ++entry)
      if (const int row = unknown_of(static_cast<int>(entry.row())); row >= 0) {
        part.innerIndexPtr()[count] = row;
        part.valuePtr()[count++] = entry.value();
      }
  }
  starts[size] = count;
  part.resizeNonZeros(count);
  return part;
}

VectorXd Reduction::imposed(double t) const {
  VectorXd g = VectorXd::Zero(dof_count());
  impose(t, g);
  return g;
}

void Reduction::impose(double t, VectorXd& u) const {
  for (const auto& entry : prescribed_)
    u[entry.dof] = displacement(entry, t);
  relate(u);
  for (const auto& dependent : dependents_)
    u[dependent.dof] += given_part(dependent, t);
}

VectorXd Reduction::correction(double t, const VectorXd& u) const {
  VectorXd d = VectorXd::Zero(dof_count());
  for (const auto& entry : prescribed_)
    d[entry.dof] = displacement(entry, t) - u[entry.dof];
  for (const auto& dependent : dependents_) {
    double sum = given_part(dependent, t);
    for (const auto& term : dependent.of)
      sum += term.coefficient * u[term.dof];
    d[dependent.dof] = sum - u[dependent.dof];
  }
  return d;
}

VectorXd Reduction::reaction(const VectorXd& residual) const {
  VectorXd forces = VectorXd::Zero(dof_count());
  for (const int dof : reacting_)
    forces[dof] = residual[dof];
  return forces;
}

VectorXd Reduction::multipliers(const VectorXd& reaction) const {
  VectorXd sums = VectorXd::Zero(static_cast<Index>(right_sides_.size()));
  for (const auto& dependent : dependents_)
    for (const auto& term : dependent.given)
      sums[term.dof] += term.coefficient * reaction[dependent.dof];
  return sums;
}

} // namespace rubato::constraint
