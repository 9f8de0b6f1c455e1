// SPDX-License-Identifier: LGPL-3.0-or-later
// Nodes, elements, sets and surfaces.
#include "rubato/ccx/draft.hpp"
#include "rubato/mesh/io/inp_elements.hpp"
#include "rubato/mesh/names.hpp"
#include "rubato/study/formulation.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>
#include <unordered_set>

namespace rubato::ccx {
namespace {

using mesh::CellIndex;
using mesh::NodeIndex;
using study::Formulation;
using study::Physics;

/// Larger numbers than this many times the count cost memory in CalculiX.
constexpr std::int64_t most_sparse = 10;
constexpr std::int64_t always_dense = 1'000'000;

bool is_usable(std::span<const std::int64_t> numbers) {
  std::unordered_set<std::int64_t> seen;
  const auto count = static_cast<std::int64_t>(numbers.size());
  return std::ranges::all_of(numbers, [&](std::int64_t number) {
    return number > 0 && number < always_dense + most_sparse * count && seen.insert(number).second;
  });
}

std::string_view prefix_of(Physics physics) {
  switch (physics) {
  case Physics::solid:
    return "C3D";
  case Physics::plane_stress:
    return "CPS";
  case Physics::plane_strain:
    return "CPE";
  case Physics::axisymmetric:
    break;
  }
  return "CAX";
}

bool is_known(CellType type) {
  switch (type) {
  case CellType::tria3:
  case CellType::tria6:
  case CellType::quad4:
  case CellType::quad8:
  case CellType::tetra4:
  case CellType::tetra10:
  case CellType::penta6:
  case CellType::penta15:
  case CellType::hexa8:
  case CellType::hexa20:
    return true;
  default:
    return false;
  }
}

bool is_prism(CellType type) {
  return type == CellType::penta6 || type == CellType::penta15;
}

bool is_quadratic_brick(CellType type) {
  return type == CellType::quad8 || type == CellType::hexa20;
}

/// Chooses element types for the cells of materials, with notes on what differs.
class ElementTypes {
public:
  explicit ElementTypes(Run& run) : run_(run) {}

  std::string name_of(CellType type, const study::Material& material) {
    const auto& shape = cell::topology(type);
    const auto how = study::formulation_of(material, run_.study().physics, type);
    const auto base = fmt::format("{}{}", prefix_of(run_.study().physics), shape.node_count);
    const auto path = "materials." + material.name;
    if (!is_known(type)) {
      run_.refuse(path, fmt::format("found {} cells, which CalculiX has no element for; expected others "
                                    "(mesh.convert: linear or quadratic)",
                                    shape.name));
      return base;
    }
    if (is_prism(type)) {
      note_prism(base, material, how);
      return base;
    }
    switch (how) {
    case Formulation::full:
      return base;
    case Formulation::enhanced:
      return enhanced(base, path);
    case Formulation::reduced:
      return reduced(base, type, material);
    case Formulation::mean_dilatation:
      break;
    }
    return mean_dilatation(base, type, material);
  }

private:
  void note_prism(const std::string& base, const study::Material& material, Formulation how) {
    if (how != Formulation::reduced)
      add_note(run_.draft, fmt::format("material {}: {} has {} points of integration in CalculiX, fewer than "
                                       "'{}' has in rubato: coarse meshes differ",
                                       material.name, base, base == "C3D6" ? "two" : "nine",
                                       how == Formulation::full ? "full" : "mean_dilatation"));
  }

  std::string enhanced(const std::string& base, const std::string& path) {
    if (base != "C3D8")
      run_.refuse(path + ".formulation",
                  fmt::format("found enhanced cells in the plane; CalculiX has incompatible modes in C3D8I "
                              "alone, expected another formulation or {}",
                              "mesh.convert: quadratic"));
    add_note(run_.draft, "C3D8I has other incompatible modes than 'enhanced': 0.1 % of the bending of a bar");
    return base + "I";
  }

  std::string reduced(const std::string& base, CellType type, const study::Material& material) {
    if (study::has_one_point(type))
      add_note(run_.draft,
               fmt::format("material {}: {}R has other forces against hourglasses than 'reduced': "
                           "a bar of two cells in its height bends by 20 % more",
                           material.name, base));
    return base + "R";
  }

  /// Elements that do not lock where volumes are kept.
  std::string mean_dilatation(const std::string& base, CellType type, const study::Material& material) {
    const bool has_reduced = is_quadratic_brick(type) || type == CellType::quad4;
    const auto name = base + (type == CellType::hexa8 ? "I" : has_reduced ? "R" : "");
    add_note(run_.draft,
             fmt::format("material {}: 'mean_dilatation' is written as {}, which {}", material.name, name,
                         name == base ? "is stiffer where volumes are kept"
                                      : "does not lock either; coarse meshes differ by some percent"));
    return name;
  }

