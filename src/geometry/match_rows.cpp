// SPDX-License-Identifier: Apache-2.0
#include "geometry/match_rows.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "core/angles.hpp"
#include "core/processor.hpp"
#include "geometry/tilted_motion.hpp"

// Every loop below is written once and compiled twice, for processors with AVX2 and for others. Nothing in them
// branches or calls a function of the mathematical library, so that the compiler makes vectors of them.
#if defined(__x86_64__)
#define HOMEWARD_WITH_AVX2 __attribute__((target("avx2")))
#endif

namespace homeward::geometry {
namespace {

#define HOMEWARD_INLINE [[gnu::always_inline]] inline

HOMEWARD_INLINE double larger(double a, double b) { return a > b ? a : b; }

/// e^x for |x| up to 700, beyond that as at 700; within two units of the last place.
HOMEWARD_INLINE double exponential(double x) {
  constexpr double kMost = 700.0;
  constexpr double kPerLog2 = 1.4426950408889634;
  constexpr double kLog2High = 0x1.62e42feep-1;  // its first 32 bits, so that whole multiples are exact
  constexpr double kLog2Low = 0x1.a39ef35793c76p-33;
  constexpr double kRound = 6755399441055744.0;  // 1.5 * 2^52: adding it rounds to whole numbers, in the low bits
  x = x > kMost ? kMost : x;
  x = x < -kMost ? -kMost : x;
  const double shifted = x * kPerLog2 + kRound;
  const double whole = shifted - kRound;
  const double r = (x - whole * kLog2High) - whole * kLog2Low;
  double sum = 1.0 / 6227020800.0;  // Taylor series to the 13th power; |r| is at most 0.347
  sum = sum * r + 1.0 / 479001600.0;
  sum = sum * r + 1.0 / 39916800.0;
  sum = sum * r + 1.0 / 3628800.0;
  sum = sum * r + 1.0 / 362880.0;
  sum = sum * r + 1.0 / 40320.0;
  sum = sum * r + 1.0 / 5040.0;
  sum = sum * r + 1.0 / 720.0;
  sum = sum * r + 1.0 / 120.0;
  sum = sum * r + 1.0 / 24.0;
  sum = sum * r + 1.0 / 6.0;
  sum = sum * r + 0.5;
  sum = sum * r * r + r + 1.0;
  const std::uint64_t power = (std::bit_cast<std::uint64_t>(shifted) + 1023U) << 52U;
  return sum * std::bit_cast<double>(power);
}

/// The natural logarithm of a positive normal number; within two units of the last place of the larger of it and 1.
HOMEWARD_INLINE double logarithm(double x) {
  constexpr double kLog2 = 0.69314718055994530942;
  constexpr std::uint64_t kSqrtHalf = 0x3FE6A09E667F3BCDU;
  constexpr std::uint64_t kMagic = 0x4330000000000000U;  // 2^52: its low bits are a whole number
  const std::uint64_t bits = std::bit_cast<std::uint64_t>(x);
  // How often the number has to be halved to lie within sqrt(1/2) to sqrt(2).
  const std::uint64_t biased = (bits - kSqrtHalf + (std::uint64_t{1023} << 52U)) >> 52U;
  const double halvings = std::bit_cast<double>(biased | kMagic) - (0x1p52 + 1023.0);
  const double m = std::bit_cast<double>(bits - ((biased - 1023U) << 52U));
  const double s = (m - 1.0) / (m + 1.0);
  const double z = s * s;  // at most 0.0295
  double sum = 1.0 / 23.0;
  sum = sum * z + 1.0 / 21.0;
  sum = sum * z + 1.0 / 19.0;
  sum = sum * z + 1.0 / 17.0;
  sum = sum * z + 1.0 / 15.0;
  sum = sum * z + 1.0 / 13.0;
  sum = sum * z + 1.0 / 11.0;
  sum = sum * z + 1.0 / 9.0;
  sum = sum * z + 1.0 / 7.0;
  sum = sum * z + 0.2;
  sum = sum * z + 1.0 / 3.0;
  return halvings * kLog2 + 2.0 * (s + s * z * sum);
}

struct Rows {
  const double* u;
  const double* v;
  const double* w;
  const double* x;
  const double* y;
  const double* z;
  const double* log_scale_ratio;
  const double* odds;
  const double* size_known;  // 1 or 0
  std::size_t count;
};

/// A matrix as numbers, for loops.
using Nine = std::array<double, 9>;  // row by row
Nine nine(const Eigen::Matrix3d& e) {
  return {e(0, 0), e(0, 1), e(0, 2), e(1, 0), e(1, 1), e(1, 2), e(2, 0), e(2, 1), e(2, 2)};
}

/// E target and E^T current of one match.
struct Lines {
  double cu, cv, cw;
  double tx, ty, tz;
};

HOMEWARD_INLINE Lines lines_of(const Rows& r, const Nine& e, std::size_t i) {
  const double x = r.x[i];
  const double y = r.y[i];
  const double z = r.z[i];
  const double u = r.u[i];
  const double v = r.v[i];
  const double w = r.w[i];
  return {e[0] * x + e[1] * y + e[2] * z, e[3] * x + e[4] * y + e[5] * z, e[6] * x + e[7] * y + e[8] * z,
          e[0] * u + e[3] * v + e[6] * w, e[1] * u + e[4] * v + e[7] * w, e[2] * u + e[5] * v + e[8] * w};
}

struct Residual {
  double value;
  double per_gradient;
};

HOMEWARD_INLINE Residual residual_of(const Rows& r, const Lines& l, std::size_t i) {
  const double value = r.u[i] * l.cu + r.v[i] * l.cv + r.w[i] * l.cw;
  // Tangential gradients with respect to both unit vectors: |E f2|^2 - r^2 and |E^T f1|^2 - r^2.
  const double gradient2 =
      (l.cu * l.cu + l.cv * l.cv + l.cw * l.cw) + (l.tx * l.tx + l.ty * l.ty + l.tz * l.tz) - 2.0 * value * value;
  return {value, 1.0 / std::sqrt(larger(gradient2, 1e-12))};
}

HOMEWARD_INLINE void errors_loop(const Rows& r, const Nine& e, double* __restrict errors) {
  for (std::size_t i = 0; i < r.count; ++i) {
    const Residual residual = residual_of(r, lines_of(r, e, i), i);
    errors[i] = residual.value * residual.per_gradient;
  }
}

using Slopes = std::array<std::array<double, 9>, 5>;  // of the essential matrix, column by column

HOMEWARD_INLINE void slopes_loop(const Rows& r, const Nine& e, const Slopes& s, double* __restrict errors,
                                 double* __restrict s0, double* __restrict s1, double* __restrict s2,
                                 double* __restrict s3, double* __restrict s4) {
  for (std::size_t i = 0; i < r.count; ++i) {
    const Residual residual = residual_of(r, lines_of(r, e, i), i);
    errors[i] = residual.value * residual.per_gradient;
    const double a = r.u[i] * r.x[i];
    const double b = r.v[i] * r.x[i];
    const double c = r.w[i] * r.x[i];
    const double d = r.u[i] * r.y[i];
    const double f = r.v[i] * r.y[i];
    const double g = r.w[i] * r.y[i];
    const double h = r.u[i] * r.z[i];
    const double k = r.v[i] * r.z[i];
    const double l = r.w[i] * r.z[i];
    const auto slope = [&](const std::array<double, 9>& m) __attribute__((always_inline)) {
      return residual.per_gradient *
             (m[0] * a + m[1] * b + m[2] * c + m[3] * d + m[4] * f + m[5] * g + m[6] * h + m[7] * k + m[8] * l);
    };
    s0[i] = slope(s[0]);
    s1[i] = slope(s[1]);
    s2[i] = slope(s[2]);
    s3[i] = slope(s[3]);
    s4[i] = slope(s[4]);
  }
}

/// The angle of a cosine within -1 to 1; within two units of the last place.
HOMEWARD_INLINE double arc_cosine(double x) {
  const double size = std::abs(x);
  const bool steep = size > 0.5;  // then by the sine of half the angle
  const double z = steep ? 0.5 * (1.0 - size) : x * x;
  const double s = steep ? std::sqrt(0.5 * (1.0 - size)) : size;
  // asin(s) = s + s z P(z): Chebyshev's interpolation for z up to 1/4, by 6e-17.
  double sum = 0.028169218060881414;
  sum = sum * z - 0.010749050339697808;
  sum = sum * z + 0.01603551434914882;
  sum = sum * z + 0.0078029494773533175;
  sum = sum * z + 0.011875494382636922;
  sum = sum * z + 0.013929652902326633;
  sum = sum * z + 0.017355259955786323;
  sum = sum * z + 0.02237204763174451;
  sum = sum * z + 0.03038194736709848;
  sum = sum * z + 0.044642857103423646;
  sum = sum * z + 0.07500000000020764;
  sum = sum * z + 0.1666666666666665;
  const double arc_sine = s + s * z * sum;
  const double of_size = steep ? 2.0 * arc_sine : 0.5 * kPi - arc_sine;
  return x < 0.0 ? kPi - of_size : of_size;
}

/// The share of azimuths at which a bearing of this height lies within `window` (a sine) of the plane of the line.
HOMEWARD_INLINE double share_of_azimuths(double x, double y, double z, double height, double window) {
  const double level2 = x * x + y * y;
  const double per_length = 1.0 / std::sqrt(larger(level2 + z * z, 1e-12));
  const double middle = z * height * per_length;
  const double reach = larger(std::sqrt(level2) * per_length * std::sqrt(larger(0.0, 1.0 - height * height)), 1e-9);
  const double low = larger(-1.0, -larger(-1.0, (window + middle) / reach));
  const double high = larger(-1.0, -larger(-1.0, (middle - window) / reach));
  return (arc_cosine(low) - arc_cosine(high)) / kPi;
}

HOMEWARD_INLINE void chance_loop(const Rows& r, const Nine& e, double window, double least, double* __restrict into) {
  for (std::size_t i = 0; i < r.count; ++i) {
    const Lines l = lines_of(r, e, i);
    const double there = share_of_azimuths(l.tx, l.ty, l.tz, r.z[i], window);
    const double here = share_of_azimuths(l.cu, l.cv, l.cw, r.w[i], window);
    into[i] = larger(least, larger(there, here));
  }
}

struct GazeNumbers {
  Nine directions;  // in the current frame, in the target's
  double spread;
  double share;
};

struct SeenNumbers {
  const double* error;
  const double* chance;
  const double* possible;
  double* share;
  double* belief;
  double* gain;
  double* pull;
  double* telling;
};

/// Right matches' residuals have Student's distribution with four degrees of freedom: features are located the worse
/// the larger they are, so that their errors have heavier tails than a normal distribution's.
HOMEWARD_INLINE void judge_loop(const Rows& r, const GazeNumbers& g, const SeenNumbers& s, double* __restrict shares,
                                double* __restrict beliefs, double* __restrict gains, double* __restrict pulls,
                                double* __restrict tellings) {
  constexpr double kFreedom = 4.0;
  constexpr double kLeastSine2 = 1e-4;
  constexpr double kLeastSpreadRad = 0.001;
  constexpr double kLogisticOfNormal = 1.7;  // the logistic function that is nearest to the normal distribution's
  constexpr double kRight = 0.35;  // spread of right matches' change of size about what it should be, in known pairs
  constexpr double kWrong = 0.5;   // and of wrong ones' about no change
  constexpr double kTail = 3.0;    // degrees of freedom of Student's distribution
  const double per_variance = 1.0 / (g.spread * g.spread);
  const double per_parallax = kLogisticOfNormal / (std::numbers::sqrt2 * larger(g.spread, kLeastSpreadRad));
  for (std::size_t i = 0; i < r.count; ++i) {
    const double odds = r.odds[i];
    const double share = g.share * odds / (g.share * odds + 1.0 - g.share);
    const double error2 = s.error[i] * s.error[i];
    const double tail = 1.0 / (1.0 + error2 * per_variance / kFreedom);
    const double here = r.u[i] * g.directions[0] + r.v[i] * g.directions[1] + r.w[i] * g.directions[2];
    const double there = r.x[i] * g.directions[3] + r.y[i] * g.directions[4] + r.z[i] * g.directions[5];
    const double sine2_here = larger(kLeastSine2, 1.0 - here * here);
    const double sine2_there = larger(kLeastSine2, 1.0 - there * there);
    // How much likelier this side is for a right match, which lies in front, than for a wrong one, which lies anywhere:
    // the sine by which the match lies further from the direction in the target view is positive in front of both.
    const double parallax = std::sqrt(sine2_there) * here - std::sqrt(sine2_here) * there;
    const double side = 2.0 / (1.0 + exponential(-parallax * per_parallax));
    // How much likelier the change of size is. The sines of the angles to the direction are as the distances' inverses,
    // and so as the sizes.
    const double log_ratio = r.log_scale_ratio[i];
    const double expected = 0.5 * logarithm(sine2_there / sine2_here);
    const double variance = kRight * kRight + g.spread * g.spread * (1.0 / sine2_here + 1.0 / sine2_there);
    const double off = log_ratio - expected;
    const double as_wrong = 1.0 + log_ratio * log_ratio / (kTail * kWrong * kWrong);
    const double as_right = 1.0 + off * off / (kTail * variance);
    const double known_size = kWrong / std::sqrt(variance) * (as_wrong * as_wrong) / (as_right * as_right);
    const double known = r.size_known[i];
    const double size = known * known_size + (1.0 - known);
    const double right = share * side * size * tail * tail * std::sqrt(tail) / s.chance[i];
    const double possible = s.possible[i];
    const double evidence = possible * right;
    const double all = evidence + 1.0 - share;
    shares[i] = share;
    beliefs[i] = evidence / all;
    gains[i] = logarithm(all);
    pulls[i] = tail * (kFreedom + 1.0) / kFreedom;
    tellings[i] = 1.0 - possible * s.chance[i];
  }
}

#if defined(__x86_64__)
HOMEWARD_WITH_AVX2 void errors_avx2(const Rows& r, const Nine& e, double* errors) { errors_loop(r, e, errors); }
HOMEWARD_WITH_AVX2 void slopes_avx2(const Rows& r, const Nine& e, const Slopes& s, double* errors, double* slopes) {
  const std::size_t n = r.count;
  slopes_loop(r, e, s, errors, slopes, slopes + n, slopes + 2 * n, slopes + 3 * n, slopes + 4 * n);
}
HOMEWARD_WITH_AVX2 void chance_avx2(const Rows& r, const Nine& e, double window, double least, double* into) {
  chance_loop(r, e, window, least, into);
}
HOMEWARD_WITH_AVX2 void judge_avx2(const Rows& r, const GazeNumbers& g, const SeenNumbers& s) {
  judge_loop(r, g, s, s.share, s.belief, s.gain, s.pull, s.telling);
}
#endif

Rows pointers(const std::array<std::vector<double>, 9>& rows, std::size_t count) {
  return {rows[0].data(), rows[1].data(), rows[2].data(), rows[3].data(), rows[4].data(),
          rows[5].data(), rows[6].data(), rows[7].data(), rows[8].data(), count};
}

}  // namespace

MatchRows::MatchRows(std::span<const Correspondence> matches) : matches_(matches) {
  for (std::vector<double>& row : rows_) row.resize(matches.size());
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const Correspondence& match = matches[i];
    for (std::size_t k = 0; k < 3; ++k) {
      rows_[k][i] = match.current[static_cast<Eigen::Index>(k)];
      rows_[3 + k][i] = match.target[static_cast<Eigen::Index>(k)];
    }
    rows_[6][i] = match.log_scale_ratio;
    rows_[7][i] = match.odds;
    rows_[8][i] = match.log_scale_ratio == 0.0 ? 0.0 : 1.0;
  }
}

