// SPDX-License-Identifier: LGPL-3.0-or-later
/// A part of the program as a process of its own: what breaks in it, or takes its memory, leaves the others
/// alone, and libraries that know no threads have a process each.
#pragma once

#include <functional>
#include <sys/types.h>

namespace rubato::app {

/// A file descriptor that is closed when this goes.
class Descriptor {
public:
  Descriptor() = default;
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() { close(); }
  Descriptor(Descriptor&& other) noexcept;
  Descriptor& operator=(Descriptor&& other) noexcept;
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int number() const { return number_; } ///< −1: none
  void close();

private:
  int number_ = -1;
};

/// How a process ended.
struct ProcessEnd {
  int code = 0;
  int signal = 0; ///< that killed it; 0: none
};

/// Both must be made before this program has a second thread. The process is a fork of this one; when this
/// program ends before it, it gets a SIGTERM.
class ChildProcess {
public:
  /// `work` is done in the process, with its end of a channel for messages, a socket that keeps their bounds;
  /// its value is the exit code. What it prints comes out of `out` and `err`. Throws std::system_error where
  /// there can be no process.
  explicit ChildProcess(const std::function<int(int channel)>& work);
  /// Kills it if it still runs.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  pid_t id() const { return id_; }
  Descriptor& out() { return out_; }
  Descriptor& err() { return err_; }
  Descriptor& channel() { return channel_; }

  void send(int signal) const;
  ProcessEnd wait();

private:
  pid_t id_ = -1;
  Descriptor out_, err_, channel_;
};

/// Does `work` in a process with the streams of this one, and waits for its end.
ProcessEnd in_a_process(const std::function<int()>& work);

/// Of a process that `work` is done in: whether the program that started it has ended. What is printed from
/// then on gets lost.
bool is_left_alone(pid_t starter);

} // namespace rubato::app
