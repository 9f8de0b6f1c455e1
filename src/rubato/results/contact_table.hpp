// SPDX-License-Identifier: LGPL-3.0-or-later
/// contact_<zone>.csv: what contact does at the points of a zone, at chosen instants.
///
///   t, node            the instant; the slave node that the point stands on, empty where it stands on none
///   s                  in the plane: arc length along the undeformed slave (contact/arc_length.hpp)
///   x, y[, z]          where the point is, deformed
///   pressure           of the master on the slave [force/area]
///   traction.x, .y[, .z]  tangential, of the master on the slave [force/area]
///   gap                empty where nothing faces the point
///   slip               Σ |Δs| of the steps at whose ends the point was closed, since the run began
///   status             open, sticks or slips
///   friction_work      what friction has taken at the point since the run began [force · length]
///   area               undeformed, of the point's share of the slave that faces the master: the sum of
///                      pressure times area is `normal` in resultants_<zone>.csv
#pragma once

#include "rubato/model/fwd.hpp"
#include "rubato/results/csv.hpp"
#include "rubato/step/state.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace rubato::contact {
struct SlavePoint;
} // namespace rubato::contact

namespace rubato::results {

/// One table. Errors are those of LineFile.
class ContactTable {
public:
  /// A new file in the folder, of one of the model's zones. The model must outlive this.
  ContactTable(const model::Model& model, std::size_t zone, const std::filesystem::path& folder);
  /// Goes on after the first `bytes` of a file that is there.
  ContactTable(const model::Model& model, std::size_t zone, const std::filesystem::path& folder,
               std::uintmax_t bytes);

  /// Adds a line a contact point.
  void write(const step::State& state);
  void cut(std::uintmax_t bytes) { file_.cut(bytes); }
  std::uintmax_t bytes() const { return file_.bytes(); }

private:
  ContactTable(const model::Model& model, std::size_t zone, LineFile file);
  std::span<const contact::SlavePoint> points() const;
  std::string line(const step::State& state, std::size_t point) const;

  const model::Model* model_;
  std::size_t zone_;
  LineFile file_;
  std::vector<std::string> nodes_;  ///< one a point
  std::vector<double> arc_lengths_; ///< one a point, in the plane
};

} // namespace rubato::results
