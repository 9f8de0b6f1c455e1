// SPDX-License-Identifier: LGPL-3.0-or-later
// Contact pairs and ties.
#include "rubato/ccx/draft.hpp"
#include "rubato/contact/zone.hpp"
#include "rubato/material/make_point_law.hpp"
#include "rubato/mesh/names.hpp"
#include "rubato/study/fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace rubato::ccx {
namespace {

using study::ContactMethod;
using study::ContactZone;

/// Stiffness of contact in place of an exact one, in parts of that of the faces' cells: E over the length
/// of a slave face. The surfaces overlap by half a percent of what these cells are compressed.
constexpr double stiff = 200;
/// Stick slope in parts of that stiffness.
constexpr double stick = 0.1;

using Corners = std::vector<mesh::NodeIndex>;

Corners corners_of(CellType type, std::span<const mesh::NodeIndex> nodes) {
  const auto count = static_cast<std::size_t>(cell::topology(type).corner_count);
  Corners corners(nodes.begin(), nodes.begin() + static_cast<std::ptrdiff_t>(count));
  std::ranges::sort(corners);
  return corners;
}

class ContactWriter {
public:
  explicit ContactWriter(Run& run) : run_(run) {
    for (const auto& face : mesh::skin(run.model.mesh))
      skin_.emplace(corners_of(face.type, face.nodes()), face);
  }

  void write(const contact::Zone& zone) {
    const auto& settings = zone.settings;
    path_ = "contact." + settings.name;
    const auto slave = surface_of(zone.slave, settings.slave, "slave");
    const auto master =
        zone.obstacle ? obstacle_of(settings) : surface_of(zone.master, settings.master, "master");
    if (slave.empty() || master.empty())
      return;
    for (const auto* surface : {&zone.slave, &zone.master})
      if (ends_on_axis(*surface))
        return run_.refuse(
            path_ + (surface == &zone.slave ? ".slave" : ".master"),
            "found faces that end on the axis; CalculiX misses contact with them, expected surfaces that do "
            "not reach the axis");
    if (settings.tie)
      return write_tie(zone, slave, master);
    const auto interaction = run_.draft.labels.chosen(body_kind(), settings.name);
    const double stiffness = normal_stiffness(zone);
    run_.body += fmt::format("*SURFACE INTERACTION, NAME={}\n{}", interaction, behaviour(zone, stiffness));
    run_.body += friction(zone, stiffness);
    check_excluded(zone);
    run_.body += fmt::format("*CONTACT PAIR, INTERACTION={}, TYPE=SURFACE TO SURFACE\n{}, {}\n", interaction,
                             slave, master);
    add_note(run_.draft,
             fmt::format("{}: CalculiX has contact at points of slave faces, rubato {}: forces and "
                         "displacements differ by about 1 %",
                         path_,
                         settings.integration.by == study::ContactIntegration::mortar
                             ? "by integrals over faces"
                             : "at points of its own"));
    if (!run_.is_static())
      add_note(run_.draft,
               path_ + ": CalculiX cuts increments of implicit motions where bodies hit, some end there");
  }

private:
  bool ends_on_axis(const contact::Surface& surface) const {
    return run_.study().physics == study::Physics::axisymmetric &&
           std::ranges::any_of(surface.nodes, [&](mesh::NodeIndex node) {
             return run_.model.mesh.points[static_cast<std::size_t>(node)].x() <= 0;
           });
  }

  bool is_held(mesh::NodeIndex node) const {
    for (int i = 0; i < run_.model.dofs.components; ++i)
      if (!run_.model.reduction.is_prescribed(run_.model.dofs.dof(node, i)))
        return false;
    return true;
  }

  /// Nodes that supports hold may have contact or not.
  void check_excluded(const contact::Zone& zone) {
    for (const auto& name : zone.settings.exclude_nodes) {
      auto nodes = mesh::find_nodes(run_.model.mesh, name).nodes;
      std::erase_if(nodes,
                    [&](mesh::NodeIndex node) { return zone.slave.position_of(node) < 0 || is_held(node); });
      if (!nodes.empty())
        run_.refuse(
            path_ + ".exclude_nodes",
            fmt::format(
                "found node {} without contact, which no support holds; CalculiX has contact on whole "
                "faces, expected nodes that are held",
                mesh::node_name(run_.model.mesh, nodes.front())));
    }
  }

