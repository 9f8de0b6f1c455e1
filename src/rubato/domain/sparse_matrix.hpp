// SPDX-License-Identifier: LGPL-3.0-or-later
/// The sparse matrices of the whole.
#pragma once

#include "rubato/linalg/sparse_matrix.hpp"

namespace rubato::domain {

using linalg::SparseMatrix;

} // namespace rubato::domain
