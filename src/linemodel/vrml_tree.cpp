// SPDX-License-Identifier: Apache-2.0
#include "linemodel/vrml_tree.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "linemodel/vrml_lexer.hpp"

namespace homeward::linemodel {
namespace {

constexpr int kMostDepth = 64;
constexpr std::size_t kMostNodes = 2'000'000;

/// The fields that say where lines and faces are.
constexpr std::array<std::string_view, 15> kKept = {
    "center",   "children", "choice", "convex",           "coord",       "coordIndex", "geometry", "level", "point",
    "rotation", "scale",    "size",   "scaleOrientation", "translation", "whichChoice"};

/// Recursive descent over the grammar of ISO/IEC 14772-1:1997, annex A. Every function begins at the token that it
/// reads and ends at the one after it.
class TreeParser {
 public:
  TreeParser(std::string_view text, const std::string& where) : lexer_(text, where) {}

  Result<VrmlTree> parse() {
    if (const Status begun = lexer_.advance(); !begun) return pass_on(begun);
    while (lexer_.token() != VrmlToken::kEnd) {
      if (const auto stepped = step_over_statement(); !stepped) {
        return pass_on(stepped);
      } else if (*stepped) {
        continue;
      }
      const auto node = parse_node(0);
      if (!node) return pass_on(node);
      tree_.roots.push_back(*node);
    }
    return std::move(tree_);
  }

 private:
  [[nodiscard]] tl::unexpected<Error> wrong(const std::string& message) const {
    return fail(ErrorCode::kInvalidInput, message, lexer_.where());
  }
  [[nodiscard]] bool at_name(std::string_view name) const {
    return lexer_.token() == VrmlToken::kName && lexer_.word() == name;
  }

  Result<std::string_view> take_name(const char* of_what) {
    if (lexer_.token() != VrmlToken::kName)
      return wrong(std::string("The name of ") + of_what + " has to stand in place of " + quoted(lexer_.word()) + ".");
    const std::string_view name = lexer_.word();
    if (const Status stepped = lexer_.advance(); !stepped) return pass_on(stepped);
    return name;
  }

  /// From an opening bracket or brace to behind the one that closes it, whatever stands between.
  Status step_over_brackets(VrmlToken open, VrmlToken close) {
    if (lexer_.token() != open) return wrong("A bracket has to stand in place of " + quoted(lexer_.word()) + ".");
    const std::string where = lexer_.where();
    std::size_t depth = 0;
    do {
      if (lexer_.token() == open) ++depth;
      if (lexer_.token() == close) --depth;
      if (lexer_.token() == VrmlToken::kEnd)
        return fail(ErrorCode::kInvalidInput, "A bracket is not closed before the end of the file.", where);
      if (const Status stepped = lexer_.advance(); !stepped) return stepped;
    } while (depth > 0);
    return {};
  }

  Status step_over_prototype(bool has_body) {
    if (const auto name = take_name("a prototype"); !name) return pass_on(name);
    if (const Status stepped = step_over_brackets(VrmlToken::kOpenBracket, VrmlToken::kCloseBracket); !stepped)
      return stepped;
    if (has_body) return step_over_brackets(VrmlToken::kOpenBrace, VrmlToken::kCloseBrace);
    if (lexer_.token() == VrmlToken::kString) return lexer_.advance();
    return step_over_brackets(VrmlToken::kOpenBracket, VrmlToken::kCloseBracket);
  }

  /// Steps over what is no node: ROUTE, PROTO, EXTERNPROTO. Whether it was one.
  Result<bool> step_over_statement() {
    const bool route = at_name("ROUTE");
    const bool prototype = at_name("PROTO");
    if (!route && !prototype && !at_name("EXTERNPROTO")) return false;
    if (const Status stepped = lexer_.advance(); !stepped) return pass_on(stepped);
    if (!route) {
      if (const Status stepped = step_over_prototype(prototype); !stepped) return pass_on(stepped);
      return true;
    }
    if (const auto from = take_name("a route's beginning"); !from) return pass_on(from);
    if (!at_name("TO")) return wrong("TO has to stand in place of " + quoted(lexer_.word()) + ".");
    if (const Status stepped = lexer_.advance(); !stepped) return pass_on(stepped);
    if (const auto to = take_name("a route's end"); !to) return pass_on(to);
    return true;
  }

