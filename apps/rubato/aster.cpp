// SPDX-License-Identifier: LGPL-3.0-or-later
// Code_Aster studies are read by the Python package rubato.aster; this starts it.
#include "rubato/core/error.hpp"

#include <fmt/format.h>

#include "commands.hpp"
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <unistd.h>

namespace rubato::app {
namespace {

namespace fs = std::filesystem;

/// Where the module stands beside the program, in a folder of builds and installed.
constexpr std::array module_folders{"python", "../lib/python3/dist-packages"};
/// The interpreter that the module is made for: that of the system.
constexpr auto interpreter = "/usr/bin/python3";

fs::path module_folder() {
  const auto program = fs::read_symlink("/proc/self/exe").parent_path();
  for (const auto* folder : module_folders)
    if (fs::exists(program / folder / "rubato" / "aster"))
      return (program / folder).lexically_normal();
  throw InputError("this rubato has no Python module, which reads command files: build with "
                   "-DRUBATO_PYTHON=ON where pybind11-dev, python3-dev and python3-numpy are installed");
}

void add(std::vector<std::string>& words, const char* option, const std::string& value) {
  if (!value.empty())
    words.insert(words.end(), {option, value});
}

std::vector<std::string> words_of(const AsterArguments& arguments) {
  std::vector<std::string> words{interpreter, "-m", "rubato.aster", arguments.study.string()};
  add(words, "--output", arguments.output.string());
  add(words, "--time", arguments.time);
  add(words, "--memory", arguments.memory);
  add(words, "--regression-tolerance", arguments.regression_tolerance);
  for (const auto& file : arguments.files)
    add(words, "--file", file);
  if (arguments.check)
    words.emplace_back("--check");
  return words;
}

/// The module's folder comes first, what the user has of his own after it.
void set_module_path(const fs::path& folder) {
  const auto* before = std::getenv("PYTHONPATH");
  const auto path = before == nullptr ? folder.string() : fmt::format("{}:{}", folder.string(), before);
  setenv("PYTHONPATH", path.c_str(), 1);
}

} // namespace

int aster(const AsterArguments& arguments) {
  set_module_path(module_folder());
  auto words = words_of(arguments);
  std::vector<char*> pointers;
  pointers.reserve(words.size() + 1);
  for (auto& word : words)
    pointers.push_back(word.data());
  pointers.push_back(nullptr);
  execv(interpreter, pointers.data());
  throw InputError(fmt::format("{} cannot be started: {}", interpreter, std::strerror(errno)));
}

} // namespace rubato::app
