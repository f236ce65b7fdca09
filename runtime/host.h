// SPDX-License-Identifier: Apache-2.0
// What the node asks of libindurop, which it shares with the modules it loads: bind their variables to the node's
// store, tell the library which module the current thread is running, and serve their shared functions.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "scheduler/run_block.h"
#include "vars/store.h"

namespace indurop::runtime {

// The calling thread runs code of module `index` from now on (irp::printf, property()). Real-time safe.
// index = kNoModule: none.
inline constexpr std::uint32_t kNoModule = 0xFFFFFFFF;
void set_current_module(std::uint32_t index) noexcept;
std::uint32_t current_module() noexcept;

// Binds every registered Ref of this process to `store` (borrowed) and remembers it for modules loaded later;
// `run` (borrowed) carries messages and properties. Not real-time safe.
// Returns one line per variable whose type in the store differs, or that the store lacks.
std::vector<std::string> attach_process(vars::Store& store, scheduler::RunBlock& run);
void detach_process();

// Lines that could not be bound since the last call (a module was loaded). Not real-time safe.
std::vector<std::string> take_binding_errors();

}  // namespace indurop::runtime
