// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "core/result.hpp"

namespace homeward::linemodel {

enum class VrmlToken { kEnd, kName, kNumber, kString, kOpenBracket, kCloseBracket, kOpenBrace, kCloseBrace };

/// The tokens of a VRML97 text, one after another (ISO/IEC 14772-1:1997, annex A). Commas are white space, comments run
/// from # to the line's end. A view: the text has to live as long.
class VrmlLexer {
 public:
  /// `where` names the text in errors.
  VrmlLexer(std::string_view text, std::string where) : text_(text), where_(std::move(where)) {}

  /// Steps to the next token. Errors: kInvalidInput for a number that is none or has no finite value, for a string
  /// that nobody ends, and for a character that stands for nothing.
  Status advance();

  [[nodiscard]] VrmlToken token() const { return token_; }
  /// A name's letters; of other tokens what is written.
  [[nodiscard]] std::string_view word() const { return word_; }
  /// A number's value.
  [[nodiscard]] double number() const { return number_; }
  /// "NAME:LINE" of the token.
  [[nodiscard]] std::string where() const { return where(line_); }
  [[nodiscard]] std::string where(std::size_t line) const { return where_ + ":" + std::to_string(line); }
  [[nodiscard]] std::size_t line() const { return line_; }

 private:
  void skip_space();
  Status take_string();
  Status take_word();

  std::string_view text_;
  std::string where_;
  std::size_t at_ = 0;
  std::size_t next_line_ = 1;  // at at_
  std::size_t line_ = 1;       // of the token
  VrmlToken token_ = VrmlToken::kEnd;
  std::string_view word_;
  double number_ = 0.0;
};

/// What a foreign word is called in a message: in quotation marks, short, without what is no plain letter.
std::string quoted(std::string_view word);

}  // namespace homeward::linemodel
