// SPDX-License-Identifier: Apache-2.0
#include "config/measured_times.h"

#include "config/check/report_times.h"

namespace indurop::config {

void add_times_option(base::Options& line, CheckOptions::Times& times) {
  line.add(
          "--times", "FILE", [&times](const std::string& file) { return read_measured_times(file, times); },
          "For modules without <wcet>, use the longest execution time in this report of indurop run --report")
      .completes(base::Completion::File);
}

}  // namespace indurop::config
