// SPDX-License-Identifier: Apache-2.0
#include "geometry/match_row_loops.hpp"

#include <cmath>
#include <cstdint>
#include <numbers>

#include "core/angles.hpp"
#include "core/vector_targets.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "geometry/match_row_loops.cpp"  // compiled once for each kind of processor
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace homeward::geometry::match_row_loops {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// `d` says how many matches go at once. Rows are done by whole vectors, what is left one by one.
using Many = hn::ScalableTag<double>;
using One = hn::CappedTag<double, 1>;

/// e^x for |x| up to 700, beyond that as at 700; within two units of the last place.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V exponential(D d, V x) {
  constexpr double kMost = 700.0;
  constexpr double kPerLog2 = 1.4426950408889634;
  constexpr double kLog2High = 0x1.62e42feep-1;  // its first 32 bits, so that whole multiples are exact
  constexpr double kLog2Low = 0x1.a39ef35793c76p-33;
  constexpr double kRound = 6755399441055744.0;  // 1.5 * 2^52: adding it rounds to whole numbers, in the low bits
  const hn::RebindToUnsigned<D> u;
  x = hn::Min(x, hn::Set(d, kMost));
  x = hn::Max(x, hn::Set(d, -kMost));
  const V shifted = x * hn::Set(d, kPerLog2) + hn::Set(d, kRound);
  const V whole = shifted - hn::Set(d, kRound);
  const V r = (x - whole * hn::Set(d, kLog2High)) - whole * hn::Set(d, kLog2Low);
  V sum = hn::Set(d, 1.0 / 6227020800.0);  // Taylor series to the 13th power; |r| is at most 0.347
  sum = sum * r + hn::Set(d, 1.0 / 479001600.0);
  sum = sum * r + hn::Set(d, 1.0 / 39916800.0);
  sum = sum * r + hn::Set(d, 1.0 / 3628800.0);
  sum = sum * r + hn::Set(d, 1.0 / 362880.0);
  sum = sum * r + hn::Set(d, 1.0 / 40320.0);
  sum = sum * r + hn::Set(d, 1.0 / 5040.0);
  sum = sum * r + hn::Set(d, 1.0 / 720.0);
  sum = sum * r + hn::Set(d, 1.0 / 120.0);
  sum = sum * r + hn::Set(d, 1.0 / 24.0);
  sum = sum * r + hn::Set(d, 1.0 / 6.0);
  sum = sum * r + hn::Set(d, 0.5);
  sum = sum * r * r + r + hn::Set(d, 1.0);
  const auto power = hn::ShiftLeft<52>(hn::BitCast(u, shifted) + hn::Set(u, 1023U));
  return sum * hn::BitCast(d, power);
}

/// The natural logarithm of a positive normal number; within two units of the last place of the larger of it and 1.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V logarithm(D d, V x) {
  constexpr double kLog2 = 0.69314718055994530942;
  constexpr std::uint64_t kSqrtHalf = 0x3FE6A09E667F3BCDU;
  constexpr std::uint64_t kMagic = 0x4330000000000000U;  // 2^52: its low bits are a whole number
  const hn::RebindToUnsigned<D> u;
  const auto bits = hn::BitCast(u, x);
  // How often the number has to be halved to lie within sqrt(1/2) to sqrt(2).
  const auto biased = hn::ShiftRight<52>(bits - hn::Set(u, kSqrtHalf) + hn::Set(u, std::uint64_t{1023} << 52U));
  const V halvings = hn::BitCast(d, hn::Or(biased, hn::Set(u, kMagic))) - hn::Set(d, 0x1p52 + 1023.0);
  const V m = hn::BitCast(d, bits - hn::ShiftLeft<52>(biased - hn::Set(u, 1023U)));
  const V one = hn::Set(d, 1.0);
  const V s = (m - one) / (m + one);
  const V z = s * s;  // at most 0.0295
  V sum = hn::Set(d, 1.0 / 23.0);
  sum = sum * z + hn::Set(d, 1.0 / 21.0);
  sum = sum * z + hn::Set(d, 1.0 / 19.0);
  sum = sum * z + hn::Set(d, 1.0 / 17.0);
  sum = sum * z + hn::Set(d, 1.0 / 15.0);
  sum = sum * z + hn::Set(d, 1.0 / 13.0);
  sum = sum * z + hn::Set(d, 1.0 / 11.0);
  sum = sum * z + hn::Set(d, 1.0 / 9.0);
  sum = sum * z + hn::Set(d, 1.0 / 7.0);
  sum = sum * z + hn::Set(d, 0.2);
  sum = sum * z + hn::Set(d, 1.0 / 3.0);
  return halvings * hn::Set(d, kLog2) + hn::Set(d, 2.0) * (s + s * z * sum);
}

