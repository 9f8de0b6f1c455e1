// SPDX-License-Identifier: LGPL-3.0-or-later
/// The head of a checkpoint file: what the file is, and a checksum of the rest of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>

namespace rubato::results {

/// Bytes in front of what is sealed; HDF5 calls this a user block.
constexpr std::size_t seal_size = 512;
/// Changes with the meaning of what a checkpoint holds.
constexpr int checkpoint_format = 7;

/// Writes the head over the first bytes of a file, and all of it through to the disk. Throws
/// WriteError when that fails.
void seal(const std::filesystem::path& path);

/// Throws InputError when a file was not sealed, is of another format, or is not as it was when it was
/// sealed.
void check_seal(const std::filesystem::path& path);

/// CRC-32 of bytes, going on from that of the bytes before them.
std::uint32_t crc(const void* bytes, std::size_t size, std::uint32_t before = 0);

} // namespace rubato::results
