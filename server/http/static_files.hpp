// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "server/http/message.hpp"

namespace homeward::server {

/// The files of the built dashboard. A path without a file extension that names no file is a page of the dashboard and
/// gets index.html.
class StaticFiles {
 public:
  /// `folder`: empty when there is no dashboard.
  explicit StaticFiles(std::filesystem::path folder);
  [[nodiscard]] Response serve(const Request& request) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace homeward::server
