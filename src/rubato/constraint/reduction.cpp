// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/constraint/reduction.hpp"

#include <stdexcept>
#include <utility>

namespace rubato::constraint {

using Eigen::Index;
using Eigen::VectorXd;

bool operator==(const PrescribedDof& a, const PrescribedDof& b) {
  const bool same_field = a.field && b.field
                              ? *a.field->field == *b.field->field && a.field->place == b.field->place
                              : !a.field && !b.field;
  return same_field && a.dof == b.dof && a.value == b.value && a.function == b.function;
}

double displacement_of(const PrescribedDof& prescribed, double t) {
  if (prescribed.field)
    return prescribed.field->field->at(prescribed.field->place, t);
  return prescribed.value * (prescribed.function ? value_at(*prescribed.function, t) : 1.0);
}

Reduction::Reduction(int dof_count, std::vector<PrescribedDof> prescribed)
    : prescribed_(std::move(prescribed)), unknown_of_(static_cast<std::size_t>(dof_count), 0) {
  int last = -1;
  for (const auto& entry : prescribed_) {
    if (entry.dof <= last || entry.dof >= dof_count)
      throw std::invalid_argument("prescribed dofs must ascend and be dofs of the domain");
    last = entry.dof;
    unknown_of_[static_cast<std::size_t>(entry.dof)] = -1;
  }
  for (int dof = 0; dof < dof_count; ++dof)
    if (auto& unknown = unknown_of_[static_cast<std::size_t>(dof)]; unknown == 0) {
      unknown = static_cast<int>(free_dofs_.size());
      free_dofs_.push_back(dof);
    }
}

VectorXd Reduction::scatter(const VectorXd& unknowns) const {
  VectorXd full = VectorXd::Zero(dof_count());
  full(free_dofs_) = unknowns;
  return full;
}

SparseMatrix Reduction::reduced(const SparseMatrix& matrix) const {
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
    u[entry.dof] = displacement_of(entry, t);
}

VectorXd Reduction::correction(double t, const VectorXd& u) const {
  VectorXd d = VectorXd::Zero(dof_count());
  for (const auto& entry : prescribed_)
    d[entry.dof] = displacement_of(entry, t) - u[entry.dof];
  return d;
}

VectorXd Reduction::reaction(const VectorXd& residual) const {
  VectorXd forces = VectorXd::Zero(dof_count());
  for (const auto& entry : prescribed_)
    forces[entry.dof] = residual[entry.dof];
  return forces;
}

} // namespace rubato::constraint