void MatchRows::errors(const EpipolarError& of, std::vector<double>& into) const {
  into.resize(size());
  const Rows r = pointers(rows_, size());
  const Nine e = nine(of.essential());
#if defined(__x86_64__)
  if (has_avx2()) return errors_avx2(r, e, into.data());
#endif
  errors_loop(r, e, into.data());
}

void MatchRows::errors_and_slopes(const EpipolarError& of, std::vector<double>& errors,
                                  std::vector<double>& slopes) const {
  errors.resize(size());
  slopes.resize(5 * size());
  const std::size_t n = size();
  const Rows r = pointers(rows_, n);
  const Nine e = nine(of.essential());
  Slopes s{};
  for (std::size_t angle = 0; angle < s.size(); ++angle) {
    for (std::size_t k = 0; k < 9; ++k) {
      s[angle][k] = of.slopes()(static_cast<Eigen::Index>(angle), static_cast<Eigen::Index>(k));
    }
  }
#if defined(__x86_64__)
  if (has_avx2()) return slopes_avx2(r, e, s, errors.data(), slopes.data());
#endif
  double* const out = slopes.data();
  slopes_loop(r, e, s, errors.data(), out, out + n, out + 2 * n, out + 3 * n, out + 4 * n);
}

void MatchRows::chances(const EpipolarError& of, double window_rad, double least, std::vector<double>& into) const {
  into.resize(size());
  const Rows r = pointers(rows_, size());
  const Nine e = nine(of.essential());
  // Both bearings share the error, so that the distance of one to its line may be sqrt(2) times as large.
  const double window = window_rad * std::numbers::sqrt2;
#if defined(__x86_64__)
  if (has_avx2()) return chance_avx2(r, e, window, least, into.data());
#endif
  chance_loop(r, e, window, least, into.data());
}

void MatchRows::judge(const Gaze& gaze, Seen& seen) const {
  for (auto* row : {&seen.share, &seen.belief, &seen.gain, &seen.pull, &seen.telling}) row->resize(size());
  const Rows r = pointers(rows_, size());
  const Eigen::Vector3d& here = gaze.direction_in_current;
  const Eigen::Vector3d& there = gaze.direction_in_target;
  const GazeNumbers g{{here.x(), here.y(), here.z(), there.x(), there.y(), there.z()}, gaze.spread_rad, gaze.share};
  const SeenNumbers s{seen.error_rad.data(), seen.chance.data(), seen.possible.data(), seen.share.data(),
                      seen.belief.data(),    seen.gain.data(),   seen.pull.data(),     seen.telling.data()};
#if defined(__x86_64__)
  if (has_avx2()) return judge_avx2(r, g, s);
#endif
  judge_loop(r, g, s, s.share, s.belief, s.gain, s.pull, s.telling);
}

}  // namespace homeward::geometry
