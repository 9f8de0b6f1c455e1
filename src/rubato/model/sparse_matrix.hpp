// SPDX-License-Identifier: LGPL-3.0-or-later
/// The sparse matrices of a model.
#pragma once

#include "rubato/linalg/sparse_matrix.hpp"

namespace rubato::model {

using linalg::SparseMatrix;

} // namespace rubato::model
