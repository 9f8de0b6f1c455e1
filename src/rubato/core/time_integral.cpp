// SPDX-License-Identifier: LGPL-3.0-or-later
// Chebyshev series: L. N. Trefethen, Approximation Theory and Approximation Practice, SIAM, 2013, ch. 3
// and 19.
#include "rubato/core/time_integral.hpp"

#include "rubato/core/error.hpp"
#include "rubato/core/naming.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

namespace rubato {
namespace {

using Integrand = std::function<double(double)>;
using Piece = IntegralPiece;
using Series = IntegralPiece::Series;
using Pieces = std::vector<IntegralPiece>;

constexpr std::size_t count = Piece::coefficients;
/// Pieces that a run is divided into before any is halved: a pulse shorter than one of them in which no value
/// is taken would be missed.
constexpr int first_pieces = 256;
/// What the last coefficients of a piece may leave of its integral, in parts of the largest value times the
/// whole time.
constexpr double negligible = 1e-15;
/// Parts of the whole time below which a piece is not halved: there is a jump in it.
constexpr double shortest = 1e-15;
/// Pieces shorter than the first, in parts of the whole time, give less than the second of the sum of all
/// magnitudes, or the integral does not exist.
constexpr double narrow = 1e-10;
constexpr double narrow_part = 1e-3;
constexpr std::size_t most_pieces = 200'000;

// ---- series ----------------------------------------------------------------------------------------------

/// Σ c_k T_k(ξ), by Clenshaw's recurrence.
double sum_at(const Series& c, double xi) {
  double one = 0;
  double two = 0;
  for (std::size_t k = c.size(); k-- > 1;)
    two = std::exchange(one, 2 * xi * one - two + c.at(k));
  return xi * one - two + c.front();
}

/// Of dT/dξ: c′_{k−1} = c′_{k+1} + 2 k c_k.
Series derivative_of(const Series& c) {
  Series d{};
  for (std::size_t k = c.size() - 1; k >= 1; --k)
    d.at(k - 1) = (k + 1 < c.size() ? d.at(k + 1) : 0.0) + 2 * static_cast<double>(k) * c.at(k);
  d.front() /= 2;
  return d;
}

/// ∫ from −1: C_k = (c_{k−1} − c_{k+1})/2k, C_0 such that the sum is 0 at −1. The last coefficient must be 0.
Series integral_of(const Series& c) {
  Series sum{};
  for (std::size_t k = 1; k < c.size(); ++k) {
    const double before = k == 1 ? 2 * c.at(0) : c.at(k - 1);
    const double after = k + 1 < c.size() ? c.at(k + 1) : 0.0;
    sum.at(k) = (before - after) / (2 * static_cast<double>(k));
  }
  for (std::size_t k = 1; k < c.size(); ++k)
    sum.front() += k % 2 == 1 ? sum.at(k) : -sum.at(k);
  return sum;
}

Piece piece_of(double begin, double length, const Series& f) {
  const auto once = integral_of(f);
  const Piece::Polynomial polynomial{f, once, integral_of(once)};
  return {.begin = begin,
          .length = length,
          .value = sum_at(f, -1),
          .polynomial = std::make_shared<const Piece::Polynomial>(polynomial)};
}

/// Through values at the roots of T_count.
Series through(const std::array<double, count>& values) {
  Series f{};
  for (std::size_t k = 0; k < count; ++k) {
    double sum = 0;
    for (std::size_t j = 0; j < count; ++j)
      sum += values.at(j) *
             std::cos(std::numbers::pi * static_cast<double>(k) * (static_cast<double>(j) + 0.5) / count);
    f.at(k) = (k == 0 ? 1.0 : 2.0) * sum / count;
  }
  return f;
}

// ---- straight lines --------------------------------------------------------------------------------------

Piece line(double begin, double end, double from, double to) {
  return {.begin = begin, .length = end - begin, .value = from, .slope = (to - from) / (end - begin)};
}

/// What a table is after its last instant, as a piece that goes on.
Piece last_line(const LinearTable& table, double begin) {
  const double value = interpolated(table, begin);
  if (table.outside != LinearTable::Outside::linear || begin < table.at.back())
    return {.begin = begin, .value = value};
  return line(begin, begin + 1, value, interpolated(table, begin + 1));
}

Pieces lines_of(const LinearTable& table, double begin) {
  Pieces pieces;
  double from = begin;
  for (std::size_t i = 0; i < table.at.size(); ++i) {
    const double to = table.at[i];
    if (!(to > from))
      continue;
    const bool before = i == 0;
    const double start = interpolated(table, from);
    const double end = before && table.outside == LinearTable::Outside::zero ? 0.0 : table.values[i];
    pieces.push_back(line(from, to, start, end));
    from = to;
  }
  auto last = last_line(table, from);
  if (table.outside == LinearTable::Outside::zero && from >= table.at.back())
    last = {.begin = from};
  pieces.push_back(last);
  return pieces;
}

// ---- anything else ---------------------------------------------------------------------------------------

void collect_breaks(const Function& function, std::vector<double>& breaks) {
  if (const auto* table = function.table())
    breaks.insert(breaks.end(), table->at.begin(), table->at.end());
  if (const auto* ramp = std::get_if<Ramp>(&function.is))
    breaks.insert(breaks.end(), {ramp->begin, ramp->end});
  if (const auto* product = std::get_if<Product>(&function.is))
    for (const auto& factor : product->factors)
      collect_breaks(factor, breaks);
}

/// Ends of the first pieces, ascending.
std::vector<double> first_ends(const std::optional<Function>& function, double begin, double end) {
  std::vector<double> ends;
  for (int i = 0; i <= first_pieces; ++i)
    ends.push_back(i == first_pieces ? end : begin + (end - begin) * i / first_pieces);
  if (function)
    collect_breaks(*function, ends);
  std::erase_if(ends, [&](double t) { return t < begin || t > end; });
  std::ranges::sort(ends);
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  return ends;
}

class Tabulation {
public:
  Tabulation(const Integrand& f, double begin, double end) : f_(f), span_(end - begin) {}

