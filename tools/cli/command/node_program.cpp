// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/command/node_program.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/program_folder.h"
#include "tools/cli/command/become.h"

namespace indurop::tools {
namespace {

constexpr const char* kProgram = "indurop-node";

bool executable(const std::filesystem::path& file) {
  return access(file.c_str(), X_OK) == 0;
}

std::filesystem::path find() {
  const auto here = base::program_folder();
  std::vector<std::filesystem::path> places;
  if (!here.empty()) {
    places = {here / kProgram, here / "../libexec/indurop" / kProgram};
  }
  const char* path = std::getenv("PATH");
  std::string_view rest = path != nullptr ? path : "";
  while (!rest.empty()) {
    const auto colon = rest.find(':');
    const auto folder = rest.substr(0, colon);
    if (!folder.empty()) {
      places.emplace_back(std::filesystem::path(folder) / kProgram);
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

}  // namespace

std::filesystem::path node_program(Context& context) {
  auto program = find();
  if (program.empty()) {
    context.out.error(fmt::format("{} was found neither in the folder of this program nor in PATH", kProgram));
  }
  return program;
}

int become_node(Context& context, const std::filesystem::path& program, const config::RunOptions& options) {
  return become(context, program, config::words_of(options));
}

}  // namespace indurop::tools
