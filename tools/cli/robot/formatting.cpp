// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/robot/formatting.h"

#include <fmt/format.h>

#include <filesystem>
#include <string>

#include "control/robot/job/format.h"
#include "core/base/read_file.h"
#include "core/base/replace_file.h"

namespace indurop::tools {

int format_jobs(Context& context, const FormatOrder& order) {
  int code = kOk;
  for (const std::string& file : order.files) {
    const auto text = base::read_file(file);
    if (!text) {
      context.out.error(fmt::format("cannot read {}: {}", file, text.error().text));
      code = kFailed;
      continue;
    }
    if (std::filesystem::path(file).extension() != ".job" || text->find('\0') != std::string::npos) {
      context.out.error(file + " is no job file, NAME.job with text");
      code = kFailed;
      continue;
    }
    const std::string formatted = robot::format_job({file, *text});
    if (formatted == *text) {
      continue;
    }
    if (order.check) {
      context.out.line(fmt::format("{} is not formatted", file));
      code = code == kOk ? kCheckFailed : code;
    } else if (const auto written = base::replace_file(file, formatted, base::Durable::Yes); !written) {
      context.out.error(fmt::format("cannot write {}: {}", file, written.error().text));
      code = kFailed;
    } else {
      context.out.line(fmt::format("formatted {}", file));
    }
  }
  return code;
}

}  // namespace indurop::tools
