// SPDX-License-Identifier: Apache-2.0
// Files of real buses, as the folder named by INDUROP_ETHERCAT_DATA has them.

#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

namespace indurop::io::ethercat {

inline std::filesystem::path real_data() {
  const char* const folder = std::getenv("INDUROP_ETHERCAT_DATA");
  return folder == nullptr ? std::filesystem::path() : std::filesystem::path(folder);
}

inline std::vector<std::uint8_t> bytes_of_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  EXPECT_TRUE(file.good()) << path;
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

}  // namespace indurop::io::ethercat

#define INDUROP_NEEDS_REAL_DATA()                                                        \
  if (real_data().empty()) {                                                             \
    GTEST_SKIP() << "INDUROP_ETHERCAT_DATA names no folder with captures of real buses"; \
  }
