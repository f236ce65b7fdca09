// SPDX-License-Identifier: Apache-2.0
// The press of board b in C++, in versions chosen by a definition.
#include <indurop/generated.h>
#include <indurop/indurop.h>

#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <thread>

namespace {

std::int64_t strokes = 0;
[[maybe_unused]] std::int64_t strokes_of_this_version = 0;

#if defined(PRESS_FIRST) || defined(PRESS_LONG)
constexpr std::int64_t kSign = 1;
#else
constexpr std::int64_t kSign = -1;
#endif

}  // namespace

#ifndef PRESS_AS_PROCESS
void onStart() {
#if defined(PRESS_BAD_START)
  throw std::runtime_error("no oil");
#elif defined(PRESS_WAITS)
  const char* const go = std::getenv("IRP_TEST_SLOW_UNTIL");
  while (go != nullptr && !std::filesystem::exists(go)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
#endif
}
#endif

void onRun() {
  ++strokes;
#if defined(PRESS_THROWS)
  if (++strokes_of_this_version > 20) {
    throw std::runtime_error("out of oil");
  }
#endif
#if defined(PRESS_READS_MORE)
  strokes_of_this_version = static_cast<std::int64_t>(xt::b_ticks);
#endif
#if defined(PRESS_LONG)
  std::this_thread::sleep_for(std::chrono::milliseconds(25));
#endif
  xt::b_turns = strokes;
  xt::b_shown = strokes * kSign;
}

INDUROP_STATE(strokes)

#ifdef PRESS_AS_PROCESS
int main() {
  if (irp::initPeriodExe() < 0) {
    return 1;
  }
  while (irp::waitPeriod()) {
    onRun();
  }
  return 0;
}
#else
INDUROP_MODULE(run = &::onRun, start = &::onStart)
#endif
