// SPDX-License-Identifier: Apache-2.0
// Misbehaves as its properties say: "fault" names how, "at" in which phase (start, run, stop), "after" how many good
// runs come before. "busy_us" makes every run that long, "every" only every n-th.
#include <indurop/generated.h>
#include <indurop/indurop.h>

#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace {

using Action = void (*)();

void nothing() {}
void throw_error() {
  throw std::runtime_error("out of ink");
}
void throw_number() {
  throw 42;
}
volatile std::uintptr_t bad_address = 0x10;
void segv() {
  *reinterpret_cast<volatile int*>(bad_address) = 1;  // NOLINT(performance-no-int-to-ptr): to crash
}
volatile int number = 1000;
volatile int zero = 0;
__attribute__((no_sanitize("integer-divide-by-zero"))) void fpe() {
#if defined(__x86_64__)
  number = number / zero;
#else
  std::raise(SIGFPE);
#endif
}
volatile bool forever = true;
void loop() {
  while (forever) {
  }
}
[[gnu::noinline]] int deeper(int depth) {
  volatile char room[4096];
  room[0] = static_cast<char>(depth);
  return forever ? deeper(depth + 1) + room[0] : room[0];
}
volatile int sink = 0;
void overflow() {
  sink = deeper(0);
}
void stop_program() {
  std::abort();
}

struct Named {
  const char* name;
  Action action;
};
constexpr Named kFaults[] = {{"none", nothing},   {"throw", throw_error}, {"throw-number", throw_number},
                             {"segv", segv},      {"fpe", fpe},           {"loop", loop},
                             {"stack", overflow}, {"abort", stop_program}};

Action fault = nothing;
std::string at;
int after = 0;
int busy_us = 0;
int every = 1;
int runs = 0;

void misbehave_in(const char* phase) {
  if (at == phase) {
    fault();
  }
}

}  // namespace

void onStart() {
  const auto wanted = irp::property<std::string>("fault", "none");
  at = irp::property<std::string>("at", "run");
  after = irp::property<int>("after", 0);
  busy_us = irp::property<int>("busy_us", 0);
  every = irp::property<int>("every", 1);
  for (const Named& named : kFaults) {
    if (wanted == named.name) {
      fault = named.action;
    }
  }
  misbehave_in("start");
}

void onRun() {
  ++runs;
  nt::output = runs;
  if (busy_us > 0 && runs % every == 0) {
    for (const auto begin = irp::now_ns(); irp::now_ns() - begin < busy_us * 1000LL;) {
    }
  }
  if (runs > after) {
    misbehave_in("run");
  }
}

void onStop() {
  irp::printf("stop called\n");
  misbehave_in("stop");
}

INDUROP_MODULE(run = &::onRun, start = &::onStart, stop = &::onStop)
