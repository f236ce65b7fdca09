// SPDX-License-Identifier: Apache-2.0
#include "tools/client/process/node_program.h"

#include <unistd.h>

#include <cstdlib>
#include <string_view>
#include <vector>

#include "core/base/program_folder.h"

namespace indurop::tools {
namespace {

bool executable(const std::filesystem::path& file) {
  return access(file.c_str(), X_OK) == 0;
}

}  // namespace

std::filesystem::path find_node_program() {
  const auto here = base::program_folder();
  std::vector<std::filesystem::path> places;
  if (!here.empty()) {
    places = {here / kNodeProgram, here / "../libexec/indurop" / kNodeProgram};
  }
  const char* path = std::getenv("PATH");
  std::string_view rest = path != nullptr ? path : "";
  while (!rest.empty()) {
    const auto colon = rest.find(':');
    const auto folder = rest.substr(0, colon);
    if (!folder.empty()) {
      places.emplace_back(std::filesystem::path(folder) / kNodeProgram);
    }
    rest = colon == std::string_view::npos ? "" : rest.substr(colon + 1);
  }
  for (const auto& place : places) {
    if (executable(place)) {
      return place;
    }
  }
  return {};
}

}  // namespace indurop::tools