  /// The least distance of a slave node in the plane from the master's faces.
  double distance_in_plane(const contact::Zone& zone) const {
    const auto& points = run_.model.mesh.points;
    double least = std::numeric_limits<double>::infinity();
    for (const auto node : zone.slave.nodes)
      for (const auto& face : zone.master.faces) {
        const Eigen::Vector3d& a = points[static_cast<std::size_t>(face.nodes[0])];
        const Eigen::Vector3d way = points[static_cast<std::size_t>(face.nodes[1])] - a;
        const Eigen::Vector3d to = points[static_cast<std::size_t>(node)] - a;
        const double along = std::clamp(to.dot(way) / way.squaredNorm(), 0.0, 1.0);
        least = std::min(least, (to - along * way).norm());
      }
    return least;
  }

  std::string obstacle_of(const ContactZone& settings) {
    const auto label = run_.draft.labels.chosen(body_kind() + " surface", "obstacle_" + settings.name);
    write_obstacle(run_, *settings.obstacle, settings.name, label);
    add_note(run_.draft, path_ + ": the plane is the face of a rigid block");
    return label;
  }

  /// Labels of interactions are chosen anew for each run, so that equal runs have equal texts.
  std::string body_kind() const { return "INTERACTION" + run_.study().name; }

  std::string surface_of(const contact::Surface& surface, const std::string& name, std::string_view side) {
    std::vector<mesh::SurfaceFace> faces;
    for (const auto& face : surface.faces) {
      const auto found = skin_.find(corners_of(face.type, face.node_span()));
      if (found == skin_.end()) {
        run_.refuse(
            path_ + "." + std::string(side),
            fmt::format("found faces of '{}' that bound no cell; surfaces of CalculiX are faces of elements, "
                        "expected a body",
                        name));
        return {};
      }
      faces.push_back(found->second);
    }
    return label_of_faces(run_, faces, name);
  }

  void write_tie(const contact::Zone& zone, const std::string& slave, const std::string& master) {
    if (run_.is_plane())
      return write_springs_of_tie(zone, slave, master);
    run_.body += fmt::format("*TIE, NAME={}, POSITION TOLERANCE={}, ADJUST=NO\n{}, {}\n", zone.settings.name,
                             shown_number(zone.slave.longest_edge), slave, master);
    add_note(run_.draft,
             fmt::format("{}: slave nodes are tied to places of master faces in CalculiX{}", path_,
                         zone.settings.integration.by == study::ContactIntegration::mortar
                             ? ", by integrals over faces in rubato"
                             : ""));
  }

  /// CalculiX gives elements of the plane a thickness by equations, beside which *TIE has no effect.
  void write_springs_of_tie(const contact::Zone& zone, const std::string& slave, const std::string& master) {
    constexpr double touching = 1e-3;
    if (distance_in_plane(zone) > touching * zone.slave.longest_edge)
      return run_.refuse(path_ + ".tie",
                         "found a tie over a gap in the plane, which CalculiX does not have; expected "
                         "surfaces that touch");
    const auto interaction = run_.draft.labels.chosen(body_kind(), zone.settings.name);
    const auto stiffness = shown_number(exact_stiffness(zone));
    run_.body +=
        fmt::format("*SURFACE INTERACTION, NAME={}\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=TIED\n{}\n"
                    "*FRICTION\n1., {}\n*CONTACT PAIR, INTERACTION={}, TYPE=SURFACE TO SURFACE\n{}, {}\n",
                    interaction, stiffness, stiffness, interaction, slave, master);
    add_note(run_.draft,
             fmt::format("{}: the tie is written as springs of {} [force/length^3], as *TIE has no effect "
                         "in the plane",
                         path_, stiffness));
  }

  /// E of the cells behind the slave faces over the mean length of these.
  double cell_stiffness(const contact::Zone& zone) const {
    const auto& model = run_.model;
    double sum = 0;
    for (const auto& face : zone.slave.faces) {
      const auto found = skin_.find(corners_of(face.type, face.node_span()));
      const auto at = std::ranges::find(model.bulk.cells, found->second.owner) - model.bulk.cells.begin();
      const auto law = static_cast<std::size_t>(model.bulk.law_of_cell[static_cast<std::size_t>(at)]);
      const auto& material = model.study.materials[law];
      const double young = material.law == study::LawKind::orthotropic
                               ? material.orthotropy.young_x
                               : material::small_strain_moduli(material).young;
      const auto& nodes = face.nodes;
      const double length = (model.mesh.points[static_cast<std::size_t>(nodes[1])] -
                             model.mesh.points[static_cast<std::size_t>(nodes[0])])
                                .norm();
      sum += young / length;
    }
    return sum / static_cast<double>(zone.slave.faces.size());
  }

