// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace homeward::server {

/// One line that shows in any terminal what is in a text: characters that are not plain (wire::is_plain_line), and what
/// is not UTF-8, as \xHH for each byte, a backslash as two.
std::string plain_line(std::string_view text);

/// From now on every message of the program's log is one line, whatever somebody put into a name.
void log_in_plain_lines();

}  // namespace homeward::server
