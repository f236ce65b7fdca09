// SPDX-License-Identifier: Apache-2.0
// Writes the number of its run into every element of every variable. Property "pause_us": takes so long in the middle
// of it, without keeping a core from the mirrors.
#include <chrono>
#include <thread>

#include "snapshot_variables.h"

using namespace sn;

namespace {

std::array<uint64_t, 20> value{};

std::chrono::microseconds pause_time{0};

template <class... Variable>
void write_all(const Variable&... variables) {
  ((variables = value), ...);
}

}  // namespace

void onRun() {
  value.fill(value[0] + 1);
  x0 = value;
  if (pause_time.count() > 0) {
    std::this_thread::sleep_for(pause_time);
  }
  write_all(ALL_VARIABLES);
}

void onStart() {
  pause_time = std::chrono::microseconds(irp::property<int>("pause_us", 0));
}

INDUROP_MODULE(run = &::onRun, start = &::onStart)
