// SPDX-License-Identifier: Apache-2.0
// irp::printf.

#include <indurop/detail/print_argument.h>

#include <cstdio>

#include "core/rt/clock.h"
#include "store/runtime/host.h"
#include "store/runtime/message_ring.h"
#include "store/runtime/print_format.h"
#include "store/runtime/process.h"

extern "C" int indurop_print(const char* format, const indurop::detail::PrintArgument* arguments,
                             std::uint32_t count) noexcept {
  namespace runtime = indurop::runtime;
  indurop::scheduler::RunBlock* run = runtime::hot.run.load(std::memory_order_acquire);
  if (run == nullptr) {
    char text[4096];
    const std::size_t length = runtime::format_message(text, sizeof text, format, {arguments, count});
    std::fwrite(text, 1, length, stdout);
    return static_cast<int>(length);
  }
  char text[indurop::scheduler::kMessageText];
  const std::size_t length = runtime::format_message(text, sizeof text, format, {arguments, count});
  const bool taken = runtime::push_message(*run, runtime::current_module(), {text, length}, runtime::schedule_now());
  return taken ? static_cast<int>(length) : -1;
}
