// SPDX-License-Identifier: Apache-2.0
// Reads and writes users.xml.

#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "config/model/users.h"
#include "core/base/diagnostics.h"

namespace indurop::config {

struct ReadUsers {
  PlantUsers users;  // meaningful only if ok
  std::vector<base::Diagnostic> diagnostics;
  [[nodiscard]] bool ok() const noexcept { return !base::has_error(diagnostics); }
};
// Reports all errors of the file at once. Not real-time safe.
ReadUsers read_users(const std::filesystem::path& file);
ReadUsers read_users_text(std::string_view xml, const std::filesystem::path& pretend_file);

// Returns the file for these users; read_users_text() returns the same users for it.
std::string users_text(const std::vector<PlantUser>& users);

// Returns true for 1 to 40 letters, digits, '.', '_' and '-'.
bool is_user_name(std::string_view name) noexcept;

}  // namespace indurop::config