template <class V>
struct Vector3 {
  V x, y, z;
};

/// Of one match each.
template <class D>
HWY_INLINE Vector3<hn::Vec<D>> current_of(D d, const Rows& r, std::size_t i) {
  return {hn::LoadU(d, r.u + i), hn::LoadU(d, r.v + i), hn::LoadU(d, r.w + i)};
}
template <class D>
HWY_INLINE Vector3<hn::Vec<D>> target_of(D d, const Rows& r, std::size_t i) {
  return {hn::LoadU(d, r.x + i), hn::LoadU(d, r.y + i), hn::LoadU(d, r.z + i)};
}

/// Each number in every lane, made once before a loop.
template <class D>
struct Spread9 {
  hn::Vec<D> m[9];

  HWY_INLINE Spread9(D d, const Nine& from) {
    for (std::size_t k = 0; k < from.size(); ++k) m[k] = hn::Set(d, from[k]);
  }
};

template <class V>
HWY_INLINE V dot(V a, V b, V c, const Vector3<V>& v) {
  return a * v.x + b * v.y + c * v.z;
}

/// E target and E^T current of one match.
template <class V>
struct Lines {
  Vector3<V> current;
  Vector3<V> target;
};

template <class D, class V = hn::Vec<D>>
HWY_INLINE Lines<V> lines_of(const Vector3<V>& current, const Vector3<V>& target, const Spread9<D>& spread) {
  const V* const e = spread.m;
  return {{dot(e[0], e[1], e[2], target), dot(e[3], e[4], e[5], target), dot(e[6], e[7], e[8], target)},
          {dot(e[0], e[3], e[6], current), dot(e[1], e[4], e[7], current), dot(e[2], e[5], e[8], current)}};
}

template <class V>
struct Residual {
  V value;
  V per_gradient;
};

template <class D, class V = hn::Vec<D>>
HWY_INLINE Residual<V> residual_of(D d, const Vector3<V>& current, const Lines<V>& l) {
  const V value = current.x * l.current.x + current.y * l.current.y + current.z * l.current.z;
  // Tangential gradients with respect to both unit vectors: |E f2|^2 - r^2 and |E^T f1|^2 - r^2.
  const V gradient2 = (l.current.x * l.current.x + l.current.y * l.current.y + l.current.z * l.current.z) +
                      (l.target.x * l.target.x + l.target.y * l.target.y + l.target.z * l.target.z) -
                      hn::Set(d, 2.0) * value * value;
  return {value, hn::Set(d, 1.0) / hn::Sqrt(hn::Max(gradient2, hn::Set(d, 1e-12)))};
}

/// From match `i` on, by whole vectors; gives the first match that is left.
template <class D>
HWY_INLINE std::size_t errors_from(D d, std::size_t i, const Rows& r, const Nine& e, double* errors) {
  const Spread9<D> essential(d, e);
  for (; i + hn::Lanes(d) <= r.count; i += hn::Lanes(d)) {
    const auto current = current_of(d, r, i);
    const auto residual = residual_of(d, current, lines_of(current, target_of(d, r, i), essential));
    hn::StoreU(residual.value * residual.per_gradient, d, errors + i);
  }
  return i;
}

