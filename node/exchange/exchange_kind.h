// SPDX-License-Identifier: Apache-2.0
// How a module is exchanged, by its configuration.

#pragma once

#include <cstdint>
#include <memory>

#include "config/model/config.h"
#include "node/exchange/version_exchange.h"

namespace indurop::node {

// Returns why a module of this configuration cannot be exchanged while the node runs, and what to do; null: it can.
const char* why_not_exchanged(const config::Module& module, bool simulated) noexcept;

// For a module that can. `held`: see VersionExchange.
std::unique_ptr<VersionExchange> make_exchange(ExchangeContext& context, std::uint32_t index, bool held);

}  // namespace indurop::node
