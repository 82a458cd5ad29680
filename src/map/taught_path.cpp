// SPDX-License-Identifier: Apache-2.0
#include "map/taught_path.hpp"

#include <algorithm>

namespace homeward::map {

std::optional<int> TaughtPath::arc_from(int key) const {
  const auto found = std::ranges::lower_bound(arcs, key, {}, &PathArc::from);
  if (found == arcs.end() || found->from != key) return std::nullopt;
  return static_cast<int>(found - arcs.begin());
}

std::optional<int> TaughtPath::arc_after(int arc) const {
  return arc_from(to_key(arcs[static_cast<std::size_t>(arc)]));
}

std::optional<int> TaughtPath::arc_before(int arc) const {
  const int key = arcs[static_cast<std::size_t>(arc)].from;
  if (closing && closing->key_image == key) return static_cast<int>(arcs.size()) - 1;
  return arc_from(key - 1);
}

}  // namespace homeward::map
