// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>

#include "server/http/message.hpp"

namespace homeward::server {

/// Sends text with gzip (RFC 1952) to who takes it, which makes graphs and scripts a fifth to a tenth as long. What has
/// an entity tag is compressed once. Callable from any thread.
class CompressedAnswers {
 public:
  static constexpr std::size_t kLeast_bytes = 1024;  // a shorter answer gains nothing
  static constexpr std::size_t kMostKept_bytes = 32UL << 20;

  /// Compresses the body where the request accepts it and it is text; the entity tag becomes a weak one, as the bytes
  /// are not those of the tag's text. Always says that the answer depends on what is accepted.
  void compress(const Request& request, Response& response);

 private:
  struct Kept {
    std::string key;  // path, query and entity tag
    std::shared_ptr<const std::string> bytes;
  };
  std::shared_ptr<const std::string> kept(const std::string& key);
  void keep(Kept answer);

  std::mutex mutex_;
  std::deque<Kept> kept_;  // the newest last
  std::size_t bytes_ = 0;
};

/// Whether an Accept-Encoding header (RFC 9110 section 12.5.3) takes gzip.
bool accepts_gzip(std::string_view accept_encoding);

/// The gzip format. Throws std::runtime_error where there is no memory for it.
std::string gzip(std::string_view text);

}  // namespace homeward::server
