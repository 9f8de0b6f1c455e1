// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/io/gmsh_library.hpp"

#include "rubato/error.hpp"

#include <fmt/format.h>
#include <gmshc.h>

#include <dlfcn.h>
#include <stdexcept>
#include <string_view>
#include <type_traits>
#include <utility>

namespace rubato::mesh::gmsh {

struct Calls {
  decltype(&gmshInitialize) initialize;
  decltype(&gmshFinalize) finalize;
  decltype(&gmshFree) free;
  decltype(&gmshOptionSetNumber) set_option;
  decltype(&gmshLoggerStart) start_log;
  decltype(&gmshLoggerStop) stop_log;
  decltype(&gmshLoggerGet) log;
  decltype(&gmshLoggerGetLastError) last_error;
  decltype(&gmshOpen) open;
  decltype(&gmshModelMeshGenerate) generate;
  decltype(&gmshModelGetEntities) entities;
  decltype(&gmshModelGetPhysicalGroups) physical_groups;
  decltype(&gmshModelGetPhysicalName) physical_name;
  decltype(&gmshModelGetEntitiesForPhysicalGroup) entities_of_group;
  decltype(&gmshModelMeshGetElements) elements;
  decltype(&gmshModelMeshGetNodes) nodes;
  decltype(&gmshModelMeshGetElementProperties) element_properties;
};

namespace {

[[noreturn]] void refuse_library() {
  throw InputError(
      fmt::format("its library cannot be loaded ({}); install it or convert the mesh to MED", dlerror()));
}

template <class Function> void find(void* library, const char* name, Function*& function) {
  function = reinterpret_cast<Function*>(dlsym(library, name));
  if (function == nullptr)
    refuse_library();
}

Calls calls_of(void* library) {
  Calls calls{};
  find(library, "gmshInitialize", calls.initialize);
  find(library, "gmshFinalize", calls.finalize);
  find(library, "gmshFree", calls.free);
  find(library, "gmshOptionSetNumber", calls.set_option);
  find(library, "gmshLoggerStart", calls.start_log);
  find(library, "gmshLoggerStop", calls.stop_log);
  find(library, "gmshLoggerGet", calls.log);
  find(library, "gmshLoggerGetLastError", calls.last_error);
  find(library, "gmshOpen", calls.open);
  find(library, "gmshModelMeshGenerate", calls.generate);
  find(library, "gmshModelGetEntities", calls.entities);
  find(library, "gmshModelGetPhysicalGroups", calls.physical_groups);
  find(library, "gmshModelGetPhysicalName", calls.physical_name);
  find(library, "gmshModelGetEntitiesForPhysicalGroup", calls.entities_of_group);
  find(library, "gmshModelMeshGetElements", calls.elements);
  find(library, "gmshModelMeshGetNodes", calls.nodes);
  find(library, "gmshModelMeshGetElementProperties", calls.element_properties);
  return calls;
}

/// What Gmsh hands out, with its size; given back when it goes.
template <class T> struct Handed {
  explicit Handed(const Calls& calls) : calls_(calls) {}
  ~Handed() { calls_.free(data); }
  Handed(const Handed&) = delete;
  Handed& operator=(const Handed&) = delete;

  std::vector<T> copy() const { return {data, data + size}; }

  T* data = nullptr;
  std::size_t size = 0;

private:
  const Calls& calls_;
};

/// The same for a list of lists.
template <class T> struct HandedLists {
  explicit HandedLists(const Calls& calls) : lists(calls), sizes(calls), calls_(calls) {}
  ~HandedLists() {
    for (std::size_t i = 0; i < lists.size; ++i)
      calls_.free(lists.data[i]);
  }
  HandedLists(const HandedLists&) = delete;
  HandedLists& operator=(const HandedLists&) = delete;

  std::vector<std::vector<T>> copy() const {
    std::vector<std::vector<T>> copied;
    for (std::size_t i = 0; i < lists.size; ++i)
      copied.emplace_back(lists.data[i], lists.data[i] + sizes.data[i]);
    return copied;
  }

  Handed<T*> lists;
  Handed<std::size_t> sizes; ///< of each list

private:
  const Calls& calls_;
};

std::string text_of(const Handed<char>& text) {
  return text.data == nullptr ? "" : text.data;
}

std::vector<Entity> entities_in(const Handed<int>& pairs) {
  std::vector<Entity> entities;
  for (std::size_t i = 0; i + 1 < pairs.size; i += 2)
    entities.push_back({pairs.data[i], pairs.data[i + 1]});
  return entities;
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
  // Never unloaded: libraries it brings keep what cannot be taken down before the program's end.
  static const Calls calls = [] {
    void* handle = dlopen(RUBATO_GMSH_LIBRARY, RTLD_LAZY | RTLD_LOCAL);
    if (handle == nullptr)
      refuse_library();
    return calls_of(handle);
  }();
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

std::vector<Entity> Session::entities() const {
  Handed<int> pairs(calls_);
  ask(calls_, calls_.entities, &pairs.data, &pairs.size, -1);
  return entities_in(pairs);
}

std::vector<Entity> Session::physical_groups() const {
  Handed<int> pairs(calls_);
  ask(calls_, calls_.physical_groups, &pairs.data, &pairs.size, -1);
  return entities_in(pairs);
}

std::string Session::name_of(Entity physical_group) const {
  Handed<char> name(calls_);
  ask(calls_, calls_.physical_name, physical_group.dimension, physical_group.tag, &name.data);
  return text_of(name);
}

std::vector<int> Session::entities_of(Entity physical_group) const {
  Handed<int> tags(calls_);
  ask(calls_, calls_.entities_of_group, physical_group.dimension, physical_group.tag, &tags.data, &tags.size);
  return tags.copy();
}

Elements Session::elements_of(Entity entity) const {
  Handed<int> types(calls_);
  HandedLists<Tag> cells(calls_);
  HandedLists<Tag> nodes(calls_);
  ask(calls_, calls_.elements, &types.data, &types.size, &cells.lists.data, &cells.sizes.data,
      &cells.lists.size, &nodes.lists.data, &nodes.sizes.data, &nodes.lists.size, entity.dimension,
      entity.tag);
  return {types.copy(), cells.copy(), nodes.copy()};
}

Nodes Session::nodes_of(Entity entity) const {
  constexpr int without_boundary = 0;
  constexpr int without_parameters = 0;
  Handed<Tag> tags(calls_);
  Handed<double> coordinates(calls_);
  Handed<double> parameters(calls_);
  ask(calls_, calls_.nodes, &tags.data, &tags.size, &coordinates.data, &coordinates.size, &parameters.data,
      &parameters.size, entity.dimension, entity.tag, without_boundary, without_parameters);
  return {tags.copy(), coordinates.copy()};
}

std::string Session::name_of_type(int element_type) const {
  Handed<char> name(calls_);
  Handed<double> coordinates(calls_);
  int dimension = 0;
  int order = 0;
  int nodes = 0;
  int corners = 0;
  ask(calls_, calls_.element_properties, element_type, &name.data, &dimension, &order, &nodes,
      &coordinates.data, &coordinates.size, &corners);
  return text_of(name);
}

} // namespace rubato::mesh::gmsh
