// SPDX-License-Identifier: LGPL-3.0-or-later
/// rubato as a process of its own.
#pragma once

#include "support/scratch_folder.hpp"
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace rubato::test {

inline std::string text_of(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

inline void write_text(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

struct Outcome {
  int exit_code = -1; ///< −signal when one killed it
  std::string out;
  std::string err;
};

/// What the system allows a program; 0: whatever it allows.
struct Limits {
  rlim_t file_size = 0; ///< bytes of each file
  rlim_t memory = 0;    ///< bytes of address space
};

/// The running program. Whatever is still running when it goes is killed.
class Program {
public:
  /// `folder` is the program's current folder. `file` is the program, rubato of the build by default.
  Program(const std::vector<std::string>& arguments, const std::filesystem::path& folder, Limits limits = {},
          const std::string& file = RUBATO_PROGRAM) {
    write_text(streams_ / "known_leaks", "leak:hdf5\n");
    id_ = fork();
    if (id_ < 0)
      throw std::runtime_error("no process");
    if (id_ == 0) {
      limit(RLIMIT_FSIZE, limits.file_size);
      limit(RLIMIT_AS, limits.memory);
      become(file, arguments, folder);
    }
  }
  ~Program() {
    if (id_ > 0) {
      kill(id_, SIGKILL);
      waitpid(id_, nullptr, 0);
    }
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  void send(int signal) const { kill(id_, signal); }

  bool is_running() const {
    siginfo_t info{};
    return waitid(P_PID, static_cast<id_t>(id_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid == 0;
  }

  Outcome wait() {
    int status = 0;
    waitpid(id_, &status, 0);
    id_ = -1;
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status), text_of(streams_ / "out"),
            text_of(streams_ / "err")};
  }

private:
  [[noreturn]] void become(const std::string& file, const std::vector<std::string>& arguments,
                           const std::filesystem::path& folder) const {
    redirect(STDOUT_FILENO, streams_ / "out");
    redirect(STDERR_FILENO, streams_ / "err");
    // HDF5 doesn't give everything back after a file it refused; a program with the leak sanitizer would
    // tell.
    setenv("LSAN_OPTIONS",
           ("print_suppressions=0:suppressions=" + (streams_ / "known_leaks").string()).c_str(), 1);
    std::vector<std::string> words{file};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> pointers;
    for (auto& word : words)
      pointers.push_back(word.data());
    pointers.push_back(nullptr);
    if (chdir(folder.c_str()) == 0)
      execv(file.c_str(), pointers.data());
    _exit(127);
  }

  static void limit(int resource, rlim_t bytes) {
    const rlimit allowed{bytes, bytes};
    if (bytes > 0)
      setrlimit(static_cast<__rlimit_resource>(resource), &allowed);
  }

  static void redirect(int stream, const std::filesystem::path& path) {
    const int file = open(path.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0600);
    dup2(file, stream);
    close(file);
  }

  ScratchFolder streams_;
  pid_t id_ = -1;
};

/// Waits until some steps are written into the file of a run's steps. False when the program ended before.
inline bool wait_for_steps(const Program& program, const std::filesystem::path& steps) {
  const auto is_written = [&] {
    return std::filesystem::exists(steps) && std::filesystem::file_size(steps) > 500;
  };
  while (program.is_running() && !is_written())
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  return program.is_running();
}

inline Outcome run_program(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                           Limits limits = {}) {
  return Program(arguments, folder, limits).wait();
}

} // namespace rubato::test
