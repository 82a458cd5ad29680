// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"

namespace homeward::linemodel {

/// What a field of a VRML node holds: numbers (TRUE is 1, FALSE is 0) or nodes; texts are left out.
struct VrmlField {
  std::vector<double> numbers;
  std::vector<std::size_t> nodes;  // indices into VrmlTree::nodes; each is smaller than that of the node it is in
};

struct VrmlNode {
  std::string_view type;  // letters of the text
  std::size_t line = 0;
  std::map<std::string_view, VrmlField> fields;
};

/// The nodes of a VRML97 text. A node may stand in several places (DEF and USE), but never inside itself.
struct VrmlTree {
  std::vector<VrmlNode> nodes;
  std::vector<std::size_t> roots;
};

/// The structure of a VRML97 text without what it means: every node with those of
/// its fields that say where lines and faces are. Routes, prototypes and scripts are
/// stepped over. `text` has to live as long as the tree; `where` names it in errors. Errors, each with its line:
/// kUnsupportedFormat (no VRML97 header), kInvalidInput (what does not follow the grammar, a USE without its DEF, nodes
/// more than 64 deep), kTooLarge (more than 2,000,000 nodes).
Result<VrmlTree> parse_vrml_tree(std::string_view text, const std::string& where);

}  // namespace homeward::linemodel
