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

}  // namespace indurop::tools
