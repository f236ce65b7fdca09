// SPDX-License-Identifier: Apache-2.0
// Versions of one module, chosen by a definition: what they keep, and what goes wrong with them. Each counts its runs
// and those of the versions before it; nt::output shows the number, nt::walked its product with the version's factor.
#include <indurop/generated.h>
#include <indurop/indurop.h>

#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <thread>

namespace {

std::int64_t counted = 0;
#if defined(RELOAD_TYPED)
float filtered[4] = {};
#else
[[maybe_unused]] double filtered[4] = {};
#endif
[[maybe_unused]] std::uint32_t own = 7;

#if defined(RELOAD_SAME)
constexpr std::int64_t kFactor = 1;
#elif defined(RELOAD_BY_OTHER)
constexpr std::int64_t kFactor = -2;
#else
constexpr std::int64_t kFactor = -1;
#endif

#if defined(RELOAD_LARGE)
std::uint8_t much[4 * 1024 * 1024];
#endif
#if defined(RELOAD_GROWN)
double history[8] = {};
#elif defined(RELOAD_SHRUNK)
double history[2] = {};
#else
[[maybe_unused]] double history[4] = {1, 2, 3, 4};
#endif

[[maybe_unused]] std::int64_t runs_of_this_version = 0;
volatile bool forever = true;

}  // namespace

void onStart() {
  nt::output = -1000;  // not seen by others while another version runs
  irp::printf("starts, and sees %s\n", static_cast<std::int64_t>(nt::walked) != 0 ? "what was walked" : "nothing");
#if defined(RELOAD_SLOW_START)
  std::this_thread::sleep_for(std::chrono::seconds(2));
#elif defined(RELOAD_BAD_START)
  throw std::runtime_error("no ink");
#endif
}

void onRun() {
  ++counted;
  ++runs_of_this_version;
#if defined(RELOAD_THROWS)
  if (runs_of_this_version > 20) {
    nt::output = 9999;
    throw std::runtime_error("out of ink");
  }
#elif defined(RELOAD_LOOPS)
  while (forever && runs_of_this_version > 20) {
  }
#elif defined(RELOAD_OVERRUNS)
  if (runs_of_this_version > 20) {
    for (const auto begin = irp::now_ns(); irp::now_ns() - begin < 3'000'000;) {
    }
  }
#endif
  nt::output = static_cast<std::int32_t>(counted);
  nt::walked = counted * kFactor;
#if defined(RELOAD_MORE_ACCESS)
  nt::events = 1;
#elif defined(RELOAD_GAINS)
  nt::gained = nt::gained + 1;
  INDUROP_TYPEOF(nt::pair)::value_type both;
#if defined(RELOAD_KEPT)
  const std::int64_t shown = counted;
#else
  const std::int64_t shown = runs_of_this_version;
#endif
  both.plus = shown;
  both.minus = -shown;
  nt::pair = both;
#if defined(RELOAD_SAME)
  nt::walked = counted + (nt::gained - 11 - runs_of_this_version);
#endif
#endif
#if defined(RELOAD_LARGE)
  much[counted % static_cast<std::int64_t>(sizeof much)] = 1;
#endif
}

void onStop() {
  nt::output = -2000;  // not seen by others either
}

#if defined(RELOAD_OFFERS)
INDUROP_IMPLEMENT(nt::add, [](double a, double b) { return a + b; })
#elif defined(RELOAD_DIES)
namespace {
[[maybe_unused]] const int kNever = (std::abort(), 0);
}
#elif defined(RELOAD_QUITS)
namespace {
[[maybe_unused]] const int kNever = (std::exit(0), 0);
}
#elif defined(RELOAD_HANGS)
namespace {
[[maybe_unused]] const int kNever = [] {
  for (;;) {
    std::this_thread::sleep_for(std::chrono::seconds(1));
  }
  return 0;
}();
}
#elif defined(RELOAD_THREADS)
void beginThread() {
  std::thread([] {}).detach();
}
#endif

#if defined(RELOAD_BY) || defined(RELOAD_BY_OTHER)
std::size_t onSave(void* to, std::size_t /*most*/) {
  std::memcpy(to, &counted, sizeof counted);
  return sizeof counted;
}
bool onRestore(const void* from, std::size_t bytes) {
  std::memcpy(&counted, from, sizeof counted);
  return bytes == sizeof counted;
}
INDUROP_STATE_BY(most = 64, save = &::onSave, restore = &::onRestore)
#elif defined(RELOAD_LARGE)
INDUROP_STATE(counted, filtered, history, much)
#elif defined(RELOAD_LESS)
INDUROP_STATE(counted, own)
#elif !defined(RELOAD_FRESH)
INDUROP_STATE(counted, filtered, history)
#endif

INDUROP_MODULE(run = &::onRun, start = &::onStart, stop = &::onStop)