template <class D>
HWY_INLINE std::size_t slopes_from(D d, std::size_t i, const Rows& r, const Nine& e, const Slopes& slopes_of,
                                   double* errors, double* slopes) {
  using V = hn::Vec<D>;
  const Spread9<D> essential(d, e);
  const Spread9<D> of_angle[] = {
      {d, slopes_of[0]}, {d, slopes_of[1]}, {d, slopes_of[2]}, {d, slopes_of[3]}, {d, slopes_of[4]}};
  for (; i + hn::Lanes(d) <= r.count; i += hn::Lanes(d)) {
    const auto current = current_of(d, r, i);
    const auto target = target_of(d, r, i);
    const auto residual = residual_of(d, current, lines_of(current, target, essential));
    hn::StoreU(residual.value * residual.per_gradient, d, errors + i);
    const Vector3<V> along_x{current.x * target.x, current.y * target.x, current.z * target.x};
    const Vector3<V> along_y{current.x * target.y, current.y * target.y, current.z * target.y};
    const Vector3<V> along_z{current.x * target.z, current.y * target.z, current.z * target.z};
    for (std::size_t k = 0; k < slopes_of.size(); ++k) {
      const V* const m = of_angle[k].m;
      const V of_x = dot(m[0], m[1], m[2], along_x);
      const V of_xy = of_x + m[3] * along_y.x + m[4] * along_y.y + m[5] * along_y.z;
      const V of_all = of_xy + m[6] * along_z.x + m[7] * along_z.y + m[8] * along_z.z;
      hn::StoreU(residual.per_gradient * of_all, d, slopes + k * r.count + i);
    }
  }
  return i;
}

/// The angle of a cosine within -1 to 1; within two units of the last place.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V arc_cosine(D d, V x) {
  const V half = hn::Set(d, 0.5);
  const V size = hn::Abs(x);
  const auto steep = size > half;  // then by the sine of half the angle
  const V half_rest = half * (hn::Set(d, 1.0) - size);
  const V z = hn::IfThenElse(steep, half_rest, x * x);
  const V s = hn::IfThenElse(steep, hn::Sqrt(half_rest), size);
  // asin(s) = s + s z P(z): Chebyshev's interpolation for z up to 1/4, by 6e-17.
  V sum = hn::Set(d, 0.028169218060881414);
  sum = sum * z - hn::Set(d, 0.010749050339697808);
  sum = sum * z + hn::Set(d, 0.01603551434914882);
  sum = sum * z + hn::Set(d, 0.0078029494773533175);
  sum = sum * z + hn::Set(d, 0.011875494382636922);
  sum = sum * z + hn::Set(d, 0.013929652902326633);
  sum = sum * z + hn::Set(d, 0.017355259955786323);
  sum = sum * z + hn::Set(d, 0.02237204763174451);
  sum = sum * z + hn::Set(d, 0.03038194736709848);
  sum = sum * z + hn::Set(d, 0.044642857103423646);
  sum = sum * z + hn::Set(d, 0.07500000000020764);
  sum = sum * z + hn::Set(d, 0.1666666666666665);
  const V arc_sine = s + s * z * sum;
  const V of_size = hn::IfThenElse(steep, hn::Set(d, 2.0) * arc_sine, hn::Set(d, 0.5 * kPi) - arc_sine);
  return hn::IfThenElse(x < hn::Zero(d), hn::Set(d, kPi) - of_size, of_size);
}

