// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/command/become_server.h"

#include <fmt/format.h>
#include <unistd.h>

#include "core/base/exit_code.h"
#include "core/base/program_folder.h"
#include "tools/cli/command/become.h"

namespace indurop::tools {

int become_server(Context& context, const ServeOptions& options) {
  const auto program = base::program_folder() / "indurop-serve";
  if (access(program.c_str(), X_OK) != 0) {
    context.out.error(fmt::format("{} is missing; it must be in the folder of this program", program.string()));
    return kFailed;
  }
  std::vector<std::string> words = words_of(options);
  if (context.out.quiet()) {
    words.emplace_back("--quiet");
  }
  return become(context, program, std::move(words));
}

}  // namespace indurop::tools
