// SPDX-License-Identifier: Apache-2.0
// Functions of libindurop for the node, which shares the library with the modules it loads: bind their variables to the
// node's store, set the module that the current thread is running, and serve their shared functions. The order is:
// attach_process(), then for each module set_current_module(i) and dlopen, start() of all modules,
// start_function_servers(), the run; at the end stop_function_servers(), stop() of all modules, dlclose,
// detach_process().

#pragma once

#include <indurop/result.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scheduler/run_block.h"
#include "store/runtime/message_ring.h"
#include "store/tape/layout.h"
#include "store/tape/replay_input.h"
#include "store/tape/track.h"
#include "store/vars/store.h"

namespace indurop::runtime {

// Declares that the calling thread runs code of module `index` from now on (for irp::printf, property(), and functions
// that the module offers while it is being loaded). Real-time safe. index = kNoModule: none.
inline constexpr std::uint32_t kNoModule = 0xFFFFFFFF;
void set_current_module(std::uint32_t index) noexcept;
std::uint32_t current_module() noexcept;
// Sets the tick and release time of the thread's present run, which irp::tick() and release_ns() return, however late
// it is. Real-time safe.
struct OwnRelease {
  std::uint64_t tick = 0;
  std::int64_t release_ns = 0;
};
void set_current_run(std::uint32_t index, OwnRelease release) noexcept;
// Returns null on threads that run no run of a module.
const OwnRelease* current_release() noexcept;

// Records the results of irp::now_ns() of the calling thread on this track, or takes them from these readings as long
// as there are some, so that a run that reads the clock can be repeated. Real-time safe; borrowed. Null, empty:
// neither.
void set_current_track(tape::Track* track) noexcept;
void set_clock_readings(std::span<const std::int64_t> readings) noexcept;
std::int64_t read_clock() noexcept;

// The same for the answers of shared functions and channels, and the freshness of values of other boards. As long as
// there are `answers`, the run gets them; functions are called nevertheless, for their effects.
void set_answers(std::span<const tape::ReplayedAnswer> answers) noexcept;
// Returns null if the live answer counts, which note_answer() records.
const tape::ReplayedAnswer* next_answer() noexcept;
void note_answer(std::int64_t code, const void* bytes, std::size_t size) noexcept;
// Wraps one answer: `ask` fills `bytes` and returns its code; `fills` returns whether `size` bytes belong to a code.
// Returns the code that the run gets. Real-time safe if `ask` is.
template <class Fills, class Ask>
std::int64_t answer(void* bytes, std::size_t size, Fills fills, Ask ask) {
  const tape::ReplayedAnswer* const then = next_answer();
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

// For answers that consist of a code only.
template <class Ask>
std::int64_t answer(Ask ask) {
  return answer(
      nullptr, 0, [](std::int64_t) { return false; }, ask);
}

// The same for indurop_see_confirmed(). Real-time safe.
std::int64_t see_confirmed(std::int64_t confirmed) noexcept;

// Binds every registered Ref of this process to `store` (borrowed) and remembers it for modules loaded later;
// `run` (borrowed) carries messages and properties. Not real-time safe.
// Returns one line per variable whose type in the store differs, or that the store lacks.
std::vector<std::string> attach_process(vars::Store& store, scheduler::RunBlock& run);
// Requires that no module is running. Variables are bound to private memory with initial values again.
void detach_process();

// For modules of the platform itself: the schema of the variables that this process is bound to, as schema::to_json()
// writes it, and the configuration file of its node. Empty: it has none. Such a module must not attach on its own: what
// it links guards its mappings by a signal handler, which would stay when the module is unloaded. Not real-time safe.
std::string schema_text();
std::string config_file();
// Time of the node in a simulation, in ns; nothing in real time. Real-time safe.
std::optional<std::int64_t> virtual_ns() noexcept;

// Returns the lines that could not be bound since the last call (a module was loaded, a function could not be served).
// Not real-time safe.
std::vector<std::string> take_binding_errors();

// For a version of a module that is loaded while another one runs: binds the variables of the loaded file that holds
// the address to copies of their present values, so that its start() and stop() change nothing of the plant; and back
// to the store. No code of the file may be running. Not real-time safe.
void bind_apart(const void* inside);
void bind_back(const void* inside);

// Starts one thread per loaded module that implements shared functions; `fifo_priority` 0: normal scheduling, `core`
// -1: not pinned. Calls of functions that are not served yet fail with NotFound. May be called again after more modules
// were loaded. Not real-time safe. Errors: NoSpace, System (a thread could not be created).
Status start_function_servers(int fifo_priority, int core);
// Waits for the call in progress, if any; calls are rejected from then on. Not real-time safe.
void stop_function_servers();
// For a thread that left a module because of a fault: abandons the call it was waiting in. Real-time safe.
void release_calls_of_this_thread() noexcept;
// For a module that left its code because of a fault: frees the chunks of pools that it had in its hand. Real-time
// safe.
void release_chunks_of(std::uint32_t module) noexcept;
// For the handlers of the node: a fault in a shared function served here, or inside irp::guarded(), is caught by a
// jump; else it returns. Real-time safe.
bool catch_fault(int number, void* address) noexcept;

}  // namespace indurop::runtime
