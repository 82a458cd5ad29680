// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace homeward {

/// Text as it may stand in HTML and SVG, between tags and in quoted attributes. Bytes that are no UTF-8, and control
/// characters, which no page may hold, become U+FFFD.
std::string escape_html(std::string_view text);

/// Text as it may stand in XML, between tags and in attributes in double quotes. Control characters that XML 1.0
/// forbids are left out; `text` has to be UTF-8 already.
std::string escape_xml(std::string_view text);

}  // namespace homeward
