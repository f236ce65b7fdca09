// SPDX-License-Identifier: Apache-2.0
#include "tools/plc_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace indurop::tools {

bool read_plc_file(Context& context, const std::string& file, std::string& bytes) {
  std::error_code error;
  if (std::filesystem::exists(file, error) && !std::filesystem::is_regular_file(file, error)) {
    context.out.error(fmt::format("{}: this is not an ordinary file; give the path of the PLC program", file));
    return false;
  }
  std::ifstream in(file, std::ios::binary);
  std::ostringstream content;
  if (!in || !(content << in.rdbuf())) {
    context.out.error(fmt::format("cannot read {}: {}", file, std::strerror(errno)));
    return false;
  }
  bytes = std::move(content).str();
  return true;
}

}  // namespace indurop::tools
