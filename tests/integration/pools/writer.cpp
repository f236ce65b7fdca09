// SPDX-License-Identifier: Apache-2.0
// Fills both pools. The index of a chunk is the time at which it was begun, so no two have the same.

#include <indurop/generated.h>
#include <indurop/indurop.h>

#include "content.h"

using namespace pooltest::Flow;

namespace {

template <class Pool>
void write_one(const Pool& pool) {
  if (auto draft = pool.take()) {
    pool_content::fill(*draft, static_cast<std::uint64_t>(irp::now_ns()));
    draft.publish();
  } else {
    without_chunk += 1;
  }
}

}  // namespace

int main() {
  irp::initPeriodExe();
  while (irp::waitPeriod()) {
    write_one(large);
    write_one(small);
    written += 1;
  }
}
