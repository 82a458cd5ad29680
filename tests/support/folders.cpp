// SPDX-License-Identifier: Apache-2.0
#include "support/folders.hpp"

namespace homeward::testing {

std::filesystem::path project_folder() { return HOMEWARD_SOURCE_DIR; }

std::filesystem::path shared_folder() { return project_folder() / ".." / "shared"; }

}  // namespace homeward::testing
