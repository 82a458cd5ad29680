// SPDX-License-Identifier: Apache-2.0
#include "files/grey_map.hpp"

#include <algorithm>
#include <cctype>
#include <optional>

#include "files/read_file.hpp"

namespace homeward::files {
namespace {

/// Reads the header's words: white space and comments lie between them (Netpbm's pgm(5)).
class Header {
 public:
  explicit Header(const std::string& text) : text_(text) {}

  std::optional<int> number() {
    skip();
    int value = 0;
    const std::size_t first = at_;
    while (at_ < text_.size() && std::isdigit(static_cast<unsigned char>(text_[at_])) != 0 && at_ - first < 7) {
      value = 10 * value + (text_[at_++] - '0');
    }
    return at_ == first ? std::nullopt : std::optional(value);
  }
  /// Where the pixels begin: after the one white space behind the last number.
  [[nodiscard]] std::size_t pixels() const { return at_ + 1; }
  void skip_magic() { at_ = 2; }

 private:
  void skip() {
    while (at_ < text_.size()) {
      if (text_[at_] == '#') {
        while (at_ < text_.size() && text_[at_] != '\n') ++at_;
      } else if (std::isspace(static_cast<unsigned char>(text_[at_])) == 0) {
        return;
      } else {
        ++at_;
      }
    }
  }

  const std::string& text_;
  std::size_t at_ = 0;
};

}  // namespace

Result<Image> read_grey_map(const std::filesystem::path& file) {
  const auto text = read_text(file);
  if (!text) return pass_on(text);
  if (!text->starts_with("P5")) return fail(ErrorCode::kInvalidInput, "This is no binary PGM picture.", file.string());
  Header header(*text);
  header.skip_magic();
  const auto width = header.number();
  const auto height = header.number();
  const auto most = header.number();
  if (!width || !height || !most || *width < 1 || *height < 1 || *most != 255) {
    return fail(ErrorCode::kInvalidInput, "The PGM header must give width, height and 255.", file.string());
  }
  constexpr int kMaxSide_px = 20'000;
  if (*width > kMaxSide_px || *height > kMaxSide_px) {
    return fail(ErrorCode::kImageTooLarge, "A floor picture may have at most 20000 x 20000 cells.", file.string());
  }
  const auto count = static_cast<std::size_t>(*width) * static_cast<std::size_t>(*height);
  if (text->size() < header.pixels() + count) {
    return fail(ErrorCode::kTruncatedImage, "The picture ends before its last row.", file.string());
  }
  Image image(*width, *height, 1);
  std::copy_n(text->begin() + static_cast<std::ptrdiff_t>(header.pixels()), image.data.size(), image.data.begin());
  return image;
}

}  // namespace homeward::files
