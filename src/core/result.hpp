// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace homeward {

/// What kind of thing went wrong. `wire/error_table` maps each code to HTTP status, problem type and exit code.
enum class ErrorCode {
  kInvalidInput,           // a value, file or message breaks its format
  kUnsupportedFormat,      // a format or version that this program does not read
  kUnsupportedImage,       // not a JPEG or PNG
  kTruncatedImage,         // the picture ends before its last row
  kImageTooLarge,          // more pixels or bytes than the limit
  kWrongImageSize,         // the picture does not have its camera's size
  kEmptyInput,             // nothing to work on
  kTooFewImages,           // fewer pictures than the method needs
  kTooFewFeatures,         // a picture without enough texture
  kTooLittleSupport,       // the geometry is not confirmed by enough matches
  kFeatureConfigMismatch,  // made with other feature settings: rebuild from the kept images
  kNotFound,
  kUnknownPlace,
  kNoRoute,
  kLost,
  kConflict,       // the state does not allow this now
  kStaleRevision,  // the edit was made against an older revision
  kUnauthenticated,
  kForbidden,
  kLeaseHeld,  // somebody else is driving
  kRobotOffline,
  kTooLarge,     // a request body over its limit
  kRateLimited,  // too many tries; wait
  kOverloaded,   // the work pool is full; try again later
  kCancelled,
  kCorruptFile,  // a file of ours that does not hold together
  kIo,           // disk, socket or process trouble
  kDiskFull,     // nothing more can be kept until somebody makes room
  kInternal,
};

/// An expected failure: what is wrong, and where (a file, a field, an id). Messages are whole sentences for people.
struct Error {
  ErrorCode code = ErrorCode::kInternal;
  std::string message;
  std::string where;
};

/// A value or the reason why there is none.
template <class T>
using Result = tl::expected<T, Error>;
using Status = Result<void>;

/// `return fail(ErrorCode::kNotFound, "There is no place p7.", "maps/3");`
inline tl::unexpected<Error> fail(ErrorCode code, std::string message, std::string where = {}) {
  return tl::unexpected<Error>(Error{code, std::move(message), std::move(where)});
}

/// Passes the error of one result on as the error of another type of result.
template <class T>
tl::unexpected<Error> pass_on(const Result<T>& failed) {
  return tl::unexpected<Error>(failed.error());
}

}  // namespace homeward
