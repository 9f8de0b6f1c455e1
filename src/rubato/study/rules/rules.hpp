// SPDX-License-Identifier: LGPL-3.0-or-later
/// The rules of a study, part by part. Only validate.cpp and its parts include this.
#pragma once

#include "rubato/core/naming.hpp"
#include "rubato/study/bounds.hpp"
#include "rubato/study/range.hpp"
#include "rubato/study/validate.hpp"
#include "rubato/study/words.hpp"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rubato::study {

/// Collects what is broken.
class Rules {
public:
  explicit Rules(const Study& checked) : study(checked) {}

  const Study& study;

  /// `paths` are the values that the rule is about; it is told at the first.
  void broken(std::vector<std::string> paths, std::string text);

  /// A number within its bounds, finite in any case. `reason`: why, or what to do instead.
  void number(const std::string& path, double value, const Range& range = {}, std::string_view reason = {});
  void whole_number(const std::string& path, int value, const Range& range);
  /// Each of a list of numbers; paths are made only where one is broken: tables may be long.
  void numbers(const std::string& path, std::span<const double> values);
  /// The numbers that a row of a table takes, where the record below `path` has them.
  template <class Row, class Record>
  void numbers_of(const Row& row, const std::string& path, const Record& record) {
    for (const auto& entry : row.numbers)
      if (const auto value = entry.get(record))
        number(path + "." + std::string(entry.key), *value, entry.range);
  }
  /// Numbers that ascend, each greater than the one before.
  void ascending(const std::string& path, std::span<const double> values);
  /// A table whose abscissae the deck has below `key`: as many of both, ascending.
  void table(const LinearTable& table, const std::string& path, const std::string& key);
  /// An instant of the run.
  void instant(const std::string& path, double instant);
  /// A name that is given.
  void name(const std::string& path, const std::string& name);
  /// Names of a list: given, none twice.
  void names(const std::string& path, std::span<const std::string> names);
  /// A name the user chose, of which there is one only: it may be a column or a folder of the results.
  void chosen_name(const std::string& path, const std::string& name, std::span<const std::string> before);
  /// The name of a function that there is; empty: none.
  void function(const std::string& path, const std::string& name);
  /// A finite number, an expression that can be computed, a table, of coordinates that the physics has, or a
  /// field of a file.
  void field_value(const std::string& path, const FieldValue& value);
  /// The same, times a function that there is.
  void field(const std::string& path, const Field& field);
  /// The same of a displacement, for which a velocity or an acceleration may stand.
  void motion(const std::string& path, const Field& field);
  /// A field of a file that is named.
  void file_field(const std::string& path, const FileField& field);
  void given_field(const std::string& path, const GivenField& field);
  /// A component that the physics has.
  void axis(const std::string& path, std::size_t axis);

  bool has_time() const { return study.time.end > study.time.begin; }
  Judgement take() { return std::move(judgement_); }

private:
  void note_bounds(const std::string& path, const Range& range);

  Judgement judgement_;
};

/// Whether Newton starts from exact forces of the zone, as conjugate gradients find them.
constexpr bool predicts_exactly(const ContactZone& zone) {
  return entry_of(zone.method).exact_prediction;
}

/// Whether a name is that of a relation with a reference.
bool is_reference(const Study& study, const std::string& name);
/// A fault where a name is no reference, or one without a rotation; `paths` as those of Rules::broken.
void check_rotation(Rules& rules, const std::string& name, std::vector<std::string> paths);
/// What a name that is none is told.
std::string expected_reference(const Study& study, const std::string& name);

/// A rotation of a whole group.
void check_rotate(Rules& rules, const Rotation& rotation, const std::string& path);

void check_mesh(Rules& rules);
void check_groups(Rules& rules);
void check_physics(Rules& rules);
void check_materials(Rules& rules);
void check_functions(Rules& rules);
void check_supports(Rules& rules);
void check_base_motion(Rules& rules);
void check_preloads(Rules& rules);
/// A plane that cuts bodies.
void check_cut(Rules& rules, const Cut& cut, const std::string& path);
void check_relations(Rules& rules);
void check_modal_damping(Rules& rules);
void check_springs(Rules& rules);
void check_connectors(Rules& rules);
void check_point_masses(Rules& rules);
void check_loads(Rules& rules);
/// What the law of a material has that is no plain number; of one material at `path`.
void check_law_words(Rules& rules, const Material& material, const std::string& path);
/// The strain and the formulation of a material, and what goes with them.
void check_bulk(Rules& rules, const Material& material, const std::string& path);
/// What only studies with nonlinear bodies take.
void check_nonlinear_solution(Rules& rules);
/// Of one material at `path`.
void check_expansion(Rules& rules, const Material& material, const std::string& path);
void check_temperatures(Rules& rules);
void check_initial(Rules& rules);
void check_contact(Rules& rules);
/// Which surfaces a zone has: master and slave, or what stands for both.
void check_surfaces(Rules& rules, const ContactZone& zone);
void check_obstacle(Rules& rules, const ContactZone& zone);
void check_time(Rules& rules);
void check_solution(Rules& rules);
void check_probes(Rules& rules);
void check_output(Rules& rules);
void check_checks(Rules& rules);

} // namespace rubato::study
