// SPDX-License-Identifier: Apache-2.0
// What the node asks of libindurop, which it shares with the modules it loads: bind their variables to the node's
// store, tell the library which module the current thread is running, and serve their shared functions. The order is:
// attach_process(), then for each module set_current_module(i) and dlopen, start() of all modules,
// start_function_servers(), the run; at the end stop_function_servers(), stop() of all modules, dlclose,
// detach_process().

#pragma once

#include <indurop/result.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/message_ring.h"
#include "scheduler/run_block.h"
#include "tape/layout.h"
#include "tape/retold.h"
#include "tape/track.h"
#include "vars/store.h"

namespace indurop::runtime {

// The calling thread runs code of module `index` from now on (irp::printf, property(), and what the module offers while
// it is being loaded). Real-time safe. index = kNoModule: none.
inline constexpr std::uint32_t kNoModule = 0xFFFFFFFF;
void set_current_module(std::uint32_t index) noexcept;
std::uint32_t current_module() noexcept;
// Likewise its run of this tick and release, which irp::tick() and release_ns() tell, however late it is. Real-time
// safe.
struct OwnRelease {
  std::uint64_t tick = 0;
  std::int64_t release_ns = 0;
};
void set_current_run(std::uint32_t index, OwnRelease release) noexcept;
// Null on threads that no run of a module is on.
const OwnRelease* current_release() noexcept;

// What irp::now_ns() says to the calling thread is told to this track, or comes from these readings as long as there
// are some, so that a run can be repeated that asks for the time. Real-time safe; borrowed. Null, empty: neither.
void set_current_track(tape::Track* track) noexcept;
void set_clock_readings(std::span<const std::int64_t> readings) noexcept;
std::int64_t read_clock() noexcept;

// Likewise what calls of shared functions and channels give it, and how fresh values of other boards are. As long as
// there are `answers`, they are what it gets; functions are called nevertheless, for what they do.
void set_answers(std::span<const tape::RetoldAnswer> answers) noexcept;
// Null: what really comes counts, and is told by note_answer().
const tape::RetoldAnswer* next_answer() noexcept;
void note_answer(std::int64_t code, const void* bytes, std::size_t size) noexcept;
// The same around one of them: `ask` fills `bytes` and returns its code; `fills` says of a code whether `size` bytes
// come with it. Returns the code that the run gets. Real-time safe if `ask` is.
template <class Fills, class Ask>
std::int64_t answer(void* bytes, std::size_t size, Fills fills, Ask ask) {
  const tape::RetoldAnswer* const then = next_answer();
  const std::int64_t now = ask();
  if (then == nullptr) {
    note_answer(now, bytes, fills(now) ? size : 0);
    return now;
  }
  if (then->code == tape::kTooLongToTell || (fills(then->code) && then->bytes.size() != size)) {
    return now;
  }
  if (fills(then->code) && size > 0) {
    std::memcpy(bytes, then->bytes.data(), size);
  }
  return then->code;
}

// Of those that give no more than a code.
template <class Ask>
std::int64_t answer(Ask ask) {
  return answer(
      nullptr, 0, [](std::int64_t) { return false; }, ask);
}

// Likewise around indurop_see_confirmed(). Real-time safe.
std::int64_t see_confirmed(std::int64_t confirmed) noexcept;

// Binds every registered Ref of this process to `store` (borrowed) and remembers it for modules loaded later;
// `run` (borrowed) carries messages and properties. Not real-time safe.
// Returns one line per variable whose type in the store differs, or that the store lacks.
std::vector<std::string> attach_process(vars::Store& store, scheduler::RunBlock& run);
// Requires that no module is running. Variables go back to private memory with initial values.
void detach_process();

// Lines that could not be bound since the last call (a module was loaded, a function could not be served).
// Not real-time safe.
std::vector<std::string> take_binding_errors();

// Starts one thread per loaded module that implements shared functions; `fifo_priority` 0: normal scheduling, `core`
// -1: not pinned. Calls of functions that are not served yet fail with NotFound. May be called again after more modules
// were loaded. Not real-time safe. Errors: NoSpace, System (a thread could not be created).
Status start_function_servers(int fifo_priority, int core);
// Waits for the call in progress, if any; calls are refused from then on. Not real-time safe.
void stop_function_servers();
// For a thread that was thrown out of a module by a fault: gives up the call it was waiting in. Real-time safe.
void release_calls_of_this_thread() noexcept;
// For the handlers of the node: a fault in a shared function that is served here, or below irp::guarded(), is caught by
// a jump; else it returns. Real-time safe.
bool catch_fault(int number, void* address) noexcept;

}  // namespace indurop::runtime
