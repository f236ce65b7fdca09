// SPDX-License-Identifier: Apache-2.0
#include "tools/plc/plc_file.h"

#include <fmt/format.h>

#include "base/read_file.h"

namespace indurop::tools {

bool read_plc_file(Context& context, const std::string& file, std::string& bytes) {
  auto content = base::read_file(file);
  if (!content) {
    context.out.error(content.error().kind == base::FileProblem::Kind::NotRegular ||
                              content.error().kind == base::FileProblem::Kind::Directory
                          ? fmt::format("{}: this is not an ordinary file; give the path of the PLC program", file)
                          : base::cannot_read(file, content.error()));
    return false;
  }
  bytes = std::move(*content);
  return true;
}

void print_diagnostics(Context& context, const std::vector<base::Diagnostic>& diagnostics) {
  std::string text = base::to_text(diagnostics, "indurop plc");
  if (!text.empty()) {
    text.pop_back();  // message_line() ends the last line
    context.out.message_line(text);
  }
}

}  // namespace indurop::tools
