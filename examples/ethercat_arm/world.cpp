// SPDX-License-Identifier: Apache-2.0
// What surrounds the arm, as in the robot cell: conveyor, gripper, pallet and people. Sensors are wired to the input
// terminal on the bus; what the output terminal gets is what the PLC program and the jobs have set.
#include <indurop/indurop.h>

#include <indurop/files.h>
#include <indurop/generated.h>

#include <people.h>
#include <surroundings.h>

#include <chrono>
#include <csignal>
#include <cstddef>
#include <string_view>
#include <thread>

#include "terminal_wires.h"

namespace {

using Seconds = std::chrono::duration<double>;
using Steady = std::chrono::steady_clock;

}  // namespace

int main() {
  std::signal(SIGPIPE, SIG_IGN);  // NOLINT(cert-err33-c): the simulation may come and go
  TerminalWires wires(irp::file_beside_config(irp::property("script", "bus.fifo")));
  Surroundings cell;
  auto last = Steady::now();
  auto tour_began = last;
  bool on_tour = false;
  std::string_view doing;
  for (;;) {
    const auto now = Steady::now();
    if (CELL::tour != on_tour) {
      on_tour = CELL::tour;
      tour_began = now;
    }
    const Panel panel = pressed(on_tour ? Seconds(now - tour_began).count() : -1, doing);
    const auto arm = PLC_ROBOT::ROBOT_ARM.get();
    cell.step(Seconds(now - last).count(),
              {PLC_ROBOT::O0 != 0, PLC_ROBOT::O1 != 0, PLC_ROBOT::O5 != 0, PLC_ROBOT::O10 != 0},
              {arm.position[0], arm.position[1], arm.position[2]});
    last = now;
    wire(panel, cell, [&wires](std::size_t input, bool value) { wires.set(input, value); });
    wires.send();
    show(cell, doing, 0);
    std::this_thread::sleep_until(now + std::chrono::milliseconds(5));
  }
}
