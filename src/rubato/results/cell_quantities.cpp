// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/results/cell_quantities.hpp"

#include "rubato/cell/shape_table.hpp"
#include "rubato/element/element.hpp"
#include "rubato/model/model.hpp"

namespace rubato::results {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using study::ProbeField;

namespace {

domain::Tensor tensor_of(ProbeField what) {
  switch (what) {
  case ProbeField::strain:
    return domain::Tensor::strain;
  case ProbeField::plastic_strain:
    return domain::Tensor::plastic_strain;
  default:
    return domain::Tensor::stress;
  }
}

template <class Of> MatrixXd of_each(const MatrixXd& stresses, Index rows, const Of& of) {
  MatrixXd result(rows, stresses.cols());
  for (Index i = 0; i < stresses.cols(); ++i)
    result.col(i) = of(material::FullStress(stresses.col(i)));
  return result;
}

template <class Of> MatrixXd number_of_each(const MatrixXd& stresses, const Of& of) {
  return of_each(stresses, 1,
                 [&](const material::FullStress& stress) { return Eigen::Matrix<double, 1, 1>(of(stress)); });
}

} // namespace

MatrixXd of_stresses(ProbeField what, const MatrixXd& stresses) {
  switch (what) {
  case ProbeField::von_mises:
    return number_of_each(stresses, material::von_mises);
  case ProbeField::tresca:
    return number_of_each(stresses, material::tresca);
  case ProbeField::mean_stress:
    return number_of_each(stresses, material::mean_stress);
  case ProbeField::principal_stress:
    return of_each(stresses, 3, material::principal_values);
  default:
    return stresses;
  }
}

CellQuantities::CellQuantities(const model::Model& model, const step::State& state)
    : model_(model), tensors_(model.mesh, model.bulk, model.dofs, state.motion.u,
                              {model.domain.heat(), state.t}, &state.bulk_points) {
  if (const auto* heat = model.domain.heat())
    temperatures_ = heat->temperatures(state.t);
}

MatrixXd CellQuantities::at_points(ProbeField what, std::size_t cell) {
  if (what == ProbeField::temperature)
    return temperatures_of(cell) * cell::stiffness_table(type_of(cell)).values;
  if (what == ProbeField::cumulated_plastic_strain)
    return tensors_.cumulated_plastic_strain(cell);
  return of_stresses(what, tensors_.at_points(tensor_of(what), cell));
}

MatrixXd CellQuantities::at_nodes(ProbeField what, std::size_t cell) {
  if (what == ProbeField::temperature)
    return temperatures_of(cell);
  if (what == ProbeField::cumulated_plastic_strain)
    return tensors_.cumulated_plastic_strain_at_nodes(cell);
  return of_stresses(what, tensors_.at_nodes(tensor_of(what), cell));
}

VectorXd CellQuantities::mean(ProbeField what, std::size_t cell) {
  const auto weights = volumes(cell);
  return at_points(what, cell) * weights / weights.sum();
}

VectorXd CellQuantities::volumes(std::size_t cell) const {
  const auto type = type_of(cell);
  VectorXd volumes(domain::extrapolation(type).cols());
  element::point_volumes(type, domain::CellPoints(model_.mesh, model_.mesh.nodes_of(model_.bulk.cells[cell])),
                         model_.bulk.section, volumes);
  return volumes;
}

CellType CellQuantities::type_of(std::size_t cell) const {
  return model_.mesh.type_of(model_.bulk.cells[cell]);
}

MatrixXd CellQuantities::temperatures_of(std::size_t cell) const {
  return temperatures_(model_.domain.heat()->nodes_of(cell)).transpose();
}

} // namespace rubato::results
