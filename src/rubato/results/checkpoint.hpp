// SPDX-License-Identifier: LGPL-3.0-or-later
/// Everything a run needs to go on bit for bit, in one file.
///
/// checkpoint.h5 begins with 512 bytes that HDF5 skips: text with the number of the format, and the size and
/// the CRC-32 of all that follows. A file is judged by them before HDF5 sees it. It is written beside and
/// then renamed, so that there is always a whole one.
#pragma once

#include "rubato/results/plausibility.hpp"
#include "rubato/results/recorder.hpp"
#include "rubato/simulation/memento.hpp"
#include "rubato/step/energy.hpp"
#include "rubato/step/state.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace rubato::results {

struct Checkpoint {
  std::string study;        ///< its echo
  std::uint32_t mesh = 0;   ///< fingerprint of the mesh
  std::uint32_t start = 0;  ///< fingerprint of the other run's end that this one began with, or 0
  double setup_seconds = 0; ///< spent so far, as loop_seconds
  double loop_seconds = 0;
  simulation::Memento memento; ///< explicit runs have no ledger in it: it is rebuilt from the motion
  step::EnergyRecord record;
  std::vector<Plausibility> plausibility; ///< so far
  RecorderPosition recorder;
};

/// Throws WriteError when writing fails; what was there before is still there then.
void write_checkpoint(const std::filesystem::path& path, Checkpoint checkpoint);

/// Throws InputError, with the reason in one sentence, for a file that is no checkpoint, of another format,
/// truncated or damaged.
Checkpoint read_checkpoint(const std::filesystem::path& path);

/// CRC-32 of a mesh: coordinates, cells and groups.
std::uint32_t fingerprint(const mesh::Mesh& mesh);
/// CRC-32 of the motion of a state and of what its materials remember.
std::uint32_t fingerprint(const step::State& state);

} // namespace rubato::results
