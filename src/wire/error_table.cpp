// SPDX-License-Identifier: Apache-2.0
#include "wire/error_table.hpp"

#include <array>
#include <cstddef>

namespace homeward::wire {
namespace {

// Exit codes: 2 wrong use or input, 3 not found, 4 the data does not allow it, 5 disk or network, 6 refused, 70 a fault
// of ours, 130 cancelled.
constexpr std::array kTable = {
    ErrorRow{ErrorCode::kInvalidInput, "invalid_input", "The input breaks its format", 422, 2},
    ErrorRow{ErrorCode::kUnsupportedFormat, "unsupported_format", "This format or version is not read here", 422, 2},
    ErrorRow{ErrorCode::kUnsupportedImage, "unsupported_image", "Not a JPEG or PNG picture", 415, 2},
    ErrorRow{ErrorCode::kTruncatedImage, "truncated_image", "The picture ends too early", 422, 2},
    ErrorRow{ErrorCode::kImageTooLarge, "image_too_large", "The picture is too large", 413, 2},
    ErrorRow{ErrorCode::kWrongImageSize, "wrong_image_size", "The picture does not have its camera's size", 422, 2},
    ErrorRow{ErrorCode::kEmptyInput, "empty_input", "There is nothing to work on", 422, 2},
    ErrorRow{ErrorCode::kTooFewImages, "too_few_images", "Too few pictures", 422, 4},
    ErrorRow{ErrorCode::kTooFewFeatures, "too_few_features", "Too little to see in the pictures", 422, 4},
    ErrorRow{ErrorCode::kTooLittleSupport, "too_little_support", "The pictures do not confirm an answer", 422, 4},
    ErrorRow{ErrorCode::kFeatureConfigMismatch, "feature_config_mismatch", "Made with other feature settings", 409, 4},
    ErrorRow{ErrorCode::kNotFound, "not_found", "There is no such thing", 404, 3},
    ErrorRow{ErrorCode::kUnknownPlace, "unknown_place", "There is no such place", 404, 3},
    ErrorRow{ErrorCode::kNoRoute, "no_route", "There is no way to that place", 409, 4},
    ErrorRow{ErrorCode::kLost, "lost", "Where the robot is, is not known", 409, 4},
    ErrorRow{ErrorCode::kConflict, "conflict", "The present state does not allow this", 409, 4},
    ErrorRow{ErrorCode::kStaleRevision, "stale_revision", "The map has changed in the meantime", 412, 4},
    ErrorRow{ErrorCode::kUnauthenticated, "unauthenticated", "Sign in first", 401, 6},
    ErrorRow{ErrorCode::kForbidden, "forbidden", "Your role does not allow this", 403, 6},
    ErrorRow{ErrorCode::kLeaseHeld, "lease_held", "Somebody else is driving", 409, 6},
    ErrorRow{ErrorCode::kRobotOffline, "robot_offline", "The robot is not connected", 409, 4},
    ErrorRow{ErrorCode::kTooLarge, "too_large", "The request is too large", 413, 2},
    ErrorRow{ErrorCode::kRateLimited, "rate_limited", "Too many tries; wait a little", 429, 6},
    ErrorRow{ErrorCode::kOverloaded, "overloaded", "Busy; try again in a moment", 503, 5},
    ErrorRow{ErrorCode::kCancelled, "cancelled", "Cancelled", 409, 130},
    ErrorRow{ErrorCode::kCorruptFile, "corrupt_file", "The file does not hold together", 422, 2},
    ErrorRow{ErrorCode::kIo, "io", "Disk or network trouble", 500, 5},
    ErrorRow{ErrorCode::kDiskFull, "disk_full", "The disk is full", 507, 5},
    ErrorRow{ErrorCode::kInternal, "internal", "A fault of this program", 500, 70},
};

static_assert(kTable.size() == static_cast<std::size_t>(ErrorCode::kInternal) + 1, "one row for each code");

constexpr bool in_order() {
  for (std::size_t i = 0; i < kTable.size(); ++i) {
    if (static_cast<std::size_t>(kTable[i].code) != i) return false;
  }
  return true;
}
static_assert(in_order(), "rows in the order of the enumeration");

}  // namespace

std::span<const ErrorRow> error_table() { return kTable; }

const ErrorRow& error_row(ErrorCode code) { return kTable[static_cast<std::size_t>(code)]; }

const ErrorRow* error_row(std::string_view name) {
  for (const ErrorRow& row : kTable) {
    if (row.name == name) return &row;
  }
  return nullptr;
}

}  // namespace homeward::wire
