// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/core/channel.hpp"

#include "rubato/linalg/petsc/session.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <memory>
#include <mpi.h>
#include <stdexcept>
#include <thread>
#include <vector>

namespace rubato::linalg::petsc {
namespace {

/// What MPI counts in `int`s is sent in pieces of so many bytes.
constexpr std::size_t largest_piece = std::size_t{1} << 30U;

enum class Call : std::int64_t { broadcast, gather, add_up };

class MpiChannel final : public Channel {
public:
  MpiChannel() {
    MPI_Comm_dup(MPI_COMM_WORLD, &all_);
    MPI_Comm_rank(all_, &index_);
    MPI_Comm_size(all_, &count_);
    MPI_Comm here = MPI_COMM_NULL;
    MPI_Comm_split_type(all_, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &here);
    MPI_Comm_size(here, &count_here_);
    MPI_Comm_free(&here);
  }

  int index() const override { return index_; }
  int count() const override { return count_; }
  int count_here() const override { return count_here_; }
  std::uint64_t bytes_sent() const override { return sent_; }

  void broadcast(std::span<std::byte> data) override {
    meet(Call::broadcast, data.size());
    for (std::size_t first = 0; first < data.size(); first += largest_piece) {
      const auto piece = data.subspan(first, std::min(largest_piece, data.size() - first));
      MPI_Bcast(piece.data(), static_cast<int>(piece.size()), MPI_BYTE, 0, all_);
    }
    if (index_ == 0)
      sent_ += data.size();
  }

  void gather(std::span<const std::byte> own, std::span<std::byte> all) override {
    meet(Call::gather, own.size());
    if (own.size() > largest_piece || all.size() != own.size() * static_cast<std::size_t>(count_))
      throw std::invalid_argument("gather wants room for what all ranks give, a gigabyte each at most");
    const int size = static_cast<int>(own.size());
    MPI_Allgather(own.data(), size, MPI_BYTE, all.data(), size, MPI_BYTE, all_);
    sent_ += own.size();
  }

  void add_up(std::span<double> values) override {
    meet(Call::add_up, values.size());
    constexpr std::size_t piece = largest_piece / sizeof(double);
    for (std::size_t first = 0; first < values.size(); first += piece) {
      const auto part = values.subspan(first, std::min(piece, values.size() - first));
      MPI_Allreduce(MPI_IN_PLACE, part.data(), static_cast<int>(part.size()), MPI_DOUBLE, MPI_SUM, all_);
    }
    sent_ += values.size_bytes();
  }

  void exchange(std::span<Parcel> parcels) override {
    requests_.clear();
    for (auto& parcel : parcels)
      MPI_Irecv(parcel.received.data(), static_cast<int>(parcel.received.size()), MPI_DOUBLE, parcel.rank, 0,
                all_, &requests_.emplace_back());
    for (const auto& parcel : parcels) {
      MPI_Isend(parcel.sent.data(), static_cast<int>(parcel.sent.size()), MPI_DOUBLE, parcel.rank, 0, all_,
                &requests_.emplace_back());
      sent_ += sizeof(double) * parcel.sent.size();
    }
    MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
  }

  bool all_leave(double seconds) override {
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Ibarrier(all_, &request);
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    for (int arrived = 0;;) {
      MPI_Test(&request, &arrived, MPI_STATUS_IGNORE);
      if (arrived != 0)
        return true;
      if (std::chrono::steady_clock::now() > end)
        return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }

  void abort(int code) override {
    MPI_Abort(all_, code);
    std::abort();
  }

private:
  /// Ranks that went different ways would wait for one another for ever, or take what is not theirs.
  void meet(Call call, std::size_t size) {
    ++calls_;
    const auto what = (calls_ << 2) + static_cast<std::int64_t>(call);
    std::array<std::int64_t, 4> largest{what, -what, static_cast<std::int64_t>(size),
                                        -static_cast<std::int64_t>(size)};
    MPI_Allreduce(MPI_IN_PLACE, largest.data(), static_cast<int>(largest.size()), MPI_INT64_T, MPI_MAX, all_);
    if (largest[0] != -largest[1] || largest[2] != -largest[3])
      throw std::runtime_error(
          "ranks went different ways, as where their processors round differently; expected machines alike");
  }

  MPI_Comm all_ = MPI_COMM_NULL; ///< it ends with MPI
  int index_ = 0;
  int count_ = 1;
  int count_here_ = 1;
  std::int64_t calls_ = 0;
  std::uint64_t sent_ = 0;
  std::vector<MPI_Request> requests_;
};

} // namespace
} // namespace rubato::linalg::petsc

extern "C" __attribute__((visibility("default"))) void
rubato_make_channel_2(std::shared_ptr<rubato::Channel>& made) {
  rubato::linalg::petsc::start();
  made = std::make_shared<rubato::linalg::petsc::MpiChannel>();
}