  Result<std::size_t> parse_node(int depth) {
    if (depth >= kMostDepth)
      return wrong("Nodes lie more than " + std::to_string(kMostDepth) + " deep in one another.");
    if (at_name("USE")) return parse_use();
    std::string_view own_name;
    if (at_name("DEF")) {
      if (const Status stepped = lexer_.advance(); !stepped) return pass_on(stepped);
      const auto name = take_name("a node");
      if (!name) return pass_on(name);
      own_name = *name;
    }
    VrmlNode node;
    node.line = lexer_.line();
    const auto type = take_name("a node's type");
    if (!type) return pass_on(type);
    node.type = *type;
    const Status body = node.type == "Script" ? step_over_brackets(VrmlToken::kOpenBrace, VrmlToken::kCloseBrace)
                                              : parse_body(node, depth);
    if (!body) return pass_on(body);
    if (tree_.nodes.size() >= kMostNodes)
      return fail(ErrorCode::kTooLarge, "The file has more than 2,000,000 nodes.", lexer_.where());
    tree_.nodes.push_back(std::move(node));
    const std::size_t index = tree_.nodes.size() - 1;
    // Known from its end on, so that no node can be inside itself.
    if (!own_name.empty()) named_[own_name] = index;
    return index;
  }

  Result<std::size_t> parse_use() {
    if (const Status stepped = lexer_.advance(); !stepped) return pass_on(stepped);
    const auto found = lexer_.token() == VrmlToken::kName ? named_.find(lexer_.word()) : named_.end();
    if (found == named_.end()) return wrong("No node before here is named " + quoted(lexer_.word()) + ".");
    if (const Status stepped = lexer_.advance(); !stepped) return pass_on(stepped);
    return found->second;
  }

  Status parse_body(VrmlNode& node, int depth) {
    if (lexer_.token() != VrmlToken::kOpenBrace)
      return wrong("A brace has to stand in place of " + quoted(lexer_.word()) + ".");
    if (const Status stepped = lexer_.advance(); !stepped) return stepped;
    while (lexer_.token() != VrmlToken::kCloseBrace) {
      if (const auto stepped = step_over_statement(); !stepped) {
        return pass_on(stepped);
      } else if (*stepped) {
        continue;
      }
      const auto name = take_name("a field");
      if (!name) return pass_on(name);
      VrmlField field;
      if (const Status read = parse_value(field, depth); !read) return read;
      if (std::ranges::find(kKept, *name) != kKept.end()) node.fields[*name] = std::move(field);
    }
    return lexer_.advance();
  }

  /// A field's value: one in brackets ends there, numbers and texts end where a name follows.
  Status parse_value(VrmlField& field, int depth) {
    if (lexer_.token() == VrmlToken::kOpenBracket) {
      if (const Status stepped = lexer_.advance(); !stepped) return stepped;
      while (lexer_.token() != VrmlToken::kCloseBracket) {
        if (const Status read = parse_one(field, depth); !read) return read;
      }
      return lexer_.advance();
    }
    const bool scalar = lexer_.token() == VrmlToken::kNumber || lexer_.token() == VrmlToken::kString;
    do {
      if (const Status read = parse_one(field, depth); !read) return read;
    } while (scalar && (lexer_.token() == VrmlToken::kNumber || lexer_.token() == VrmlToken::kString));
    return {};
  }

  Status parse_one(VrmlField& field, int depth) {
    if (lexer_.token() == VrmlToken::kNumber) {
      field.numbers.push_back(lexer_.number());
      return lexer_.advance();
    }
    if (lexer_.token() == VrmlToken::kString || at_name("NULL")) return lexer_.advance();
    if (at_name("TRUE") || at_name("FALSE")) {
      field.numbers.push_back(at_name("TRUE") ? 1.0 : 0.0);
      return lexer_.advance();
    }
    if (lexer_.token() != VrmlToken::kName)
      return wrong("A value has to stand in place of " + quoted(lexer_.word()) + ".");
    const auto node = parse_node(depth + 1);
    if (!node) return pass_on(node);
    field.nodes.push_back(*node);
    return {};
  }

  VrmlLexer lexer_;
  VrmlTree tree_;
  std::map<std::string_view, std::size_t> named_;
};

}  // namespace

Result<VrmlTree> parse_vrml_tree(std::string_view text, const std::string& where) {
  if (text.starts_with("#VRML V1.0"))
    return fail(ErrorCode::kUnsupportedFormat, "The file is VRML 1.0; only VRML97 (\"#VRML V2.0 utf8\") is read.",
                where);
  if (!text.starts_with("#VRML V2.0 utf8"))
    return fail(ErrorCode::kUnsupportedFormat, "The file does not begin with \"#VRML V2.0 utf8\".", where);
  return TreeParser(text, where).parse();
}

}  // namespace homeward::linemodel