  /// With one digit.
  double exact_stiffness(const contact::Zone& zone) const {
    const double rough = stiff * cell_stiffness(zone);
    const double step = std::pow(10.0, std::floor(std::log10(rough)));
    return std::round(rough / step) * step;
  }

  double normal_stiffness(const contact::Zone& zone) const {
    const auto& settings = zone.settings;
    const bool given = settings.method == ContactMethod::penalty && settings.normal_coefficient;
    return given ? *settings.normal_coefficient : exact_stiffness(zone);
  }

  std::string behaviour(const contact::Zone& zone, double stiffness) {
    const auto& settings = zone.settings;
    if (settings.method == ContactMethod::exponential) {
      if (settings.curve == study::ExponentialCurve::abaqus)
        run_.refuse(
            path_ + ".coefficients.curve",
            "found the curve abaqus; pressures of CalculiX grow otherwise, expected 'curve: calculix'");
      return fmt::format("*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=EXPONENTIAL\n{}, {}\n",
                         shown_number(settings.clearance.value_or(1)),
                         shown_number(settings.pressure.value_or(1)));
    }
    if (settings.method != ContactMethod::penalty || !settings.normal_coefficient)
      add_note(run_.draft,
               fmt::format("{}: {} is written as springs of {} [force/length^3]: CalculiX has no exact "
                           "contact of this kind",
                           path_,
                           settings.method == ContactMethod::penalty ? "a penalty that is chosen at each "
                                                                       "point"
                                                                     : "exact contact",
                           shown_number(stiffness)));
    return fmt::format("*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n{}\n", shown_number(stiffness));
  }

  std::string friction(const contact::Zone& zone, double stiffness) {
    const auto& settings = zone.settings;
    if (settings.friction == 0)
      return {};
    const double slope = stick * stiffness;
    add_note(run_.draft, fmt::format("{}: friction sticks by springs of {} [force/length^3] in CalculiX",
                                     path_, shown_number(slope)));
    return fmt::format("*FRICTION\n{}, {}\n", shown_number(settings.friction), shown_number(slope));
  }

  Run& run_;
  std::string path_;
  std::map<Corners, mesh::SurfaceFace> skin_;
};

/// Refuses what no key of CalculiX does.
void check_zone(Run& run, const ContactZone& zone, const std::string& path) {
  if (!zone.self.empty())
    run.refuse(path + ".self",
               "found a surface that touches itself; contact pairs of CalculiX have two surfaces, "
               "expected two");
  if (zone.obstacle && (zone.obstacle->kind != study::ObstacleKind::plane || zone.obstacle->rotate))
    run.refuse(path + ".obstacle",
               "found an obstacle that is round or rotates; CalculiX has no surfaces by formulas, "
               "expected a plane or a body");
  if (zone.bilateral)
    run.refuse(path + ".bilateral",
               "found true; surfaces of CalculiX that do not part do not slide either, expected "
               "false");
  if (!study::is_zero(zone.gap) || !study::is_zero(zone.interference))
    run.refuse(path + (study::is_zero(zone.gap) ? ".interference" : ".gap"),
               "found a distance that is added to that of the meshes, which CalculiX has not; expected "
               "meshes that have "
               "it");
  if (zone.friction_in_place)
    run.refuse(path + ".friction",
               "found friction that depends on the place; CalculiX has one number, expected one");
  if (zone.restitution != 0)
    run.refuse(path + ".restitution", "found a restitution; CalculiX has none, expected 0");
  if (zone.method == ContactMethod::nodal_penalty)
    run.refuse(path + ".method",
               "found nodal_penalty, whose springs have no areas; CalculiX has pressures, expected "
               "penalty");
}

} // namespace

void write_contact(Run& run) {
  const auto known = run.faults.size();
  for (const auto& zone : run.study().contact)
    if (!zone.tie && !run.modes)
      check_zone(run, zone, "contact." + zone.name);
  if (run.model.zones.empty() || run.faults.size() > known)
    return;
  ContactWriter writer(run);
  for (const auto& zone : run.model.zones)
    if (zone.settings.tie || !run.modes)
      writer.write(zone);
    else
      add_note(run.draft, fmt::format("contact.{}: natural modes are those of bodies that do not touch",
                                      zone.settings.name));
}

} // namespace rubato::ccx
