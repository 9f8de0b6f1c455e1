// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/deck/groups.hpp"
#include "rubato/mesh/io/mesh_file.hpp"
#include "rubato/mesh/made_groups.hpp"
#include "rubato/model/build_model.hpp"
#include "rubato/model/model.hpp"

#include <fmt/format.h>

#include "commands.hpp"
#include "read_deck.hpp"
#include <map>
#include <utility>

namespace rubato::app {
namespace {

bool is_deck(const std::filesystem::path& path) {
  return is_standard_input(path) || path.extension() == ".yaml" || path.extension() == ".yml";
}

study::MeshConversion conversion_named(const std::string& name) {
  static const std::map<std::string, study::MeshConversion> words{
      {"", study::MeshConversion::none},
      {"none", study::MeshConversion::none},
      {"linear", study::MeshConversion::linear},
      {"quadratic", study::MeshConversion::quadratic},
      {"full_quadratic", study::MeshConversion::full_quadratic}};
  const auto found = words.find(name);
  if (found == words.end())
    throw InputError(
        fmt::format("--convert: found '{}', expected linear, quadratic or full_quadratic", name));
  return found->second;
}

struct Source {
  study::MeshSource mesh;
  deck::Places places; ///< none when it is no deck
};

/// The mesh a deck's first run works on, or the one in a file; then what the command line asks for.
Source source_of(const MeshArguments& arguments) {
  Source found;
  auto& source = found.mesh;
  if (is_deck(arguments.source)) {
    const auto deck = read_deck(arguments.source, arguments.settings);
    source = deck.runs.front().mesh;
    found.places = deck.places.front();
  } else {
    if (!arguments.settings.empty())
      throw InputError("--set changes a deck, but the source is a mesh file");
    source.file = arguments.source.string();
  }
  if (!arguments.convert.empty())
    source.convert = conversion_named(arguments.convert);
  if (arguments.refine < 1)
    throw InputError(fmt::format("--refine: found {}, expected 1 or more", arguments.refine));
  if (arguments.refine > 1)
    source.refine = arguments.refine;
  return found;
}

/// The mesh with groups that the command line makes, of the deck's too.
rubato::mesh::Mesh with_groups(rubato::mesh::Mesh mesh, const std::vector<std::string>& options) {
  const auto groups = deck::parse_groups(options, mesh.dimension);
  try {
    return rubato::mesh::with_groups(std::move(mesh), groups);
  } catch (const InputError& error) {
    auto faults = error.faults();
    for (auto& fault : faults)
      fault.at.file = "--group";
    throw InputError(std::move(faults));
  }
}

rubato::mesh::Mesh load(const Source& source) {
  try {
    return model::load_mesh(source.mesh);
  } catch (const InputError& error) {
    throw source.places.located(error);
  }
}

} // namespace

int mesh(const MeshArguments& arguments) {
  const auto mesh = with_groups(load(source_of(arguments)), arguments.groups);
  rubato::mesh::write_mesh(arguments.output, mesh);
  fmt::print("{}: {} nodes, {} cells, {} groups\n", arguments.output.string(), mesh.node_count(),
             mesh.cell_count(), rubato::mesh::group_names(mesh).size());
  return done;
}

} // namespace rubato::app