  Run& run_;
};

void number_mesh(Run& run) {
  const auto& mesh = run.model.mesh;
  auto& draft = run.draft;
  draft.node_numbers = mesh.node_numbers;
  if (!is_usable(draft.node_numbers)) {
    std::iota(draft.node_numbers.begin(), draft.node_numbers.end(), 1);
    add_note(draft, "nodes have new numbers, from 1 on: those of the mesh are not above 0 or occur twice");
  }
  std::vector<std::int64_t> numbers;
  for (const auto cell : run.model.bulk.cells) {
    const auto at = mesh.place_of(cell);
    numbers.push_back(at.block->numbers[static_cast<std::size_t>(at.index)]);
  }
  if (!is_usable(numbers)) {
    std::iota(numbers.begin(), numbers.end(), 1);
    add_note(draft, "elements have new numbers, from 1 on: those of the mesh are not above 0 or occur twice");
  }
  draft.element_numbers.assign(static_cast<std::size_t>(mesh.cell_count()), 0);
  for (std::size_t i = 0; i < numbers.size(); ++i)
    draft.element_numbers[static_cast<std::size_t>(run.model.bulk.cells[i])] = numbers[i];
  draft.next_node = draft.node_numbers.empty() ? 1 : std::ranges::max(draft.node_numbers) + 1;
  draft.next_element = numbers.empty() ? 1 : std::ranges::max(numbers) + 1;
}

std::string node_lines(const Run& run) {
  auto text = fmt::format("*NODE, NSET={}\n", run.draft.all_nodes);
  for (std::size_t n = 0; n < run.model.mesh.points.size(); ++n) {
    const auto& x = run.model.mesh.points[n];
    text += fmt::format("{}, {}, {}, {}\n", run.draft.node_numbers[n], shown_number(x[0]), shown_number(x[1]),
                        shown_number(x[2]));
  }
  return text;
}

std::vector<std::int64_t> written_elements(const Run& run, std::span<const std::int32_t> cells) {
  std::vector<std::int64_t> numbers;
  for (const auto cell : cells)
    if (const auto number = run.draft.element_numbers[static_cast<std::size_t>(cell)]; number > 0)
      numbers.push_back(number);
  return numbers;
}

/// A label for a group. Groups whose names are not valid labels are listed in one note.
std::string label_for(Run& run, std::string_view kind, const std::string& name) {
  auto label = run.draft.labels.chosen(kind, name);
  if (label != name)
    run.draft.changed_names.insert(fmt::format("{} is {}", name, label));
  return label;
}

/// Elements of one material, a keyword for each type.
std::string element_lines(Run& run) {
  const auto& bulk = run.model.bulk;
  std::map<std::pair<std::int32_t, CellType>, std::vector<CellIndex>> parts;
  for (std::size_t i = 0; i < bulk.cells.size(); ++i)
    parts[{bulk.law_of_cell[i], run.model.mesh.type_of(bulk.cells[i])}].push_back(bulk.cells[i]);
  std::map<std::int32_t, std::vector<CellIndex>> cells_of_law;
  for (const auto& [key, cells] : parts)
    cells_of_law[key.first].insert(cells_of_law[key.first].end(), cells.begin(), cells.end());
  auto& draft = run.draft;
  draft.element_sets_of_law.resize(run.study().materials.size());
  for (auto& [law, cells] : cells_of_law) {
    std::ranges::sort(cells);
    const auto& groups = run.model.mesh.cell_groups;
    const auto same = std::ranges::find(groups, cells, &mesh::Group::items);
    const auto name =
        same == groups.end() ? run.study().materials[static_cast<std::size_t>(law)].name : same->name;
    auto label = same == groups.end() ? draft.labels.chosen("ELSET", name) : label_for(run, "ELSET", name);
    if (same != groups.end())
      draft.element_sets[name] = label;
    draft.element_sets_of_law[static_cast<std::size_t>(law)].push_back(std::move(label));
  }
  ElementTypes types(run);
  std::string text;
  for (const auto& [key, cells] : parts) {
    const auto law = static_cast<std::size_t>(key.first);
    text +=
        fmt::format("*ELEMENT, TYPE={}, ELSET={}\n", types.name_of(key.second, run.study().materials[law]),
                    draft.element_sets_of_law[law].front());
    for (const auto cell : cells) {
      std::vector<std::int64_t> line{draft.element_numbers[static_cast<std::size_t>(cell)]};
      for (const auto node : run.model.mesh.nodes_of(cell))
        line.push_back(draft.node_numbers[static_cast<std::size_t>(node)]);
      text += rows_of(line);
    }
  }
  return text;
}

std::vector<std::int64_t> numbers_of(const Run& run, std::span<const NodeIndex> nodes) {
  std::vector<std::int64_t> numbers;
  for (const auto node : nodes)
    numbers.push_back(run.draft.node_numbers[static_cast<std::size_t>(node)]);
  std::ranges::sort(numbers);
  return numbers;
}

std::string node_set(Run& run, const std::string& label, std::span<const NodeIndex> nodes) {
  const auto numbers = numbers_of(run, nodes);
  run.draft.node_sets_by_content.try_emplace(numbers, label);
  return fmt::format("*NSET, NSET={}\n{}", label, rows_of(numbers));
}

std::string surface_lines(const Run& run, const std::string& label,
                          std::span<const mesh::SurfaceFace> faces) {
  auto text = fmt::format("*SURFACE, NAME={}, TYPE=ELEMENT\n", label);
  for (const auto& face : faces)
    text += fmt::format("{}, S{}\n", run.draft.element_numbers[static_cast<std::size_t>(face.owner)],
                        face_number(run.model, face));
  return text;
}

std::vector<NodeIndex> nodes_of_cells(const mesh::Mesh& mesh, const mesh::Group& group) {
  std::vector<NodeIndex> nodes;
  for (const auto cell : group.items) {
    const auto own = mesh.nodes_of(cell);
    nodes.insert(nodes.end(), own.begin(), own.end());
  }
  std::ranges::sort(nodes);
  nodes.erase(std::ranges::unique(nodes).begin(), nodes.end());
  return nodes;
}

/// Cells that deform become a set of elements; faces and edges a set of nodes, faces a surface too.
std::string cell_group_lines(Run& run, const mesh::Group& group) {
  auto& draft = run.draft;
  std::string text;
  if (const auto numbers = written_elements(run, group.items); !numbers.empty()) {
    if (draft.element_sets.contains(group.name))
      return text;
    const auto label = draft.element_sets[group.name] = label_for(run, "ELSET", group.name);
    return fmt::format("*ELSET, ELSET={}\n{}", label, rows_of(numbers));
  }
  if (group.items.empty())
    return text;
  if (!draft.node_sets.contains(group.name)) {
    const auto label = draft.node_sets[group.name] = label_for(run, "NSET", group.name);
    text += node_set(run, label, nodes_of_cells(run.model.mesh, group));
  }
  const auto oriented = mesh::oriented_faces(run.model.mesh, group.items);
  if (!oriented.sound() || oriented.faces.empty())
    return text;
  const auto label = draft.surface_labels[group.name] = label_for(run, "SURFACE", group.name);
  return text + surface_lines(run, label, oriented.faces);
}

} // namespace

int face_number(const model::Model& model, const mesh::SurfaceFace& face) {
  const auto type = model.mesh.type_of(face.owner);
  for (int number = 1; number <= static_cast<int>(cell::topology(type).sides.size()); ++number)
    if (mesh::inp::side_of_face(type, number) == static_cast<int>(face.side))
      return number;
  return 0;
}

void write_mesh(Run& run) {
  number_mesh(run);
  auto& draft = run.draft;
  const auto& groups = run.model.mesh.node_groups;
  const auto is_all = [&](const mesh::Group& group) {
    return group.items.size() == draft.node_numbers.size();
  };
  std::string sets;
  for (const auto& group : groups)
    if (!group.items.empty()) {
      const auto label = draft.node_sets[group.name] = label_for(run, "NSET", group.name);
      if (is_all(group) && draft.all_nodes.empty())
        draft.all_nodes = label;
      else
        sets += node_set(run, label, group.items);
    }
  if (draft.all_nodes.empty())
    draft.all_nodes = draft.labels.chosen("NSET", "Nall");
  draft.mesh += node_lines(run) + element_lines(run) + sets;
  for (const auto& group : run.model.mesh.cell_groups)
    draft.mesh += cell_group_lines(run, group);
  if (!draft.changed_names.empty())
    add_note(draft, fmt::format("groups with other names, which CalculiX reads in any case: {}",
                                fmt::join(draft.changed_names, ", ")));
}

std::string label_of_nodes(Run& run, std::span<const NodeIndex> nodes, std::string_view name) {
  const auto numbers = numbers_of(run, nodes);
  if (numbers.size() == 1)
    return fmt::format("{}", numbers.front());
  auto& known = run.draft.node_sets_by_content;
  if (const auto found = known.find(numbers); found != known.end())
    return found->second;
  if (numbers.size() == run.draft.node_numbers.size())
    return run.draft.all_nodes;
  auto label = run.draft.labels.chosen("NSET", name);
  run.draft.more_sets += fmt::format("*NSET, NSET={}\n{}", label, rows_of(numbers));
  known.emplace(numbers, label);
  return label;
}

std::string label_of_faces(Run& run, std::span<const mesh::SurfaceFace> faces, const std::string& name) {
  const auto [entry, is_new] = run.draft.surface_labels.try_emplace(name);
  if (is_new) {
    entry->second = label_for(run, "SURFACE", name);
    run.draft.more_sets += surface_lines(run, entry->second, faces);
  }
  return entry->second;
}

} // namespace rubato::ccx
