// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/domain/law_springs.hpp"

namespace rubato::domain {

using Eigen::VectorXd;

double LawSpring::stretch(const VectorXd& x) const {
  double sum = 0;
  for (std::size_t i = 0; i < dofs.size(); ++i)
    sum += row[static_cast<Eigen::Index>(i)] * x[dofs[i]];
  return sum;
}

void add_beyond_matrix(std::span<const LawSpring> springs, const VectorXd& x, VectorXd& forces) {
  for (const auto& spring : springs) {
    const double e = spring.stretch(x);
    const double force = interpolated(spring.force, e) - spring.held * e;
    for (std::size_t i = 0; i < spring.dofs.size(); ++i)
      forces[spring.dofs[i]] += force * spring.row[static_cast<Eigen::Index>(i)];
  }
}

double energy_beyond_products(std::span<const LawSpring> springs, const VectorXd& u) {
  double sum = 0;
  for (const auto& spring : springs) {
    const double e = spring.stretch(u);
    sum += integral_to(spring.force, e) - 0.5 * e * interpolated(spring.force, e);
  }
  return sum;
}

double missed_between(std::span<const LawSpring> springs, const VectorXd& u0, const VectorXd& u1) {
  double sum = 0;
  for (const auto& spring : springs) {
    const double e0 = spring.stretch(u0);
    const double e1 = spring.stretch(u1);
    sum += 0.5 * (interpolated(spring.force, e0) + interpolated(spring.force, e1)) * (e1 - e0) -
           (integral_to(spring.force, e1) - integral_to(spring.force, e0));
  }
  return sum;
}

} // namespace rubato::domain