  void add(double begin, double end) {
    const double length = end - begin;
    std::array<double, count> values{};
    for (std::size_t j = 0; j < count; ++j) {
      const double xi = std::cos(std::numbers::pi * (static_cast<double>(j) + 0.5) / count);
      values.at(j) = f_(begin + length * (1 + xi) / 2);
      largest_ = std::max(largest_, std::abs(values.at(j)));
    }
    const auto f = through(values);
    const double middle = begin + length / 2;
    if (is_exact(f, length) || !(middle > begin && middle < end))
      return enter(piece_of(begin, length, f));
    add(begin, middle);
    add(middle, end);
  }

  Pieces take() {
    if (in_narrow_ > narrow_part * in_all_)
      throw InputError(fmt::format(
          "the function of time cannot be integrated: it is infinite near t = {:.6g}", narrow_at_));
    return std::move(pieces_);
  }

private:
  bool is_exact(const Series& f, double length) const {
    const double left =
        std::max({std::abs(f.at(count - 1)), std::abs(f.at(count - 2)), std::abs(f.at(count - 3))});
    return left * length <= negligible * largest_ * span_ || length <= shortest * span_;
  }

  void enter(const Piece& piece) {
    if (pieces_.size() >= most_pieces)
      throw InputError(fmt::format("the function of time changes too fast to be integrated near t = {:.6g}, "
                                   "expected a table of what it gives",
                                   piece.begin));
    const double sum = std::abs(piece.polynomial->f.front()) * piece.length;
    in_all_ += sum;
    if (piece.length < narrow * span_) {
      in_narrow_ += sum;
      narrow_at_ = piece.begin;
    }
    pieces_.push_back(piece);
  }

