// SPDX-License-Identifier: Apache-2.0
// The output of modules, formatted for people.
#include "scheduler/printed_messages.h"
#include "tools/client/node/run_view.h"

namespace indurop::tools {

std::vector<MessageSample> RunView::messages(std::size_t most) const {
  std::vector<MessageSample> all;
  for (scheduler::PrintedMessage& one :
       scheduler::printed_messages(*block_, checked_.total, checked_.module_count, most)) {
    const bool node = one.module >= checked_.module_count;
    all.push_back({node ? "node" : module_name(one.module), one.time_ns, std::move(one.text)});
  }
  return all;
}

}  // namespace indurop::tools
