// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/plc/plc_compiler.h"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>

#include "core/base/descriptor.h"
#include "core/base/read_file.h"
#include "tools/client/process/child.h"

namespace indurop::tools {
namespace {

namespace fs = std::filesystem;

// Returns whether a line of the log reports an error in the generated code, or in headers of InduRoP or of the
// variables.
bool blames_code(const std::string& log, const fs::path& code) {
  for (std::size_t from = 0; from < log.size();) {
    const std::size_t end = std::min(log.find('\n', from), log.size());
    const std::string line = log.substr(from, end - from);
    const std::size_t error = line.find("error: ");
    const std::size_t place =
        std::min({line.find(code.filename().string() + ":"), line.find("indurop/"), line.find(".glb.h:")});
    if (error != std::string::npos && place < error) {
      return true;
    }
    from = end + 1;
  }
  return false;
}

}  // namespace

bool run_compiler(Context& context, const std::vector<std::string>& arguments, const fs::path& code,
                  const std::string& sources) {
  fs::path log = code;
  log.replace_extension(".log");
  const base::Descriptor file(::open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644));
  const auto done = run_child(arguments, file.get());
  if (!done) {
    context.out.error(done.error().text);
    return false;
  }
  std::error_code ignored;
  if (*done == 0) {
    fs::remove(log, ignored);
    return true;
  }
  const auto printed = base::read_file(log);
  if (printed && blames_code(*printed, code)) {
    context.out.error(
        fmt::format("internal error: what indurop plc made of {} does not compile. This is a mistake of indurop, not "
                    "of the program: please report it with the program, {} and {}",
                    sources, code.string(), log.string()));
    return false;
  }
  if (printed && !printed->empty()) {
    context.out.error(*printed);
  }
  context.out.error(fmt::format("{} failed with exit code {}", arguments[0], *done));
  return false;
}

}  // namespace indurop::tools
