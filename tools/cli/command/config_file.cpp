// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/command/config_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace indurop::tools {

Result<std::string, Failure> find_config(const std::string& file) {
  std::error_code ignored;
  const auto exists = [&ignored](const std::string& name) { return std::filesystem::exists(name, ignored); };
  if (!file.empty() && !exists(file)) {
    return Failure{kFailed, fmt::format("there is no file '{}'", file)};
  }
  if (!file.empty()) {
    return file;
  }
  for (const char* name : {"module.xml", "plant.xml"}) {
    if (exists(name)) {
      return std::string(name);
    }
  }
  return Failure{kUsage, "there is no module.xml or plant.xml here; say which file to read"};
}

Result<std::string, Failure> absolute_name(const std::string& file) {
  std::error_code failed;
  const std::filesystem::path whole = std::filesystem::absolute(file, failed);
  if (failed) {
    return Failure{kFailed, fmt::format("{}: the current folder does not exist any more", file)};
  }
  return whole.lexically_normal().string();
}

}  // namespace indurop::tools