  const Integrand& f_;
  double span_;
  double largest_ = 0;
  double in_all_ = 0; ///< magnitudes times lengths
  double in_narrow_ = 0;
  double narrow_at_ = 0;
  Pieces pieces_;
};

/// What is 0 at the begin, from piece to piece. Sums of many pieces are kept in extended precision.
void join(Pieces& pieces) {
  long double velocity = 0;
  long double displacement = 0;
  for (auto& piece : pieces) {
    piece.velocity = static_cast<double>(velocity);
    piece.displacement = static_cast<double>(displacement);
    const double end = piece.begin + piece.length;
    const Piece alone{piece.begin, piece.length, piece.value, piece.slope, piece.polynomial, 0, 0};
    displacement += velocity * piece.length + alone.at(end, 2);
    velocity += alone.at(end, 1);
  }
}

Pieces tabulated(const Integrand& f, const std::vector<double>& ends) {
  Tabulation tabulation(f, ends.front(), ends.back());
  for (std::size_t i = 1; i < ends.size(); ++i)
    tabulation.add(ends[i - 1], ends[i]);
  return tabulation.take();
}

/// x − sin x, which near 0 is what sines lose.
double less_sine(double x) {
  if (std::abs(x) > 0.5)
    return x - std::sin(x);
  double term = x * x * x / 6;
  double sum = term;
  for (int k = 4; k < 16; k += 2)
    sum += term *= -x * x / (k * (k + 1));
  return sum;
}

} // namespace

double IntegralPiece::at(double t, int integrals) const {
  const double past = t - begin;
  const double half = length / 2;
  const double xi = past / half - 1;
  const auto* p = polynomial.get();
  switch (integrals) {
  case 2:
    return displacement + velocity * past +
           (p != nullptr ? half * half * sum_at(p->twice, xi) : (value / 2 + slope * past / 6) * past * past);
  case 1:
    return velocity + (p != nullptr ? half * sum_at(p->once, xi) : (value + slope * past / 2) * past);
  case 0:
    return p != nullptr ? sum_at(p->f, xi) : value + slope * past;
  default:
    return p != nullptr ? sum_at(derivative_of(p->f), xi) / half : slope;
  }
}

TimeIntegral::TimeIntegral(std::optional<Function> function, std::optional<Expression> expression, int times,
                           double begin, double end)
    : function_(std::move(function)), expression_(std::move(expression)), times_(times), begin_(begin),
      end_(end) {
  const auto* table = function_ ? function_->table() : nullptr;
  const auto* ramp = function_ ? std::get_if<Ramp>(&function_->is) : nullptr;
  const auto* sine = function_ ? std::get_if<Sine>(&function_->is) : nullptr;
  Pieces pieces;
  if (sine != nullptr && !expression_) {
    constexpr double radians = std::numbers::pi / 180;
    is_ = OfSine{sine->mean, sine->amplitude, 2 * std::numbers::pi * sine->frequency, radians * sine->phase};
    return;
  }
  if (!expression_ && !function_) {
    pieces = lines_of({{begin}, {1}}, begin);
  } else if (!expression_ && table != nullptr) {
    pieces = lines_of(*table, begin);
  } else if (!expression_ && ramp != nullptr) {
    pieces = lines_of({{ramp->begin, ramp->end}, {ramp->from, ramp->to}}, begin);
  } else {
    const Integrand f = [this](double t) { return integrand(t); };
    pieces = tabulated(f, first_ends(function_, begin, end));
    pieces.push_back({.begin = end, .value = integrand(end)});
  }
  join(pieces);
  is_ = std::move(pieces);
}

double TimeIntegral::integrand(double t) const {
  double value = function_ ? value_at(*function_, t) : 1.0;
  if (expression_)
    value *= value_at(Function(*expression_), t);
  return value;
}

double TimeIntegral::derivative(double t, int order) const {
  const int integrals = times_ - order;
  if (const auto* sine = std::get_if<OfSine>(&is_))
    return of_sine(*sine, t, integrals);
  const auto& pieces = std::get<Pieces>(is_);
  const auto after = std::ranges::upper_bound(pieces, t, {}, &IntegralPiece::begin);
  if (after != pieces.begin())
    return std::prev(after)->at(t, integrals);
  const auto& first = pieces.front();
  if (!first.polynomial)
    return first.at(t, integrals);
  return IntegralPiece{.begin = first.begin, .value = first.value}.at(t, integrals);
}

/// With x = ω (t − begin): ∫ sin = 2 sin(θ₀ + x/2) sin(x/2)/ω and
/// ∫∫ sin = (cos θ₀ (x − sin x) + 2 sin θ₀ sin²(x/2))/ω², which keep their digits near the begin.
double TimeIntegral::of_sine(const OfSine& sine, double t, int integrals) const {
  const auto& [mean, amplitude, omega, phase] = sine;
  const double past = t - begin_;
  const double x = omega * past;
  const double first = omega * begin_ + phase;
  const double half = std::sin(x / 2);
  switch (integrals) {
  case 2:
    return mean * past * past / 2 +
           amplitude * (std::cos(first) * less_sine(x) + 2 * std::sin(first) * half * half) / (omega * omega);
  case 1:
    return mean * past + amplitude * 2 * std::sin(first + x / 2) * half / omega;
  case 0:
    return mean + amplitude * std::sin(omega * t + phase);
  default:
    return amplitude * omega * std::cos(omega * t + phase);
  }
}

bool TimeIntegral::operator==(const TimeIntegral& other) const {
  return times_ == other.times_ && begin_ == other.begin_ && end_ == other.end_ &&
         function_ == other.function_ && expression_ == other.expression_;
}

FieldFunction integrated(const FieldFunction& field, int times, double begin, double end) {
  auto result = field;
  const bool in_time = field.expression && field.expression->has('t');
  if (in_time && field.varies_in_place())
    throw InputError({fault_at(
        field.path, fmt::format("{}: found {}, which has the place and t, in a velocity or an acceleration; "
                                "expected an expression of the place times a function of time",
                                field.path, shown(field.expression->text())))});
  if (field.sampled && field.sampled->varies_in_time())
    throw InputError(
        {fault_at(field.path, field.path + ": found a field that varies in time, in a velocity or "
                                           "an acceleration; expected one of the place times a "
                                           "function of time")});
  try {
    result.function = Function(Integral{std::make_shared<const TimeIntegral>(
        field.function, in_time ? field.expression : std::nullopt, times, begin, end)});
  } catch (const InputError& error) {
    throw InputError({fault_at(field.path, field.path + ": " + error.faults().front().text)});
  }
  if (in_time)
    result.expression.reset();
  return result;
}

double rate_at(const std::optional<Function>& function, double t, int order) {
  if (!function)
    return 0;
  const auto* integral = std::get_if<Integral>(&function->is);
  return integral == nullptr ? 0 : integral->of->derivative(t, order);
}

} // namespace rubato
