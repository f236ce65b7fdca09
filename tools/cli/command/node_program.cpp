// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/command/node_program.h"

#include <fmt/format.h>

#include "tools/cli/command/become.h"
#include "tools/client/process/node_program.h"

namespace indurop::tools {
std::filesystem::path node_program(Context& context) {
  auto program = find_node_program();
  if (program.empty()) {
    context.out.error(fmt::format("{} was found neither in the folder of this program nor in PATH", kNodeProgram));
  }
  return program;
}

int become_node(Context& context, const std::filesystem::path& program, const config::RunOptions& options) {
  return become(context, program, config::words_of(options));
}

}  // namespace indurop::tools
