// SPDX-License-Identifier: Apache-2.0
#include "linemodel/vrml_lexer.hpp"

#include <charconv>
#include <cmath>
#include <cstdint>

namespace homeward::linemodel {
namespace {

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == ','; }

/// Whether a name or number ends before this character.
bool ends_word(char c) {
  const auto code = static_cast<unsigned char>(c);
  return code <= 0x20 || code == 0x7f || c == ',' || c == '"' || c == '#' || c == '\'' || c == '\\' || c == '[' ||
         c == ']' || c == '{' || c == '}';
}

bool begins_number(char c) { return (c >= '0' && c <= '9') || c == '+' || c == '-' || c == '.'; }

}  // namespace

std::string quoted(std::string_view word) {
  constexpr std::size_t kMost = 40;
  std::string text = "\"";
  for (const char c : word.substr(0, kMost)) text += c >= 0x20 && c < 0x7f ? c : '?';
  if (word.size() > kMost) text += "...";
  return text + "\"";
}

void VrmlLexer::skip_space() {
  for (; at_ < text_.size(); ++at_) {
    const char c = text_[at_];
    if (c == '#') {
      while (at_ + 1 < text_.size() && text_[at_ + 1] != '\n' && text_[at_ + 1] != '\r') ++at_;
    } else if (!is_space(c)) {
      return;
    } else if (c == '\n') {
      ++next_line_;
    }
  }
}

Status VrmlLexer::take_string() {
  const std::size_t begin = ++at_;
  for (; at_ < text_.size() && text_[at_] != '"'; ++at_) {
    if (text_[at_] == '\\' && at_ + 1 < text_.size()) ++at_;
    if (text_[at_] == '\n') ++next_line_;
  }
  if (at_ >= text_.size()) return fail(ErrorCode::kInvalidInput, "A text in quotation marks does not end.", where());
  word_ = text_.substr(begin, at_ - begin);
  token_ = VrmlToken::kString;
  ++at_;
  return {};
}

Status VrmlLexer::take_word() {
  const std::size_t begin = at_;
  while (at_ < text_.size() && !ends_word(text_[at_])) ++at_;
  if (at_ == begin) {
    return fail(ErrorCode::kInvalidInput, "The character " + quoted(text_.substr(at_, 1)) + " has no meaning here.",
                where());
  }
  word_ = text_.substr(begin, at_ - begin);
  token_ = VrmlToken::kName;
  if (!begins_number(word_.front())) return {};
  token_ = VrmlToken::kNumber;
  std::string_view digits = word_;
  if (digits.front() == '+') digits.remove_prefix(1);
  if (digits.starts_with("0x") || digits.starts_with("0X")) {  // of pictures' colours
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(digits.data() + 2, digits.data() + digits.size(), value, 16);
    number_ = static_cast<double>(value);
    if (error == std::errc() && end == digits.data() + digits.size()) return {};
  } else {
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number_);
    if (error == std::errc() && end == digits.data() + digits.size() && std::isfinite(number_)) return {};
  }
  return fail(ErrorCode::kInvalidInput, quoted(word_) + " is not a number that can be used.", where());
}

Status VrmlLexer::advance() {
  skip_space();
  line_ = next_line_;
  if (at_ >= text_.size()) {
    token_ = VrmlToken::kEnd;
    word_ = "the end of the file";
    return {};
  }
  const char c = text_[at_];
  if (c == '"') return take_string();
  const auto mark = [&](VrmlToken token) -> Status {
    token_ = token;
    word_ = text_.substr(at_++, 1);
    return {};
  };
  if (c == '[') return mark(VrmlToken::kOpenBracket);
  if (c == ']') return mark(VrmlToken::kCloseBracket);
  if (c == '{') return mark(VrmlToken::kOpenBrace);
  if (c == '}') return mark(VrmlToken::kCloseBrace);
  return take_word();
}

}  // namespace homeward::linemodel
