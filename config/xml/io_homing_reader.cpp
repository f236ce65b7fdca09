// SPDX-License-Identifier: Apache-2.0
#include "config/xml/io_homing_reader.h"

#include <fmt/format.h>

namespace indurop::config {

void read_io_homing(Attributes& attributes, IoDevice& device, base::Diagnostics& report) {
  constexpr int kMaxMethod = 37;
  IoAxis& axis = device.axis;
  const auto method = attributes.integer("homing", 1, kMaxMethod);
  if (!method) {
    return;
  }
  axis.homing = static_cast<int>(*method);
  // IEC 61800-7-201: 15, 16, 31 and 32 are reserved, 36 is not in use; 17 to 30 are 1 to 14 without the mark.
  constexpr int kLastWithMark = 14;
  constexpr int kFirstWithout = 17;
  constexpr int kLastWithout = 30;
  const int m = *axis.homing;
  const bool reserved = (m > kLastWithMark && m < kFirstWithout) || m == 31 || m == 32 || m == 36;
  const int edge = m >= kFirstWithout && m <= kLastWithout ? m - kFirstWithout + 1 : m;
  if (reserved) {
    report.error(device.place,
                 fmt::format("homing: there is no method {}; write 1 to 14, 17 to 30, 33 to 35 or 37", m));
  } else if ((edge == 1 && !axis.low_limit) || (edge == 2 && !axis.high_limit)) {
    report.error(device.place, fmt::format("homing: method {} needs a limit switch; give {}", m,
                                           edge == 1 ? "low_limit" : "high_limit"));
  } else if (edge > 2 && edge <= kLastWithMark && !axis.home_from && !axis.home_to) {
    report.error(device.place,
                 fmt::format("homing: method {} needs a home switch; give home_from, home_to or both", m));
  }
}

}  // namespace indurop::config
