// SPDX-License-Identifier: LGPL-3.0-or-later
/// Parts of decks that the families of second_way.hpp are put together from.
#pragma once

#include "verification/dice.hpp"
#include "verification/second_way.hpp"
#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace rubato::verification {

/// What every family draws first.
struct SceneDraw {
  bool solid = false;
  bool axisymmetric = false;
  std::string strain; ///< "small", "green_lagrange" or "logarithmic"
  double friction = 0;
  double length = 1;   ///< one unit of the family's lengths in the units of the deck
  double young = 1;    ///< [force/length²]
  double phase = 1;    ///< how long a phase of the loading lasts [time]
  double transits = 0; ///< of sound through ten units of length in a phase
  std::string scheme;
};

struct SceneText {
  std::string bodies, groups, materials, supports, loads, initial, probes;
};

/// Which parts of SceneDraw a family allows.
struct SceneRules {
  bool solid = true;
  bool axisymmetric = false;
  bool turns = false; ///< bodies turn or stretch too much for small strain
  bool dynamic_only = false;
  double least_friction = 0;
};

/// A body in units of the family. `sides` as in the deck.
struct SceneBody {
  std::string name;
  std::array<double, 2> from{}, to{};
  std::array<int, 2> divisions{};
  std::string sides;
  double stiffness = 1; ///< Young's modulus over that of the scene
  double inset = 0;     ///< of a solid: how far it ends before the others on both sides, in its depth
};

class Scene {
public:
  Scene(Dice& dice, const SceneRules& rules);

  void add(const SceneBody& body);
  void add(const SceneBody& body, const std::string& material);
  /// Of a body added before.
  void form(const std::string& body, Form form, double amount);
  /// Holds a group whole, or moves it by functions "press" and "go": `x`, `y` as numbers of the deck or as
  /// moved() gives them.
  void hold(const std::string& group, const std::string& x = "0", const std::string& y = "0");
  void support(const std::string& text);
  /// A displacement in units of the family times a function.
  std::string moved(double by, std::string_view function) const;
  void load(const std::string& text);
  void pair(const std::string& name, const std::string& slave, const std::string& master);
  void probe(const std::string& name, const std::string& text);

  /// `about`, `arm`: of the moments of zones, in units of the family.
  WayStudy study(int phases, int steps, std::array<double, 2> about, double arm) const;

  const SceneDraw& draw() const { return draw_; }
  SceneText& text() { return text_; }
  Dice& dice() { return dice_; }

private:
  Dice& dice_;
  SceneDraw draw_;
  SceneText text_;
  std::vector<SceneBody> bodies_;
  std::vector<Forming> forms_;
  std::vector<ContactPair> pairs_;
  std::string words_;
  bool linear_ = true; ///< no cell has nodes in the middle of edges
};

} // namespace rubato::verification
