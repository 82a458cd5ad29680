// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace homeward::testing {

/// The root of the project's sources.
std::filesystem::path project_folder();
/// Measuring data, which a user's machine has not; tests that read it skip where it is absent.
std::filesystem::path shared_folder();

}  // namespace homeward::testing
