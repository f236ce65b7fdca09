// SPDX-License-Identifier: Apache-2.0
// Golden cases: a folder each, with an input and what is expected of it. INDUROP_UPDATE_GOLDEN=1 writes the
// expectations.

#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace indurop::golden {

inline bool updating() {
  return std::getenv("INDUROP_UPDATE_GOLDEN") != nullptr;
}

inline std::string slurp(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream content;
  content << in.rdbuf();
  return content.str();
}

// A text that is empty has no file.
inline void expect_file(const std::filesystem::path& path, const std::string& text) {
  if (updating()) {
    if (text.empty()) {
      std::filesystem::remove(path);
    } else {
      std::ofstream(path, std::ios::binary) << text;
    }
    return;
  }
  EXPECT_EQ(text.empty(), !std::filesystem::exists(path)) << path;
  EXPECT_EQ(slurp(path), text) << path;
}

// Names of the folders with such an input, sorted.
inline std::vector<std::string> cases(const std::filesystem::path& folder, const char* input) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (std::filesystem::exists(entry.path() / input)) {
      names.push_back(entry.path().filename().string());
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace indurop::golden
