// SPDX-License-Identifier: LGPL-3.0-or-later
/// The laws at the points of one cell behind one call a cell, so that the kernels are compiled once for all
/// laws.
#pragma once

#include "rubato/material/point_response.hpp"

#include <cstddef>
#include <span>
#include <type_traits>
#include <variant>

namespace rubato::element {

/// What the laws of one cell take and give: a strain and a response for each point, states one after the
/// other.
struct PointCalls {
  std::span<const material::Strain6> strain;
  std::span<const double> old; ///< at the start of the step
  std::span<double> now;       ///< written; not the memory of `old`
  material::StepInfo step;
  material::Want want = material::Want::tangent;
  std::span<material::Response> response;
};

namespace detail {

template <class T> inline constexpr bool is_variant = false;
template <class... Laws> inline constexpr bool is_variant<std::variant<Laws...>> = true;

/// Calls `work` with the law itself, not with the variant that holds it.
template <class L, class Work> decltype(auto) with_law(const L& law, const Work& work) {
  if constexpr (is_variant<L>)
    return std::visit(work, law);
  else
    return work(law);
}

template <class L> int numbers_remembered(const L& law) {
  return with_law(law, [](const auto& one) { return static_cast<int>(state_size(one)); });
}

template <class L> bool expands_in_stretch(const L& law) {
  return with_law(law, [](const auto& one) {
    if constexpr (requires { is_hyperelastic(one); })
      return static_cast<bool>(is_hyperelastic(one));
    else
      return false;
  });
}

template <class L>
bool respond_at(const L& law, const PointCalls& calls, std::size_t point, std::size_t size) {
  return respond(law, calls.strain[point], calls.old.subspan(point * size, size),
                 calls.now.subspan(point * size, size), calls.step, calls.want, calls.response[point]);
}

template <class L> std::size_t first_failure(const L& law, const PointCalls& calls, std::size_t size) {
  for (std::size_t point = 0; point < calls.strain.size(); ++point)
    if (!respond_at(law, calls, point, size))
      return point;
  return calls.strain.size();
}

} // namespace detail

/// Views laws that it does not own: a law is a type with `state_size` and `respond` of
/// material/point_law.hpp, and `is_hyperelastic` if it is, or a std::variant of such types.
class PointLaws {
public:
  /// The same law at every point.
  template <class L>
  explicit PointLaws(const L& law)
      : laws_(&law), state_size_(detail::numbers_remembered(law)),
        is_hyperelastic_(detail::expands_in_stretch(law)),
        call_([](const void* laws, const PointCalls& calls, std::size_t size) {
          return detail::with_law(*static_cast<const L*>(laws),
                                  [&](const auto& one) { return detail::first_failure(one, calls, size); });
        }) {}

  /// A law for each point, all with a state of the same size and hyperelastic or not; not empty.
  template <class L>
  explicit PointLaws(std::span<const L> laws)
      : laws_(laws.data()), state_size_(detail::numbers_remembered(laws.front())),
        is_hyperelastic_(detail::expands_in_stretch(laws.front())),
        call_([](const void* first, const PointCalls& calls, std::size_t size) {
          const auto* law = static_cast<const L*>(first);
          for (std::size_t point = 0; point < calls.strain.size(); ++point)
            if (!detail::with_law(
                    law[point], [&](const auto& one) { return detail::respond_at(one, calls, point, size); }))
              return point;
          return calls.strain.size();
        }) {}

  /// Numbers that a point remembers.
  int state_size() const { return state_size_; }

  /// Whether free expansion divides F instead of being taken from the strain.
  bool is_hyperelastic() const { return is_hyperelastic_; }

  /// The first point whose law fails; the number of points where none does.
  std::size_t respond(const PointCalls& calls) const {
    return call_(laws_, calls, static_cast<std::size_t>(state_size_));
  }

private:
  const void* laws_;
  int state_size_;
  bool is_hyperelastic_;
  std::size_t (*call_)(const void*, const PointCalls&, std::size_t);
};

} // namespace rubato::element
