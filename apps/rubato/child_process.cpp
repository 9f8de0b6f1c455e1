// SPDX-License-Identifier: LGPL-3.0-or-later
#include "child_process.hpp"

#include "failures.hpp"
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace rubato::app {
namespace {

struct Ends {
  Descriptor read, write;
};

[[noreturn]] void fail(const char* what) {
  throw std::system_error(errno, std::generic_category(), what);
}

Ends pipe_ends() {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0)
    fail("no pipe to a run");
  return {Descriptor(ends[0]), Descriptor(ends[1])};
}

Ends channel_ends() {
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0)
    fail("no channel to a run");
  return {Descriptor(ends[0]), Descriptor(ends[1])};
}

pid_t forked() {
  std::fflush(nullptr); // what is not written yet would be written twice
  const auto starter = getpid();
  const auto id = fork();
  if (id < 0)
    fail("no process for a run");
  if (id == 0) {
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (getppid() != starter)
      raise(SIGTERM);
  }
  return id;
}

ProcessEnd end_of(pid_t id) {
  int status = 0;
  while (waitpid(id, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? ProcessEnd{WEXITSTATUS(status), 0} : ProcessEnd{0, WTERMSIG(status)};
}

} // namespace

Descriptor::Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  std::swap(number_, other.number_);
  return *this;
}

void Descriptor::close() {
  if (number_ >= 0)
    ::close(number_);
  number_ = -1;
}

ChildProcess::ChildProcess(const std::function<int(int)>& work) {
  auto out = pipe_ends();
  auto err = pipe_ends();
  auto channel = channel_ends();
  id_ = forked();
  if (id_ == 0) {
    // The ends to read stay open here, too: without a reader, printing would kill the process.
    dup2(out.write.number(), STDOUT_FILENO);
    dup2(err.write.number(), STDERR_FILENO);
    out.write.close();
    err.write.close();
    channel.read.close();
    leave(reported([&] { return work(channel.write.number()); }));
  }
  out_ = std::move(out.read);
  err_ = std::move(err.read);
  channel_ = std::move(channel.read);
}

ChildProcess::~ChildProcess() {
  if (id_ <= 0)
    return;
  send(SIGKILL);
  wait();
}

void ChildProcess::send(int signal) const {
  if (id_ > 0)
    kill(id_, signal);
}

ProcessEnd ChildProcess::wait() {
  return end_of(std::exchange(id_, -1));
}

ProcessEnd in_a_process(const std::function<int()>& work) {
  const auto id = forked();
  if (id == 0)
    leave(reported(work));
  return end_of(id);
}

bool is_left_alone(pid_t starter) {
  if (getppid() == starter)
    return false;
  const Descriptor nowhere(open("/dev/null", O_WRONLY | O_CLOEXEC));
  dup2(nowhere.number(), STDOUT_FILENO);
  dup2(nowhere.number(), STDERR_FILENO);
  return true;
}

} // namespace rubato::app
