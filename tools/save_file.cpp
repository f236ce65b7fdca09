// SPDX-License-Identifier: Apache-2.0
#include "tools/save_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

namespace indurop::tools {

std::string save_file(const std::string& path, std::string_view content) {
  std::FILE* file = std::fopen(path.c_str(), "we");
  if (file == nullptr) {
    return fmt::format("cannot write {}: {}", path, std::strerror(errno));
  }
  const bool written = std::fwrite(content.data(), 1, content.size(), file) == content.size();
  const int write_error = errno;
  if (std::fclose(file) != 0 || !written) {
    return fmt::format("cannot write {}: {}", path, std::strerror(written ? errno : write_error));
  }
  return {};
}

}  // namespace indurop::tools
