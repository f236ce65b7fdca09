// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/command/become.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>

namespace indurop::tools {

int become(Context& context, const std::filesystem::path& program, std::vector<std::string> words) {
  words.insert(words.begin(), program.string());
  std::vector<char*> raw;
  for (std::string& word : words) {
    raw.push_back(word.data());
  }
  raw.push_back(nullptr);
  context.out.flush();
  signal(SIGPIPE, SIG_DFL);  // ignoring it would be inherited
  execv(program.c_str(), raw.data());
  context.out.error(fmt::format("cannot start {}: {}", program.string(), std::strerror(errno)));
  return kFailed;
}

}  // namespace indurop::tools
