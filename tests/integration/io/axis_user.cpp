// SPDX-License-Identifier: Apache-2.0
// Enables the drive of Figure 11 as a real one wants it, then moves it a little every period.
#include <indurop/generated.h>
#include <indurop/indurop.h>

using namespace TEST_CELL;

namespace {
constexpr std::uint16_t kEnabled = 0x27;
constexpr std::uint16_t kStateBits = 0x6F;

std::uint16_t next_control(std::uint16_t status) {
  constexpr std::uint16_t kShutdown = 6;
  constexpr std::uint16_t kSwitchOn = 7;
  constexpr std::uint16_t kEnable = 15;
  switch (status & kStateBits) {
    case 0x21:
      return kSwitchOn;
    case 0x23:
    case kEnabled:
      return kEnable;
    default:
      return kShutdown;
  }
}
}  // namespace

void onRun() {
  const auto in = AXIS1_IN.get();
  auto out = AXIS1_OUT.get();
  out.mode = 8;
  out.control = next_control(in.status);
  out.position = (in.status & kStateBits) == kEnabled ? out.position + 100 : in.position;
  AXIS1_OUT = out;
}

INDUROP_MODULE(run = &::onRun)
