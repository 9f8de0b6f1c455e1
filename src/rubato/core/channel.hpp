// SPDX-License-Identifier: LGPL-3.0-or-later
/// What ranks tell one another by (ranks.hpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rubato {

/// What goes to one other rank, and room for what comes from it.
struct Parcel {
  int rank = 0;
  std::vector<double> sent;
  std::vector<double> received;
};

/// Carries data between ranks. All calls but the first four, `exchange` and `abort` are made by all ranks,
/// in the same order and with the same sizes; they throw std::runtime_error where that is not so.
class Channel {
public:
  Channel() = default;
  Channel(const Channel&) = delete;
  Channel& operator=(const Channel&) = delete;
  virtual ~Channel() = default;

  virtual int index() const = 0;
  virtual int count() const = 0;
  virtual int count_here() const = 0;           ///< of those on this machine
  virtual std::uint64_t bytes_sent() const = 0; ///< by this rank, so far: what goes to all counts once
  /// What the first rank has goes to all.
  virtual void broadcast(std::span<std::byte> data) = 0;
  /// `all`: what each rank gives as `own`, one after the other.
  virtual void gather(std::span<const std::byte> own, std::span<std::byte> all) = 0;
  /// Σ of what the ranks have, with the same bits on all.
  virtual void add_up(std::span<double> values) = 0;
  /// Between pairs of ranks; both have a parcel for the other, what one sends as long as the other's room.
  virtual void exchange(std::span<Parcel> parcels) = 0;
  /// Whether all ranks come here within so many seconds; nothing is shared any more afterwards.
  virtual bool all_leave(double seconds) = 0;
  /// Ends all ranks at once, with this exit code.
  [[noreturn]] virtual void abort(int code) = 0;
};

} // namespace rubato
