// SPDX-License-Identifier: LGPL-3.0-or-later
/// The study whose model has what vibrations are made of.
#pragma once

#include "rubato/study/study.hpp"

namespace rubato::modes {

/// The study with consistent masses, whatever its scheme, and without what modes do not depend on: loads, how
/// bodies begin, probes, checks, laws of contact. Throws InputError, with its path, for each material without
/// a density.
study::Study modal_study(const study::Study& asked);

} // namespace rubato::modes