/// The share of azimuths at which a bearing of this height lies within `window` (a sine) of the plane of the line.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V share_of_azimuths(D d, const Vector3<V>& line, V height, V window) {
  const V one = hn::Set(d, 1.0);
  const V minus_one = hn::Set(d, -1.0);
  const V level2 = line.x * line.x + line.y * line.y;
  const V per_length = one / hn::Sqrt(hn::Max(level2 + line.z * line.z, hn::Set(d, 1e-12)));
  const V middle = line.z * height * per_length;
  const V reach =
      hn::Max(hn::Sqrt(level2) * per_length * hn::Sqrt(hn::Max(hn::Zero(d), one - height * height)), hn::Set(d, 1e-9));
  const V low = hn::Max(minus_one, hn::Neg(hn::Max(minus_one, (window + middle) / reach)));
  const V high = hn::Max(minus_one, hn::Neg(hn::Max(minus_one, (middle - window) / reach)));
  return (arc_cosine(d, low) - arc_cosine(d, high)) / hn::Set(d, kPi);
}

template <class D>
HWY_INLINE std::size_t chances_from(D d, std::size_t i, const Rows& r, const Nine& e, double window, double least,
                                    double* into) {
  const auto within = hn::Set(d, window);
  const Spread9<D> essential(d, e);
  for (; i + hn::Lanes(d) <= r.count; i += hn::Lanes(d)) {
    const auto current = current_of(d, r, i);
    const auto target = target_of(d, r, i);
    const auto lines = lines_of(current, target, essential);
    const auto there = share_of_azimuths(d, lines.target, target.z, within);
    const auto here = share_of_azimuths(d, lines.current, current.z, within);
    hn::StoreU(hn::Max(hn::Set(d, least), hn::Max(there, here)), d, into + i);
  }
  return i;
}

/// Right matches' residuals have Student's distribution with four degrees of freedom: features are located the worse
/// the larger they are, so that their errors have heavier tails than a normal distribution's.
template <class D>
HWY_INLINE std::size_t judge_from(D d, std::size_t i, const Rows& r, const GazeNumbers& g, const SeenNumbers& s) {
  constexpr double kFreedom = 4.0;  // a power of two: to multiply by its inverse is to divide by it
  constexpr double kLeastSine2 = 1e-4;
  constexpr double kLeastSpreadRad = 0.001;
  constexpr double kLogisticOfNormal = 1.7;  // the logistic function that is nearest to the normal distribution's
  constexpr double kRight = 0.35;  // spread of right matches' change of size about what it should be, in known pairs
  constexpr double kWrong = 0.5;   // and of wrong ones' about no change
  constexpr double kTail = 3.0;    // degrees of freedom of Student's distribution
  using V = hn::Vec<D>;
  const double variance_of_spread = g.spread * g.spread;
  const double least_spread = g.spread > kLeastSpreadRad ? g.spread : kLeastSpreadRad;
  const V per_parallax = hn::Set(d, kLogisticOfNormal / (std::numbers::sqrt2 * least_spread));
  const V per_variance = hn::Set(d, 1.0 / variance_of_spread);
  const V one = hn::Set(d, 1.0);
  const V prior = hn::Set(d, g.share);
  for (; i + hn::Lanes(d) <= r.count; i += hn::Lanes(d)) {
    const V odds = hn::LoadU(d, r.odds + i);
    const V share = prior * odds / (prior * odds + one - prior);
    const V error = hn::LoadU(d, s.error + i);
    const V error2 = error * error;
    const V tail = one / (one + error2 * per_variance * hn::Set(d, 1.0 / kFreedom));
    const V here = dot(hn::Set(d, g.here[0]), hn::Set(d, g.here[1]), hn::Set(d, g.here[2]), current_of(d, r, i));
    const V there = dot(hn::Set(d, g.there[0]), hn::Set(d, g.there[1]), hn::Set(d, g.there[2]), target_of(d, r, i));
    const V sine2_here = hn::Max(hn::Set(d, kLeastSine2), one - here * here);
    const V sine2_there = hn::Max(hn::Set(d, kLeastSine2), one - there * there);
    // How much likelier this side is for a right match, which lies in front, than for a wrong one, which lies anywhere:
    // the sine by which the match lies further from the direction in the target view is positive in front of both.
    const V parallax = hn::Sqrt(sine2_there) * here - hn::Sqrt(sine2_here) * there;
    const V side = hn::Set(d, 2.0) / (one + exponential(d, hn::Neg(parallax) * per_parallax));
    // How much likelier the change of size is. The sines of the angles to the direction are as the distances' inverses,
    // and so as the sizes.
    const V log_ratio = hn::LoadU(d, r.log_scale_ratio + i);
    const V expected = hn::Set(d, 0.5) * logarithm(d, sine2_there / sine2_here);
    const V variance =
        hn::Set(d, kRight * kRight) + hn::Set(d, variance_of_spread) * (one / sine2_here + one / sine2_there);
    const V off = log_ratio - expected;
    const V as_wrong = one + log_ratio * log_ratio / hn::Set(d, kTail * kWrong * kWrong);
    const V as_right = one + off * off / (hn::Set(d, kTail) * variance);
    const V known_size = hn::Set(d, kWrong) / hn::Sqrt(variance) * (as_wrong * as_wrong) / (as_right * as_right);
    const V known = hn::LoadU(d, r.size_known + i);
    const V size = known * known_size + (one - known);
    const V chance = hn::LoadU(d, s.chance + i);
    const V right = share * side * size * tail * tail * hn::Sqrt(tail) / chance;
    const V possible = hn::LoadU(d, s.possible + i);
    const V evidence = possible * right;
    const V all = evidence + one - share;
    hn::StoreU(share, d, s.share + i);
    hn::StoreU(evidence / all, d, s.belief + i);
    hn::StoreU(logarithm(d, all), d, s.gain + i);
    hn::StoreU(tail * hn::Set(d, kFreedom + 1.0) * hn::Set(d, 1.0 / kFreedom), d, s.pull + i);
    hn::StoreU(one - possible * chance, d, s.telling + i);
  }
  return i;
}

