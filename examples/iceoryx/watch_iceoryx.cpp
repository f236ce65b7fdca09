// SPDX-License-Identifier: Apache-2.0
// Prints what the meter has measured, with iceoryx's C++ interface: nothing of InduRoP.
//   watch_iceoryx NODE [COUNT]    default: until Ctrl-C
#include <unistd.h>

#include <chrono>
#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>

#include <iceoryx_posh/popo/subscriber.hpp>
#include <iceoryx_posh/runtime/posh_runtime.hpp>

#include "reading.h"

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: watch_iceoryx NODE [COUNT]\n");
    return 2;
  }
  long left = argc > 2 ? std::strtol(argv[2], nullptr, 10) : -1;
  using iox::cxx::TruncateToCapacity;
  const std::string name = "watch_iceoryx-" + std::to_string(getpid());
  // Without RouDi this waits for a minute and then ends the program.
  iox::runtime::PoshRuntime::initRuntime(iox::RuntimeName_t(TruncateToCapacity, name.c_str()));

  iox::popo::SubscriberOptions options;
  options.historyRequest = 1;  // the last value comes at once, even if it changed long ago
  iox::popo::Subscriber<meter_Reading> subscriber(
      {"InduRoP", iox::capro::IdString_t(TruncateToCapacity, argv[1]), "meter::reading"}, options);
  while (left != 0) {
    auto sample = subscriber.take();
    if (sample.has_error()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      continue;
    }
    const meter_Reading& reading = *sample.value();
    std::printf("count %" PRIu64 " litres %.1f backwards %" PRId32 " odd %d\n", reading.count, reading.litres,
                reading.backwards, reading.odd);
    std::fflush(stdout);
    left -= left > 0 ? 1 : 0;
  }
  return 0;
}
