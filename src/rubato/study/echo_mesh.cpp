// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/cell/topology.hpp"
#include "rubato/study/echo_json.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>

namespace rubato::study {
namespace {

Json echo(const Body& body) {
  std::string cells(cell::topology(body.cells).name);
  std::ranges::transform(cells, cells.begin(), [](unsigned char letter) { return std::tolower(letter); });
  Json map{{"name", body.name}};
  map[body.dimension == 3 ? "box" : "rectangle"] = {{"from", first(body.from, body.dimension)},
                                                    {"to", first(body.to, body.dimension)}};
  map["divisions"] = std::vector<int>(body.divisions.begin(), body.divisions.begin() + body.dimension);
  map["cells"] = cells;
  map["sides"] = body.sides;
  if (body.dimension == 3)
    map["edges"] = body.edges;
  map["points"] = body.points;
  return map;
}

/// What the kind takes below its word.
Json shape_of(const MadeGroup& group, int dimension) {
  switch (group.kind) {
  case GroupKind::box:
    return {{"from", first(group.from, dimension)}, {"to", first(group.to, dimension)}};
  case GroupKind::sphere:
    return {{"point", first(group.point, dimension)}, {"radius", group.radius}};
  case GroupKind::cylinder:
    return {{"point", first(group.point, dimension)},
            {"axis", first(group.direction, dimension)},
            {"radius", group.radius}};
  case GroupKind::plane:
    return {{"point", first(group.point, dimension)}, {"normal", first(group.direction, dimension)}};
  case GroupKind::normal:
  case GroupKind::along:
    return first(group.direction, dimension);
  default:
    return entry_of(group.kind).sources == GroupSources::list ? Json(group.of) : Json(group.of.front());
  }
}

Json echo(const MadeGroup& group, int dimension) {
  const auto& entry = entry_of(group.kind);
  Json map{{std::string(entry.name), shape_of(group, dimension)}};
  const bool beside = entry.sources == GroupSources::of || entry.sources == GroupSources::any_of;
  if (beside && !group.of.empty())
    map["of"] = group.of.front();
  put_optional(map, "within", group.within);
  if (entry.angle)
    map["angle"] = group.angle;
  if (entry.take)
    map["take"] = word(group_take_words, group.take);
  return map;
}

} // namespace

Json echo(const MeshSource& mesh, int dimension) {
  auto map = Json::object();
  if (mesh.bodies.empty()) {
    map["file"] = mesh.file;
    if (!mesh.file_mesh.empty())
      map["name"] = mesh.file_mesh;
  }
  for (const auto& body : mesh.bodies)
    map["generate"].push_back(echo(body));
  map["convert"] = word(conversion_words, mesh.convert);
  map["refine"] = mesh.refine;
  for (const auto& group : mesh.groups)
    map["groups"][group.name] = echo(group, dimension);
  return map;
}

} // namespace rubato::study
