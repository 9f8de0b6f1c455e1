// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/deck/body_words.hpp"
#include "rubato/deck/parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace rubato::deck {
namespace {

void read_names_by_place(const Found& value, const std::vector<std::string>& words,
                         std::map<std::string, std::string>& groups) {
  if (!value)
    return;
  MapReader map(*value);
  for (const auto& word : words) {
    std::string name;
    if (read_name(map.find(word), name))
      groups[word] = std::move(name);
  }
  map.finish();
}

void read_cells(const Found& value, study::Body& body) {
  const auto types = cells_of(body.dimension);
  if (const auto choice = read_choice(value, cell_words(body.dimension)))
    body.cells = types[*choice];
}

/// A list with one number for each axis.
template <class T, class U> void read_per_axis(const Found& value, int dimension, std::array<U, 3>& target) {
  std::vector<T> numbers;
  if (!read(value, numbers))
    return;
  if (numbers.size() != static_cast<std::size_t>(dimension)) {
    value->fault(fmt::format("found {} numbers, expected {}", numbers.size(), dimension));
    return;
  }
  std::ranges::copy(numbers, target.begin());
}

void read_extent(const Found& value, study::Body& body) {
  if (!value)
    return;
  MapReader map(*value);
  read_per_axis<double>(map.require("from"), body.dimension, body.from);
  read_per_axis<double>(map.require("to"), body.dimension, body.to);
  map.finish();
}

/// The box or the rectangle of a body, and with it the body's dimension; nothing when it has neither or both.
Found find_shape(MapReader& map, study::Body& body) {
  auto box = map.find("box");
  auto rectangle = map.find("rectangle");
  if (!map.is_map() || box.has_value() != rectangle.has_value()) {
    body.dimension = rectangle ? 2 : 3;
    return rectangle ? rectangle : box;
  }
  map.value().fault(box ? "found both 'box' and 'rectangle', expected one of them"
                        : "'box' or 'rectangle' is missing");
  return std::nullopt;
}

study::Body read_body(const Value& value) {
  study::Body body;
  MapReader map(value);
  read(map.require("name"), body.name);
  const auto shape = find_shape(map, body);
  body.cells = body.dimension == 3 ? CellType::hexa8 : CellType::quad4;
  const auto parts = {"divisions", "cells", "sides", "edges", "points"};
  if (!shape) {
    for (const auto* part : parts)
      map.find(part);
    map.finish();
    return body;
  }
  read_extent(shape, body);
  read_per_axis<int>(map.require("divisions"), body.dimension, body.divisions);
  read_cells(map.find("cells"), body);
  read_names_by_place(map.find("sides"), side_words(body.dimension), body.sides);
  if (body.dimension == 3)
    read_names_by_place(map.find("edges"), pair_words(body.dimension), body.edges);
  else
    map.refuse("edges", "the edges of a rectangle are its sides");
  read_names_by_place(map.find("points"), corner_words(body.dimension), body.points);
  map.finish();
  return body;
}

} // namespace

void read_bodies(const Found& value, std::vector<study::Body>& bodies) {
  for (const auto& item : items(value))
    bodies.push_back(read_body(item));
  if (value && value->tree().is(Tree::Kind::list) && bodies.empty())
    value->fault("found an empty list, expected at least one body");
}

void read_mesh(const Found& value, const Context& context, study::MeshSource& mesh) {
  if (!value)
    return;
  MapReader map(*value);
  const auto file = map.find("file");
  const auto generate = map.find("generate");
  if (map.is_map() && file.has_value() == generate.has_value())
    value->fault(file ? "found both 'file' and 'generate', expected one of them"
                      : "'file' or 'generate' is missing");
  if (read_name(file, mesh.file) && !file->tree().from_setting)
    mesh.file = (context.folder / mesh.file).string();
  if (file)
    read(map.find("name"), mesh.file_mesh);
  else
    map.refuse("name", "only a mesh from a file has a name");
  read_bodies(generate, mesh.bodies);
  read(map.find("convert"), mesh.convert, study::conversion_words);
  read(map.find("refine"), mesh.refine);
  read_groups(map.find("groups"), context, mesh.groups);
  map.finish();
}

} // namespace rubato::deck
