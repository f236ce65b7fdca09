// SPDX-License-Identifier: Apache-2.0
// Sporadic: its event is that counter.so ran another "every" times. Plain functions, as in Figure 7 of the chapter.
#include <indurop/generated.h>
#include <indurop/indurop.h>

namespace {
unsigned every = 1;
bool early = false;
int busy_us = 0;
}  // namespace

extern "C" void start() {
  every = irp::property<unsigned>("every", 1);
  early = irp::property<bool>("early", false);
  busy_us = irp::property<int>("busy_us", 0);
}

extern "C" int condition() {
  const unsigned known = early ? nt::early_events : nt::events;
  return nt::counted >= (known + 1) * every ? 1 : 0;
}

extern "C" void run() {
  if (early) {
    ++nt::early_events;
  } else {
    ++nt::events;
  }
  for (const auto begin = irp::now_ns(); irp::now_ns() - begin < busy_us * 1000LL;) {
  }
}
