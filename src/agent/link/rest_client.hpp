// SPDX-License-Identifier: Apache-2.0
#pragma once

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

/// REST calls to one server over one connection that is kept and made anew when it was lost. One thread at a time.
class RestClient {
 public:
  RestClient(ServerAddress address, std::string token);
  ~RestClient();
  RestClient(RestClient&&) noexcept;
  RestClient& operator=(RestClient&&) noexcept;

  /// Any answer of the server is a result, whatever its status. Errors: kIo when there is none after three tries, which
  /// the server knows as the same call.
  Result<RestAnswer> call(const std::string& method, const std::string& path, std::string_view body,
                          const std::map<std::string, std::string>& headers);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace homeward::agent
