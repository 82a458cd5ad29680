// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "map/taught_path.hpp"

namespace homeward::repeat {

// A path is part of a map; what teaches and repeats one calls its parts by their own names.
using Arc = map::PathArc;
using map::ArcEnd;
using map::ArcMatch;
using map::CutReason;
using map::KeyFeature;
using map::KeyImage;
using map::NodeScale;
using map::PathBridge;
using map::PathClosing;
using map::PathCut;
using map::TaughtPath;

}  // namespace homeward::repeat
