// SPDX-License-Identifier: Apache-2.0
// Checks what writer.exe writes: all words of one version are equal, even if a process was killed in between.
#include <indurop/generated.h>
#include <indurop/indurop.h>

void onRun() {
  const INDUROP_TYPEOF(nt::block)::value_type seen = nt::block;
  for (const auto word : seen.word) {
    if (word != seen.word[0]) {
      ++nt::torn;
      break;
    }
  }
  nt::newest = seen.word[0];
  ++nt::looks;
}

INDUROP_MODULE(run = &::onRun)
