// SPDX-License-Identifier: Apache-2.0
#include "core/markup.hpp"

#include <gtest/gtest.h>

namespace homeward::markup_test {
namespace {

TEST(EscapeHtml, KeepsLettersAndReplacesWhatIsNone) {
  EXPECT_EQ(escape_html("Küche 厨房 🛏"), "Küche 厨房 🛏");
  EXPECT_EQ(escape_html("a\xC3"), "a\xEF\xBF\xBD");                                // cut short
  EXPECT_EQ(escape_html("\xC0\xAF"), "\xEF\xBF\xBD\xEF\xBF\xBD");                  // overlong
  EXPECT_EQ(escape_html("\xED\xA0\x80"), "\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD");  // half a surrogate pair
  EXPECT_EQ(escape_html(std::string_view("\0", 1)), "\xEF\xBF\xBD");
}

TEST(EscapeHtml, HoldsBetweenTagsAndInQuotedAttributes) {
  EXPECT_EQ(escape_html("<a href='x' title=\"y\"> & so on"),
            "&lt;a href=&#39;x&#39; title=&quot;y&quot;&gt; &amp; so on");
}

TEST(EscapeXml, LeavesOutWhatXmlForbids) {
  EXPECT_EQ(escape_xml("Anna's \"<Otto>\" & Küche"), "Anna's &quot;&lt;Otto&gt;&quot; &amp; Küche");
  EXPECT_EQ(escape_xml("a\x01"
                       "b\tc\n\r"),
            "ab\tc\n\r");
}

}  // namespace
}  // namespace homeward::markup_test
