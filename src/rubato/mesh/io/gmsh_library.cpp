// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/io/gmsh_library.hpp"

#include "rubato/core/dynamic_library.hpp"

#include <fmt/format.h>
#include <gmshc.h>

#include <stdexcept>
#include <string_view>
#include <type_traits>

namespace rubato::mesh::gmsh {

struct Calls {
  DynamicLibrary library;
  decltype(&gmshInitialize) initialize = library.symbol("gmshInitialize");
  decltype(&gmshFinalize) finalize = library.symbol("gmshFinalize");
  decltype(&gmshFree) free = library.symbol("gmshFree");
  decltype(&gmshOptionSetNumber) set_option = library.symbol("gmshOptionSetNumber");
  decltype(&gmshLoggerStart) start_log = library.symbol("gmshLoggerStart");
  decltype(&gmshLoggerStop) stop_log = library.symbol("gmshLoggerStop");
  decltype(&gmshLoggerGet) log = library.symbol("gmshLoggerGet");
  decltype(&gmshLoggerGetLastError) last_error = library.symbol("gmshLoggerGetLastError");
  decltype(&gmshOpen) open = library.symbol("gmshOpen");
  decltype(&gmshModelMeshGenerate) generate = library.symbol("gmshModelMeshGenerate");
  decltype(&gmshModelGetDimension) dimension = library.symbol("gmshModelGetDimension");
  decltype(&gmshModelMeshGetElementTypes) types = library.symbol("gmshModelMeshGetElementTypes");
  decltype(&gmshWrite) write = library.symbol("gmshWrite");
};

namespace {

/// What Gmsh hands out, with its size; given back when it goes.
template <class T> struct Handed {
  explicit Handed(const Calls& calls) : calls_(calls) {}
  ~Handed() { calls_.free(data); }
  Handed(const Handed&) = delete;
  Handed& operator=(const Handed&) = delete;

  T* data = nullptr;
  std::size_t size = 0;

private:
  const Calls& calls_;
};

/// The same for a list of lists.
template <class T> struct HandedLists {
  explicit HandedLists(const Calls& calls) : lists(calls), calls_(calls) {}
  ~HandedLists() {
    for (std::size_t i = 0; i < lists.size; ++i)
      calls_.free(lists.data[i]);
  }
  HandedLists(const HandedLists&) = delete;
  HandedLists& operator=(const HandedLists&) = delete;

  Handed<T*> lists;

private:
  const Calls& calls_;
};

std::string text_of(const Handed<char>& text) {
  return text.data == nullptr ? "" : text.data;
}

/// Makes one call; its last argument is Gmsh's error number.
template <class Call, class... Arguments> void ask(const Calls& calls, Call* call, Arguments... arguments) {
  int error = 0;
  call(arguments..., &error);
  if (error == 0)
    return;
  Handed<char> reason(calls);
  int ignored = 0;
  calls.last_error(&reason.data, &ignored);
  const auto text = text_of(reason);
  throw std::runtime_error(text.empty() ? fmt::format("error {}", error) : text);
}

/// Version 4.10 put an argument before the last: whether to run Gmsh's own program.
template <class Initialize> void initialize(const Calls& calls, Initialize* call) {
  constexpr int read_user_options = 0;
  if constexpr (std::is_invocable_v<Initialize*, int, char**, int, int, int*>)
    ask(calls, call, 0, static_cast<char**>(nullptr), read_user_options, 0);
  else
    ask(calls, call, 0, static_cast<char**>(nullptr), read_user_options);
}

} // namespace

const Calls& library() {
  static const Calls calls{DynamicLibrary({.soname = RUBATO_GMSH_LIBRARY,
                                           .package = RUBATO_GMSH_PACKAGE,
                                           .users = "geometries",
                                           .otherwise = " or convert the mesh to MED"})};
  return calls;
}

Session::Session() : calls_(library()) {
  initialize(calls_, calls_.initialize);
  ask(calls_, calls_.set_option, "General.Terminal", 0.0);
  ask(calls_, calls_.set_option, "General.NumThreads", 1.0);
  ask(calls_, calls_.start_log);
}

Session::~Session() {
  int ignored = 0;
  calls_.stop_log(&ignored);
  calls_.finalize(&ignored);
}

void Session::open(const std::filesystem::path& path) const {
  ask(calls_, calls_.open, path.c_str());
}

void Session::generate(int dimension) const {
  ask(calls_, calls_.generate, dimension);
}

std::string Session::first_error() const {
  constexpr std::string_view mark = "Error: ";
  HandedLists<char> lines(calls_);
  ask(calls_, calls_.log, &lines.lists.data, &lines.lists.size);
  for (std::size_t i = 0; i < lines.lists.size; ++i)
    if (const std::string_view line = lines.lists.data[i]; line.starts_with(mark))
      return std::string(line.substr(mark.size()));
  return "";
}

int Session::dimension() const {
  int dimension = 0;
  ask(
      calls_, +[](decltype(calls_.dimension) call, int* result, int* error) { *result = call(error); },
      calls_.dimension, &dimension);
  return dimension;
}

bool Session::is_meshed() const {
  Handed<int> types(calls_);
  constexpr int any = -1;
  ask(calls_, calls_.types, &types.data, &types.size, any, any);
  return types.size > 0;
}

void Session::write(const std::filesystem::path& path) const {
  ask(calls_, calls_.set_option, "Mesh.MshFileVersion", 4.1);
  ask(calls_, calls_.set_option, "Mesh.Binary", 1.0);
  ask(calls_, calls_.write, path.c_str());
}

} // namespace rubato::mesh::gmsh
