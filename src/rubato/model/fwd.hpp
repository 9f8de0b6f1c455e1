// SPDX-License-Identifier: LGPL-3.0-or-later
/// Declares the model for headers that only refer to it: most sources depend on few of its parts.
#pragma once

namespace rubato::model {

struct Model;

} // namespace rubato::model
