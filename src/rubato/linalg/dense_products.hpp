// SPDX-License-Identifier: LGPL-3.0-or-later
/// Products of dense matrices of any size, compiled once: each source that instantiates Eigen's takes seconds
/// more.
#pragma once

#include <Eigen/Core>

namespace rubato::linalg {

/// A B
Eigen::MatrixXd product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);
/// AᵀB
Eigen::MatrixXd transposed_product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);
/// A x
Eigen::VectorXd product(const Eigen::MatrixXd& a, const Eigen::VectorXd& x);
/// Aᵀx
Eigen::VectorXd transposed_product(const Eigen::MatrixXd& a, const Eigen::VectorXd& x);
/// y += A x
void add_product(const Eigen::MatrixXd& a, const Eigen::VectorXd& x, Eigen::VectorXd& y);

/// to += factor · values
void add_scaled(double factor, const Eigen::VectorXd& values, Eigen::VectorXd& to);

/// A += factor · v vᵀ, A with a row for each entry of v.
void add_square(double factor, const Eigen::VectorXd& v, Eigen::MatrixXd& a);

/// The largest magnitude, 0 of no numbers.
double largest_magnitude(const Eigen::VectorXd& values);
double largest_magnitude(const Eigen::MatrixXd& values);

} // namespace rubato::linalg
