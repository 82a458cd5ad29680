// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <regex>
#include <string>
#include <vector>

namespace homeward::testing {

/// What keeps a page from being well-formed: tags that do not match, bare `<` and `&`, attributes without quotes.
/// Empty when nothing does. The content of <style> is not looked at.
inline std::string markup_problem(const std::string& page) {
  static const std::regex kTag(R"re(^<(/?)([A-Za-z][A-Za-z0-9]*)((?:\s+[A-Za-z][A-Za-z0-9:-]*="[^"<]*")*)\s*(/?)>)re");
  static const std::regex kEntity(R"(^&(amp|lt|gt|quot|#[0-9]+);)");
  const std::string doctype = "<!DOCTYPE html>";
  std::vector<std::string> open;
  for (std::size_t i = page.rfind(doctype, 0) == 0 ? doctype.size() : 0; i < page.size(); ++i) {
    const auto here = page.begin() + static_cast<std::ptrdiff_t>(i);
    std::smatch match;
    if (page[i] == '&' && !std::regex_search(here, page.end(), match, kEntity))
      return "bare & at " + page.substr(i, 40);
    if (page[i] != '<') continue;
    // Long attributes, such as pictures, would be too much for the regular expression.
    const std::size_t end = page.find('>', i);
    if (end == std::string::npos) return "no end of the tag at " + page.substr(i, 40);
    std::string tag = page.substr(i, end - i + 1);
    for (std::size_t data = tag.find("\"data:"); data != std::string::npos; data = tag.find("\"data:", data + 1)) {
      tag.erase(data + 1, tag.find('"', data + 1) - data - 1);
    }
    if (!std::regex_match(tag, match, kTag)) return "no tag: " + tag.substr(0, 200);
    const std::string name = match[2];
    i = end;
    if (match[1] == "/") {
      if (open.empty() || open.back() != name)
        return "</" + name + "> closes " + (open.empty() ? "nothing" : open.back());
      open.pop_back();
    } else if (match[4] != "/") {
      open.push_back(name);
      if (name == "style") i = page.find("</style>", i) - 1;
    }
  }
  return open.empty() ? "" : "<" + open.back() + "> is not closed";
}

}  // namespace homeward::testing
