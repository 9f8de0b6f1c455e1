// SPDX-License-Identifier: LGPL-3.0-or-later
/// Products of a matrix of displacements that relations admit.
#pragma once

#include "rubato/domain/evaluation.hpp"

#include <utility>

namespace rubato::domain {

/// y = G(A P x) for `multiply`, y = A x: P is `admit`, G is `add_up`; either may be empty. What the arguments
/// refer to must outlive the product.
template <class Multiply> class AdmittedProduct {
public:
  AdmittedProduct(Multiply multiply, const AddUp& add_up, const Admit& admit)
      : multiply_(std::move(multiply)), add_up_(&add_up), admit_(&admit) {}

  void operator()(const Eigen::VectorXd& x, Eigen::VectorXd& y) {
    if (*admit_) {
      admitted_ = x;
      (*admit_)(admitted_);
    }
    multiply_(*admit_ ? admitted_ : x, y);
    if (*add_up_)
      (*add_up_)(y);
  }

private:
  Multiply multiply_;
  const AddUp* add_up_;
  const Admit* admit_;
  Eigen::VectorXd admitted_;
};

} // namespace rubato::domain
