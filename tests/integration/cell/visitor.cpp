// SPDX-License-Identifier: Apache-2.0
// Conveyor, gripper, pallet and a visitor in a module of the schedule, for a cell that runs in virtual time: it takes
// the place of the I/O station. Property "presses": what the visitor does, as "start 1.00 1.30" (from, to, in s),
// parted by commas. At its end it prints how many parts were placed in all, after the last start, and lost, and how far
// the tool went in mm while it had to stand.
#include <indurop/indurop.h>

#include <indurop/generated.h>

#include <people.h>
#include <surroundings.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace {

struct Press {
  std::string what;
  double from = 0, to = 0;  // s
};

constexpr double kPeriod = 0.01;  // s, of module.xml
constexpr double kBrakes = 0.8;   // s within which the arm stands
std::vector<Press> presses;
Surroundings cell;
std::int64_t ticks = 0;
double stands_from = INFINITY;  // s
Tool stood;
double crept = 0;  // mm
std::uint32_t placed_before = 0;

void press(Panel& panel, const std::string& what) {
  panel.start |= what == "start";
  panel.reset |= what == "reset";
  panel.emergency_stop |= what == "stop";
  panel.curtain |= what == "curtain";
}

void measure(double time, const Panel& panel, const Tool& tool) {
  if (panel.start) {
    stands_from = INFINITY;
    placed_before = cell.placed();
  } else if ((panel.emergency_stop || panel.curtain) && std::isinf(stands_from)) {
    stands_from = time + kBrakes;
  }
  if (time <= stands_from) {
    stood = tool;
  }
  crept = std::max(crept, std::hypot(tool.x - stood.x, tool.y - stood.y, tool.z - stood.z));
}

}  // namespace

void start() {
  std::istringstream list(irp::property<std::string>("presses", ""));
  for (std::string one; std::getline(list, one, ',');) {
    Press next;
    std::istringstream(one) >> next.what >> next.from >> next.to;
    presses.push_back(next);
  }
}

void run() {
  const double time = kPeriod * static_cast<double>(ticks++);
  Panel panel;
  for (const Press& one : presses) {
    if (time >= one.from && time < one.to) {
      press(panel, one.what);
    }
  }
  const auto arm = PLC_ROBOT::ROBOT_ARM.get();
  const Tool tool{arm.position[0], arm.position[1], arm.position[2]};
  cell.step(kPeriod, {PLC_ROBOT::O0 != 0, PLC_ROBOT::O1 != 0, PLC_ROBOT::O5 != 0, PLC_ROBOT::O10 != 0}, tool);
  std::array<bool, 16> wired{};
  wire(panel, cell, [&wired](std::size_t input, bool value) { wired[input] = value; });
  PLC_ROBOT::I0 = wired[0];
  PLC_ROBOT::I1 = wired[1];
  PLC_ROBOT::I2 = wired[2];
  PLC_ROBOT::I3 = wired[3];
  PLC_ROBOT::I4 = wired[4];
  PLC_ROBOT::I5 = wired[5];
  PLC_ROBOT::I6 = wired[6];
  PLC_ROBOT::I7 = wired[7];
  PLC_ROBOT::I14 = wired[14];
  PLC_ROBOT::I15 = wired[15];
  measure(time, panel, tool);
}

void stop() {
  std::printf("placed %u, after the last start %u, lost %u, crept %.3f mm\n", cell.placed(),
              cell.placed() - placed_before, cell.lost(), crept);
}
