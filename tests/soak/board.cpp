// SPDX-License-Identifier: Apache-2.0
// One board of the plant; OWN, OTHER and THIRD are frames, HEARD and TORN counts of this board.
#include <indurop/indurop.h>

#include <indurop/generated.h>

#include <cstdint>

using soak::Frame;

namespace {

std::uint64_t number = 0;
std::uint64_t last_of_other = 0;
std::uint64_t last_of_third = 0;
std::uint64_t heard = 0;
std::uint64_t torn = 0;

void check(const Frame& frame, std::uint64_t& last) {
  if (frame.number == last) {
    return;
  }
  last = frame.number;
  ++heard;
  for (const double value : frame.values) {
    if (value != static_cast<double>(frame.number)) {
      ++torn;
      return;
    }
  }
}

}  // namespace

void onRun() {
  Frame own{};
  own.number = ++number;
  for (double& value : own.values) {
    value = static_cast<double>(number);
  }
  soak::OWN = own;
  check(soak::OTHER, last_of_other);
  check(soak::THIRD, last_of_third);
  soak::HEARD = heard;
  soak::TORN = torn;
}

INDUROP_MODULE(run = &::onRun)
