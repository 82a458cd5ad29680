// SPDX-License-Identifier: Apache-2.0
#include "contract/yaml.hpp"

#include <charconv>
#include <stdexcept>
#include <vector>

namespace homeward::testing {
namespace {

using nlohmann::json;

struct Line {
  std::size_t number = 0;
  std::size_t indent = 0;
  std::string text;  // without indent
};

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(' ');
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(' ') - first + 1);
}

json plain(const std::string& text) {
  if (text == "null" || text == "~" || text.empty()) return nullptr;
  if (text == "true" || text == "false") return text == "true";
  double number = 0.0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (problem == std::errc{} && end == text.data() + text.size()) {
    const bool whole = text.find_first_of(".eE") == std::string::npos;
    return whole ? json(static_cast<std::int64_t>(number)) : json(number);
  }
  return text;
}

/// Reads one value in flow style, such as {a: [1, 'b c']}.
class Flow {
 public:
  Flow(const std::string& text, std::size_t line) : text_(text), line_(line) {}

  json all() {
    json value = read();
    skip();
    if (at_ != text_.size()) fail("text after a value");
    return value;
  }

 private:
  [[noreturn]] void fail(const std::string& why) const {
    throw std::runtime_error("line " + std::to_string(line_) + ": " + why + " in " + text_);
  }
  void skip() {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
  }
  char next() {
    skip();
    if (at_ >= text_.size()) fail("an end too early");
    return text_[at_];
  }
  json read() {
    const char c = next();
    if (c == '{') return map();
    if (c == '[') return list();
    if (c == '\'') return quoted();
    const std::size_t end = std::min(text_.find_first_of(",]}", at_), text_.size());
    const std::string word = trimmed(text_.substr(at_, end - at_));
    at_ = end;
    return plain(word);
  }
  std::string quoted() {
    std::string word;
    for (++at_; at_ < text_.size(); ++at_) {
      if (text_[at_] == '\'') {
        if (at_ + 1 >= text_.size() || text_[at_ + 1] != '\'') break;
        ++at_;
      }
      word += text_[at_];
    }
    if (at_ >= text_.size()) fail("a quote that does not end");
    ++at_;
    return word;
  }
  json map() {
    json value = json::object();
    ++at_;
    while (next() != '}') {
      std::string key;
      if (text_[at_] == '\'') {
        key = quoted();
      } else {
        const std::size_t end = text_.find(':', at_);
        if (end == std::string::npos) fail("a key without a value");
        key = trimmed(text_.substr(at_, end - at_));
        at_ = end;
      }
      if (next() != ':') fail("a key without a value");
      ++at_;
      if (value.contains(key)) fail("the key " + key + " twice");
      value[key] = read();
      if (next() == ',') ++at_;
    }
    ++at_;
    return value;
  }
  json list() {
    json value = json::array();
    ++at_;
    while (next() != ']') {
      value.push_back(read());
      if (next() == ',') ++at_;
    }
    ++at_;
    return value;
  }

  const std::string& text_;
  std::size_t line_;
  std::size_t at_ = 0;
};

class Block {
 public:
  explicit Block(const std::string& text) {
    std::size_t number = 0;
    for (std::size_t begin = 0; begin < text.size();) {
      const std::size_t end = std::min(text.find('\n', begin), text.size());
      const std::string line = text.substr(begin, end - begin);
      begin = end + 1;
      ++number;
      const std::size_t indent = line.find_first_not_of(' ');
      if (indent == std::string::npos || line[indent] == '#') continue;
      lines_.push_back({number, indent, line.substr(indent)});
    }
  }

  json all() {
    json value = block();
    if (at_ != lines_.size()) fail("an indent that fits nowhere");
    return value;
  }

 private:
  [[noreturn]] void fail(const std::string& why) const {
    const std::string line = at_ < lines_.size() ? std::to_string(lines_[at_].number) : "last";
    throw std::runtime_error("line " + line + ": " + why);
  }

  /// Where the key of a line ends, or npos when it has none.
  static std::size_t key_end(const std::string& text) {
    if (text.front() == '\'') {
      const std::size_t end = text.find('\'', 1);
      return end != std::string::npos && end + 1 < text.size() && text[end + 1] == ':' ? end + 1 : std::string::npos;
    }
    if (text.front() == '{' || text.front() == '[') return std::string::npos;
    const std::size_t inner = text.find(": ");
    if (inner != std::string::npos) return inner;
    return text.back() == ':' ? text.size() - 1 : std::string::npos;
  }

  json block() {
    const std::size_t indent = lines_[at_].indent;
    if (lines_[at_].text.rfind("- ", 0) == 0) return list(indent);
    if (key_end(lines_[at_].text) != std::string::npos) return map(indent);
    const std::string text = lines_[at_++].text;
    return scalar(text, indent == 0 ? 0 : indent - 1);
  }

  json list(std::size_t indent) {
    json value = json::array();
    while (at_ < lines_.size() && lines_[at_].indent == indent && lines_[at_].text.rfind("- ", 0) == 0) {
      // The item begins on the line of its dash: read it as a line of its own, further in.
      lines_[at_].text = lines_[at_].text.substr(2);
      lines_[at_].indent += 2;
      value.push_back(block());
    }
    return value;
  }

  json map(std::size_t indent) {
    json value = json::object();
    while (at_ < lines_.size() && lines_[at_].indent == indent) {
      const std::string text = lines_[at_].text;
      const std::size_t end = key_end(text);
      if (end == std::string::npos) fail("no key");
      std::string key = text.substr(0, end);
      if (key.front() == '\'') key = key.substr(1, key.size() - 2);
      if (value.contains(key)) fail("the key " + key + " twice");
      const std::string rest = trimmed(text.substr(end + 1));
      ++at_;
      if (!rest.empty()) {
        value[key] = scalar(rest, indent);
      } else {
        const bool inside = at_ < lines_.size() && lines_[at_].indent > indent;
        value[key] = inside ? block() : json(nullptr);
      }
    }
    return value;
  }

  /// A value that begins on the line before and goes on in lines further in than `indent`.
  json scalar(const std::string& first, std::size_t indent) {
    std::string text = first == ">-" || first == "|" ? "" : first;
    const std::size_t line = at_ == 0 ? 0 : lines_[at_ - 1].number;
    while (at_ < lines_.size() && lines_[at_].indent > indent) text += (text.empty() ? "" : " ") + lines_[at_++].text;
    if (first == ">-" || first == "|") return text;
    const char begin = first.front();
    return begin == '{' || begin == '[' || begin == '\'' ? Flow(text, line).all() : plain(text);
  }

  std::vector<Line> lines_;
  std::size_t at_ = 0;
};

}  // namespace

json parse_yaml(const std::string& text) { return Block(text).all(); }

}  // namespace homeward::testing
