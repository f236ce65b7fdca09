// SPDX-License-Identifier: Apache-2.0
// The remote I/O station of the cell and all that is wired to it: a program of its own outside of the schedule, reached
// by the I/O module over Modbus TCP. Coils 0 to 15 are O0 to O15, discrete inputs 0 to 15 are I0 to I15.
#include <indurop/indurop.h>

#include <indurop/generated.h>

#include <chrono>
#include <cstdio>
#include <string_view>

#include "modbus_server.h"
#include "people.h"

namespace {

using Seconds = std::chrono::duration<double>;
using Steady = std::chrono::steady_clock;

}  // namespace

int main() {
  const int port = irp::property<int>("port", 1502);
  ModbusServer station("127.0.0.1", port, 16, 16);
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
    const auto arm = INDUROP_TYPEOF(PLC_ROBOT::ROBOT_ARM)(PLC_ROBOT::ROBOT_ARM);
    cell.step(Seconds(now - last).count(), {station.coil(0), station.coil(1), station.coil(5), station.coil(10)},
              {arm.position[0], arm.position[1], arm.position[2]});
    last = now;
    wire(panel, cell, [&station](int input, bool value) { station.set_input(input, value); });
    show(cell, doing, station.requests());
    const auto next = now + std::chrono::milliseconds(5);
    while (Steady::now() < next) {
      if (!station.serve(1)) {
        std::fprintf(stderr, "world: port %d of 127.0.0.1 is in use; give another one in module.xml and ioconfig.xml\n",
                     port);
        return 1;
      }
    }
  }
}
