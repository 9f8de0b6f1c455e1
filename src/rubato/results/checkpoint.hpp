// SPDX-License-Identifier: LGPL-3.0-or-later
/// Everything a run needs to go on bit for bit, in one file.
///
/// checkpoint.h5 begins with 512 bytes that HDF5 skips: text with the number of the format, and the size and
/// the CRC-32 of all that follows. A file is judged by them before HDF5 sees it. It is written beside and
/// then renamed, so that there is always a whole one.
#pragma once

#include "rubato/results/recorder.hpp"
#include "rubato/step/energy.hpp"
#include "rubato/step/explicit.hpp"
#include "rubato/step/state.hpp"
#include "rubato/time/step_control.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace rubato::results {

/// What only explicit runs carry.
struct ExplicitProgress {
  step::ExplicitMotion::Memory motion;
  double limit = 0; ///< of the step, which never grows
};

struct Checkpoint {
  std::string study;       ///< its echo
  std::uint32_t mesh = 0;  ///< fingerprint of the mesh
  std::uint32_t start = 0; ///< fingerprint of the other run's end that this one began with, or 0
  Ending spent;            ///< so far; status and reason mean nothing
  step::State state;       ///< of the last step that counts
  time::StepControl::Place place;
  step::EnergyLedger energy;
  step::Overlaps overlaps; ///< of the energy account
  step::EnergyRecord record;
  RecorderPosition recorder;
  std::optional<ExplicitProgress> progress;
};

/// Throws WriteError when writing fails; what was there before is still there then.
void write_checkpoint(const std::filesystem::path& path, Checkpoint checkpoint);

/// Throws InputError, with the reason in one sentence, for a file that is no checkpoint, of another format,
/// truncated or damaged.
Checkpoint read_checkpoint(const std::filesystem::path& path);

/// CRC-32 of a mesh: coordinates, cells and groups.
std::uint32_t fingerprint(const mesh::Mesh& mesh);
/// CRC-32 of the motion of a state.
std::uint32_t fingerprint(const step::State& state);

} // namespace rubato::results
