// SPDX-License-Identifier: Apache-2.0
// As walker, but it declares what it keeps between its runs. BY_FUNCTIONS: by save() and restore().
// AS_PROCESS: as a process module. SELDOM: it writes in one of 1000 runs only. BUSY_US: each run takes so long, and
// save() too, in the middle of its work. LONGER: it keeps more, so its restore() rejects the bytes of the others.
// GAINS: it brings a variable.
#include <indurop/generated.h>
#include <indurop/indurop.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace {

struct Path {
  std::int64_t own = 0;
  double filtered[4] = {};
#ifdef LONGER
  double unused = 0;
#endif
};
Path path;
std::uint32_t steps = 0;

void spend_time() {
#ifdef BUSY_US
  const auto end = std::chrono::steady_clock::now() + std::chrono::microseconds(BUSY_US);
  while (std::chrono::steady_clock::now() < end) {
  }
#endif
}

}  // namespace

void onRun() {
  ++steps;
  path.own += STEP + steps % 5;
  path.filtered[steps % 4] += 0.25 * (static_cast<double>(nt::counted) - path.filtered[(steps + 1) % 4]);
  spend_time();
#ifdef SELDOM
  if (steps % 1000 != 1) {
    return;
  }
#endif
  nt::walked = path.own;
#ifdef GAINS
  nt::gained = 2 * path.own;
#endif
  nt::pace = {path.own, path.filtered[0] + path.filtered[3]};
}

#ifdef BY_FUNCTIONS

std::size_t onSave(void* to, std::size_t /*most*/) {
  std::memcpy(to, &steps, sizeof steps);
  spend_time();
  std::memcpy(static_cast<std::byte*>(to) + sizeof steps, &path, sizeof path);
  return sizeof steps + sizeof path;
}

bool onRestore(const void* from, std::size_t bytes) {
  if (bytes != sizeof steps + sizeof path) {
    return false;
  }
  std::memcpy(&steps, from, sizeof steps);
  std::memcpy(&path, static_cast<const std::byte*>(from) + sizeof steps, sizeof path);
  return true;
}

INDUROP_STATE_BY(most = 64, save = &::onSave, restore = &::onRestore)

#else

INDUROP_STATE(path, steps)

#endif

#ifdef AS_PROCESS
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
INDUROP_MODULE(run = &::onRun)
#endif
