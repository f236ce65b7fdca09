// SPDX-License-Identifier: Apache-2.0
// Three modules of a chain, by STAGE. The first writes the time of its release, the others hand it on; the last one
// says how old it is.
#include <indurop/generated.h>
#include <indurop/indurop.h>

using namespace ag;

void onRun() {
#if STAGE == 1
  a = irp::release_ns();
#elif STAGE == 2
  b = static_cast<std::int64_t>(a);
#else
  const std::int64_t written = b;
  if (written != 0) {
    truth = irp::release_ns() - written + 1;
  }
  c = written;
#endif
}

INDUROP_MODULE(run = &::onRun)
