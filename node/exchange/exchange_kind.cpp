// SPDX-License-Identifier: Apache-2.0
#include "node/exchange/exchange_kind.h"

#include "node/exchange/background_exchange.h"
#include "node/exchange/module_exchange.h"
#include "node/exchange/process_exchange.h"
#include "node/exchange/restart_exchange.h"

namespace indurop::node {

using scheduler::ModuleType;

const char* why_not_exchanged(const config::Module& module, bool simulated) noexcept {
  return module.type == ModuleType::Process && simulated
             ? "in a simulation, a process is not exchanged: `indurop restart` launches its new file"
             : nullptr;
}

std::unique_ptr<VersionExchange> make_exchange(ExchangeContext& context, std::uint32_t index, bool held) {
  const config::Module& module = context.parts.config.modules[index];
  const bool is_in_background = module.operation == scheduler::Operation::NonReal;
  if (module.type == ModuleType::Process) {
    if (is_in_background || module.signal != 0) {
      return std::make_unique<RestartExchange>(context, index, held);
    }
    return std::make_unique<ProcessExchange>(context, index, held);
  }
  if (is_in_background) {
    return std::make_unique<BackgroundExchange>(context, index, held);
  }
  return std::make_unique<ModuleExchange>(context, index, held);
}

}  // namespace indurop::node
