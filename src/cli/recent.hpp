// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <list>
#include <map>
#include <memory>
#include <utility>

#include "core/result.hpp"

namespace homeward::cli {

/// What was made of the files asked for last, so that a list of pairs, which names most files often, makes it once.
template <typename Made>
class Recent {
 public:
  explicit Recent(std::size_t most) : most_(most) {}

  /// What is known of the file, or what `make` makes of it. Errors: those of `make`.
  template <typename Make>
  Result<std::shared_ptr<const Made>> get(const std::filesystem::path& file, const Make& make) {
    if (const auto known = places_.find(file); known != places_.end()) {
      order_.splice(order_.begin(), order_, known->second);
      return order_.front().second;
    }
    auto made = make(file);
    if (!made) return pass_on(made);
    order_.emplace_front(file, std::make_shared<const Made>(std::move(*made)));
    places_[file] = order_.begin();
    if (order_.size() > most_) {
      places_.erase(order_.back().first);
      order_.pop_back();
    }
    return order_.front().second;
  }

 private:
  using Order = std::list<std::pair<std::filesystem::path, std::shared_ptr<const Made>>>;

  std::size_t most_;
  Order order_;  // asked for last first
  std::map<std::filesystem::path, typename Order::iterator> places_;
};

}  // namespace homeward::cli
