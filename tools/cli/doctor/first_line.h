// SPDX-License-Identifier: Apache-2.0
// Reads the first line of a file below /proc or /sys.

#pragma once

#include <filesystem>
#include <fstream>
#include <string>

namespace indurop::tools {

// Empty if the file cannot be read.
inline std::string first_line(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  return line;
}

}  // namespace indurop::tools