void errors(const Rows& r, const Nine& e, double* into) {
  const std::size_t rest = errors_from(Many(), 0, r, e, into);
  if (rest < r.count) errors_from(One(), rest, r, e, into);
}

void errors_and_slopes(const Rows& r, const Nine& e, const Slopes& s, double* errors, double* slopes) {
  const std::size_t rest = slopes_from(Many(), 0, r, e, s, errors, slopes);
  if (rest < r.count) slopes_from(One(), rest, r, e, s, errors, slopes);
}

void chances(const Rows& r, const Nine& e, double window, double least, double* into) {
  const std::size_t rest = chances_from(Many(), 0, r, e, window, least, into);
  if (rest < r.count) chances_from(One(), rest, r, e, window, least, into);
}

void judge(const Rows& r, const GazeNumbers& g, const SeenNumbers& s) {
  const std::size_t rest = judge_from(Many(), 0, r, g, s);
  if (rest < r.count) judge_from(One(), rest, r, g, s);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace homeward::geometry::match_row_loops
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace homeward::geometry::match_row_loops {

HWY_EXPORT(errors);
HWY_EXPORT(errors_and_slopes);
HWY_EXPORT(chances);
HWY_EXPORT(judge);

void errors(const Rows& r, const Nine& e, double* into) { HWY_DYNAMIC_DISPATCH(errors)(r, e, into); }

void errors_and_slopes(const Rows& r, const Nine& e, const Slopes& s, double* errors, double* slopes) {
  HWY_DYNAMIC_DISPATCH(errors_and_slopes)(r, e, s, errors, slopes);
}

void chances(const Rows& r, const Nine& e, double window, double least, double* into) {
  HWY_DYNAMIC_DISPATCH(chances)(r, e, window, least, into);
}

void judge(const Rows& r, const GazeNumbers& g, const SeenNumbers& s) { HWY_DYNAMIC_DISPATCH(judge)(r, g, s); }

}  // namespace homeward::geometry::match_row_loops
#endif
