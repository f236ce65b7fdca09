// SPDX-License-Identifier: Apache-2.0
#include "node/exchange/exchange_kind.h"

#include "node/exchange/module_exchange.h"
#include "node/exchange/process_exchange.h"

namespace indurop::node {

using scheduler::ModuleType;

const char* why_not_exchanged(const config::Module& module, bool simulated) noexcept {
  const bool is_process = module.type == ModuleType::Process;
  if (module.operation == scheduler::Operation::NonReal) {
    return is_process
               ? "it runs in the background, where no run is waited for: `indurop restart` launches its new file"
               : "it runs in the background, where no run is waited for: stop and run the node to load its new file";
  }
  if (is_process && module.signal != 0) {
    return "its process is released by a signal, so no other one can follow it: `indurop restart` launches its new "
           "file";
  }
  return is_process && simulated
             ? "in a simulation, a process is not exchanged: `indurop restart` launches its new file"
             : nullptr;
}

std::unique_ptr<VersionExchange> make_exchange(ExchangeContext& context, std::uint32_t module, bool held) {
  if (context.parts.config.modules[module].type == ModuleType::Process) {
    return std::make_unique<ProcessExchange>(context, module, held);
  }
  return std::make_unique<ModuleExchange>(context, module, held);
}

}  // namespace indurop::node
