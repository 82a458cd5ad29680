// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "agent/link/address.hpp"

namespace homeward::agent {

struct RestAnswer {
  int status = 0;
  std::string body;
};

/// REST calls to one server over one connection that is kept and made anew when it was lost. A server that is silent
/// for `most_silence` in the middle of a call is not waited for. One thread at a time.
class RestClient {
 public:
  RestClient(ServerAddress address, std::string token,
             std::chrono::milliseconds most_silence = std::chrono::seconds(60));
  ~RestClient();
  RestClient(RestClient&&) noexcept;
  RestClient& operator=(RestClient&&) noexcept;

  /// Any answer of the server is a result, whatever its status; one of more than 64 MiB is none. Errors: kIo when there
  /// is none after three tries, which the server knows as the same call, or when the server falls silent.
  Result<RestAnswer> call(const std::string& method, const std::string& path, std::string_view body,
                          const std::map<std::string, std::string>& headers);

  /// An answer of any size (up to 16 GiB), into a new file; no part of it is left there after an error.
  /// Errors: kNotFound when the server knows nothing there, kIo when it says something else but that it is there, falls
  /// silent, cannot be reached after three tries, or the file cannot be written.
  Status download(const std::string& path, const std::filesystem::path& file);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace homeward::agent
