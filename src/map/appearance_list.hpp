// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <initializer_list>
#include <iterator>
#include <memory>
#include <utility>
#include <vector>

#include "core/ids.hpp"
#include "features/appearance.hpp"

namespace homeward::map {

/// The appearances of a place, the prototype's first. They are nearly all of a map's bytes and hardly ever change:
/// copies of a list share them, so that a map can be copied, edited and taken back cheaply. A value type all the same:
/// what is changed in one list stays as it was in all others.
class AppearanceList {
 public:
  using Shared = std::shared_ptr<const features::Appearance>;
  /// An appearance, and the picture that it was taken from where that is known.
  struct Entry {
    Shared appearance;
    ImageId image;
    bool operator==(const Entry&) const = default;  // the very same appearance
  };

  class Iterator {
   public:
    using iterator_category = std::forward_iterator_tag;
    using value_type = features::Appearance;
    using difference_type = std::ptrdiff_t;
    using pointer = const features::Appearance*;
    using reference = const features::Appearance&;

    Iterator() = default;
    explicit Iterator(const Entry* at) : at_(at) {}
    reference operator*() const { return *at_->appearance; }
    pointer operator->() const { return at_->appearance.get(); }
    Iterator& operator++() { return ++at_, *this; }
    Iterator operator++(int) { return Iterator(at_++); }
    friend bool operator==(Iterator a, Iterator b) { return a.at_ == b.at_; }

   private:
    const Entry* at_ = nullptr;
  };

  AppearanceList() = default;
  AppearanceList(std::initializer_list<features::Appearance> appearances) {
    for (const features::Appearance& one : appearances) push_back(one);
  }

  [[nodiscard]] bool empty() const { return entries_.empty(); }
  [[nodiscard]] std::size_t size() const { return entries_.size(); }
  [[nodiscard]] const features::Appearance& operator[](std::size_t i) const { return *entries_[i].appearance; }
  [[nodiscard]] const features::Appearance& at(std::size_t i) const { return *entries_.at(i).appearance; }
  [[nodiscard]] const features::Appearance& front() const { return *entries_.front().appearance; }
  [[nodiscard]] Iterator begin() const { return Iterator(entries_.data()); }
  [[nodiscard]] Iterator end() const { return Iterator(entries_.data() + entries_.size()); }
  [[nodiscard]] const std::vector<Entry>& entries() const { return entries_; }

  void push_back(features::Appearance appearance, ImageId image = {}) {
    entries_.push_back({std::make_shared<const features::Appearance>(std::move(appearance)), std::move(image)});
  }
  void push_back(Entry entry) { entries_.push_back(std::move(entry)); }
  void append(const AppearanceList& others) {
    entries_.insert(entries_.end(), others.entries_.begin(), others.entries_.end());
  }
  void replace(std::size_t i, features::Appearance appearance, ImageId image) {
    entries_.at(i) = {std::make_shared<const features::Appearance>(std::move(appearance)), std::move(image)};
  }
  void replace(std::size_t i, Entry entry) { entries_.at(i) = std::move(entry); }
  /// The first `count`; empty ones (no features) where there are fewer.
  void resize(std::size_t count) {
    while (entries_.size() < count) push_back(features::Appearance{});
    entries_.resize(count);
  }

  /// The very same appearances from the same pictures.
  bool operator==(const AppearanceList&) const = default;

 private:
  std::vector<Entry> entries_;
};

}  // namespace homeward::map
