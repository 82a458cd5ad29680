// SPDX-License-Identifier: Apache-2.0
#include "sim/sensor.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/vector_targets.hpp"
#include "sim/hash.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/sensor.cpp"  // compiled once for each kind of processor
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace homeward::sim {
namespace HWY_NAMESPACE {
namespace {

/// As many as go in whole vectors; returns how many that is. Every operation is one of level() and sensor_noise(), in
/// their order.
std::size_t expose_vectors([[maybe_unused]] const float* light, [[maybe_unused]] std::size_t count,
                           [[maybe_unused]] std::uint64_t first_key, [[maybe_unused]] float noise_levels,
                           [[maybe_unused]] const float* table, [[maybe_unused]] std::uint8_t* levels) {
  std::size_t i = 0;
#if HWY_TARGET != HWY_SCALAR
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::ScalableTag<float> d;
  const hn::RebindToSigned<decltype(d)> whole;
  const hn::RebindToUnsigned<decltype(d)> bits32;
  const hn::Repartition<std::uint64_t, decltype(d)> bits64;
  const hn::Rebind<std::uint8_t, decltype(d)> bytes;
  const std::size_t lanes = hn::Lanes(d);
  const auto times = [&](auto x, std::uint64_t factor) HWY_ATTR {  // modulo 2^64
    const auto low = hn::BitCast(bits32, hn::Set(bits64, factor & 0xFFFFFFFFU));
    const auto high = hn::BitCast(bits32, hn::Set(bits64, factor >> 32U));
    const auto x_low = hn::BitCast(bits32, x);
    const auto x_high = hn::BitCast(bits32, hn::ShiftRight<32>(x));
    return hn::MulEven(x_low, low) + hn::ShiftLeft<32>(hn::MulEven(x_high, low) + hn::MulEven(x_low, high));
  };
  const auto mixed = [&](auto x) HWY_ATTR {
    x = times(x ^ hn::ShiftRight<30>(x), 0xBF58476D1CE4E5B9ULL);
    x = times(x ^ hn::ShiftRight<27>(x), 0x94D049BB133111EBULL);
    return hn::BitCast(bits32, x ^ hn::ShiftRight<31>(x));
  };
  const auto uniform = [&](auto x) HWY_ATTR { return hn::ConvertTo(d, hn::BitCast(whole, x)) / hn::Set(d, 65535.0F); };
  for (; i + lanes <= count; i += lanes) {
    const auto keys = hn::Set(bits64, first_key + i) + hn::Iota(bits64, 0);
    const auto first = mixed(keys);
    const auto second = mixed(keys + hn::Set(bits64, lanes / 2));
    const auto low = hn::ConcatEven(bits32, second, first);
    const auto high = hn::ConcatOdd(bits32, second, first);
    const auto mask = hn::Set(bits32, 0xFFFFU);
    const auto sum = uniform(low & mask) + uniform(hn::ShiftRight<16>(low)) + uniform(high & mask) +
                     uniform(hn::ShiftRight<16>(high));
    const auto noise = (sum - hn::Set(d, 2.0F)) * hn::Set(d, kSensorNoiseScale);
    const auto root = hn::Min(hn::Sqrt(hn::LoadU(d, light + i)), hn::Set(d, DisplayCurve::kBrightest));
    const auto place = hn::Set(d, DisplayCurve::kSteps) * root;
    const auto below = hn::ConvertTo(whole, place);
    const auto dark = hn::GatherIndex(d, table, below);
    const auto bright = hn::GatherIndex(d, table + 1, below);
    const auto level = dark + (place - hn::ConvertTo(d, below)) * (bright - dark);
    const auto noisy = level + hn::Set(d, noise_levels) * noise + hn::Set(d, 0.5F);
    const auto clamped = hn::Min(hn::Max(noisy, hn::Zero(d)), hn::Set(d, 255.0F));
    hn::StoreU(hn::DemoteTo(bytes, hn::ConvertTo(whole, clamped)), bytes, levels + i);
  }
#endif
  return i;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace homeward::sim
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace homeward::sim {

HWY_EXPORT(expose_vectors);

DisplayCurve::DisplayCurve() {
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    const float root = static_cast<float>(i) / kSteps;
    const float bounded = 1.0F - std::exp(-(root * root));
    const float srgb = bounded <= 0.0031308F ? 12.92F * bounded : 1.055F * std::pow(bounded, 1.0F / 2.4F) - 0.055F;
    levels_[i] = 255.0F * srgb;
  }
}

float DisplayCurve::level(float light) const {
  const float place = kSteps * std::min(std::sqrt(light), kBrightest);
  const auto below = static_cast<std::size_t>(place);
  return levels_[below] + (place - static_cast<float>(below)) * (levels_[below + 1] - levels_[below]);
}

float sensor_noise(std::uint64_t key) {
  const std::uint64_t bits = mix(key);
  float sum = 0.0F;
  for (unsigned i = 0; i < 4; ++i) sum += static_cast<float>((bits >> (16U * i)) & 0xFFFFU) / 65535.0F;
  return (sum - 2.0F) * kSensorNoiseScale;
}

void expose(const DisplayCurve& curve, const float* light, std::size_t count, std::uint64_t first_key,
            float noise_levels, std::uint8_t* levels) {
  std::size_t i = HWY_DYNAMIC_DISPATCH(expose_vectors)(light, count, first_key, noise_levels, curve.table(), levels);
  for (; i < count; ++i) {
    const float level = curve.level(light[i]) + noise_levels * sensor_noise(first_key + i);
    levels[i] = static_cast<std::uint8_t>(std::clamp(level + 0.5F, 0.0F, 255.0F));
  }
}

}  // namespace homeward::sim
#endif
