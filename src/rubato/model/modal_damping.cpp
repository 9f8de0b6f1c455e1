// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/model/modal_damping.hpp"

#include "rubato/linalg/dense_products.hpp"
#include "rubato/linalg/eigen_modes.hpp"
#include "rubato/linalg/ranked_matrix.hpp"
#include "rubato/model/build.hpp"
#include "rubato/model/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace rubato::model {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

double ratio_of(const study::ModalDamping& asked, Index mode) {
  return asked.ratios.size() == 1 ? asked.ratios.front() : asked.ratios[static_cast<std::size_t>(mode)];
}

linalg::EigenModes found_modes(const Model& model, int number) {
  const bool floats = model.reduction.prescribed().empty() && model.springs.empty() &&
                      std::ranges::none_of(model.connectors, [](const auto& c) { return c.resists(); });
  auto stiffness = linalg::whole_of(model.domain.initial_tangent(), model.sharing());
  add_slopes_at_rest(model, stiffness);
  auto found = linalg::smallest_modes(model.reduction.reduced(stiffness),
                                      model.reduction.reduced(linalg::whole_of(model.mass, model.sharing())),
                                      SparseMatrix(model.reduction.unknown_count(), 0), number,
                                      floats ? linalg::Support::none : linalg::Support::unknown);
  if (!found || !found->converged)
    throw InputError(
        {fault_at("modal_damping.modes",
                  "modal_damping.modes: the natural modes of the bodies were not found; expected "
                  "fewer modes, or 'rayleigh' in the materials")});
  return std::move(*found);
}

} // namespace

VectorXd ModalDamping::force(const VectorXd& v) const {
  auto parts = linalg::transposed_product(momenta, v);
  for (Index k = 0; k < parts.size(); ++k)
    parts[k] *= factors[k];
  return linalg::product(momenta, parts);
}

ModalDamping make_modal_damping(const Model& model) {
  ModalDamping damping;
  const auto& asked = model.study.modal_damping;
  if (!asked)
    return damping;
  const auto modes = found_modes(model, asked->modes);
  const Index count = modes.values.size();
  if (count < asked->modes)
    throw InputError({fault_at(
        "modal_damping.modes",
        fmt::format("modal_damping.modes: found {}, but the bodies have {} modes", asked->modes, count))});
  damping.momenta.resize(model.dofs.dof_count, count);
  damping.factors.resize(count);
  for (Index k = 0; k < count; ++k) {
    const VectorXd shape = Eigen::Map<const VectorXd>(&modes.vectors(0, k), modes.vectors.rows());
    const auto momenta = linalg::product_of(model.mass, model.reduction.scatter(shape), model.sharing());
    std::copy(momenta.begin(), momenta.end(), &damping.momenta(0, k));
    damping.factors[k] = 2 * ratio_of(*asked, k) * std::sqrt(std::max(0.0, modes.values[k]));
  }
  return damping;
}

} // namespace rubato::model
