// SPDX-License-Identifier: Apache-2.0
#include "config/check/report_times.h"

#include <algorithm>
#include <chrono>

#include "core/base/json.h"
#include "core/base/read_file.h"

namespace indurop::config {

std::string read_measured_times(const std::string& file, CheckOptions::Times& times) {
  const auto text = base::read_file(file);
  if (!text) {
    return base::cannot_read(file, text.error());
  }
  const auto report = base::Json::parse(*text);
  if (!report || !(*report)["modules"].is_array()) {
    return file + " is not a report; indurop run --report FILE writes one";
  }
  for (const base::Json& module : (*report)["modules"].values()) {
    const auto name = module["name"].text();
    const auto longest = module["exec_ns"]["max"].integer();
    if (name && longest && *longest > 0) {
      base::Nanos& time = times[*name];
      time = std::max(time, base::Nanos(*longest));
    }
  }
  return {};
}

}  // namespace indurop::config
