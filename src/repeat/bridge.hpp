// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "camera/camera.hpp"
#include "repeat/subrange.hpp"
#include "repeat/teach_config.hpp"

namespace homeward::repeat {

/// A gap that was bridged.
struct Bridge {
  Subrange from;       // with what was matched among its features
  SubrangeView view;   // of the picture, with a geometry
  int matched = 0;     // features that were matched and agree with one motion
  int compared = 0;    // that looked alike
  int looked_for = 0;  // features that should be in the picture
};

/// A picture that nothing of a key image could be tracked into, matched with it without any expectation (wide baseline:
/// Segvic et al. 2007, §2.1). The matches say where its features are looked for in the picture; only what the tracker
/// then finds there, looking as in the key image, is taken, and only if one motion explains it and turns as the matches
/// do. Nothing where that fails, and without `bridging` in the configuration.
std::optional<Bridge> bridge_to(const NumberedPicture& picture, const Subrange& from, const camera::Camera& camera,
                                const TeachConfig& config);

/// Whether enough of `looked_for` features was found, and agrees with a motion that turns as what was matched does.
bool holds(const SubrangeView& view, int looked_for, const WideMatch& match, const TeachConfig& config);

/// How many of a key image's features lie in a picture by a guess.
int looked_for(const Subrange& from, const GuessPlace& guess, const camera::Camera& camera);

}  // namespace homeward::repeat
