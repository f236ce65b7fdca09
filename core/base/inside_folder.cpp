// SPDX-License-Identifier: Apache-2.0
#include "core/base/inside_folder.h"

#include <algorithm>
#include <system_error>

namespace indurop::base {

bool lies_inside(const std::filesystem::path& file, const std::filesystem::path& folder) {
  std::error_code failed;
  const auto whole = std::filesystem::weakly_canonical(std::filesystem::absolute(file, failed), failed);
  if (failed) {
    return false;
  }
  const auto root =
      std::filesystem::weakly_canonical(std::filesystem::absolute(folder.empty() ? "." : folder, failed) / "", failed);
  if (failed) {
    return false;
  }
  const auto end = root.has_filename() ? root.end() : std::prev(root.end());  // "" after the last '/'
  return std::mismatch(root.begin(), end, whole.begin(), whole.end()).first == end;
}

}  // namespace indurop::base
