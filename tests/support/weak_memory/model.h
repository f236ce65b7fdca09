// SPDX-License-Identifier: Apache-2.0
// Runs a small program of threads in every way that the memory model of C++ allows, and not only in those of the
// processor that runs the test: x86 hides a missing barrier. Model: Lahav et al., "Repairing sequential consistency in
// C/C++11" (RC11, PLDI 2017), by messages and views as in Kang et al., "A promising semantics" (POPL 2017) without
// promises: a load may take each write that its thread has not seen to be replaced. Not covered: a load that takes a
// value from a store that comes after it in its own thread's order, by way of another thread (load buffering), and
// bytes of one place that are accessed in several sizes.

#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace indurop::test::weak {

// One execution. The objects that the threads share have to be at the same places in each of them, and a thread has to
// end whatever it reads: it cannot wait for another one but by a mutex.
struct Program {
  std::vector<std::function<void()>> threads;
  std::function<std::string()> check;  // after the last thread has ended: what is wrong; empty: nothing
};

// What is taken out of the code, so that a test can show that it is needed.
struct Weakening {
  bool no_acquire_fences = false;
  bool no_release_fences = false;
  bool no_sequential_accesses = false;  // they only acquire and release
  bool no_acquire_loads = false;        // they are relaxed
  bool no_release_stores = false;       // they are relaxed
};

struct Outcome {
  std::string wrong;             // what check() returned first; empty: no execution is wrong
  std::uint64_t executions = 0;  // that ended; those that meet a state which was seen before do not
  std::uint64_t states = 0;      // that differ
  bool complete = false;         // false: there are more than `max_states`, or an execution was wrong
};

// `make` sets the shared objects to their initial values and returns the threads.
Outcome explore(const std::function<Program()>& make, const Weakening& without = {},
                std::uint64_t max_states = 5'000'000);

// What threads do to shared places, `size` bytes each: 1, 2, 4 or 8. In check() load() returns the last value, in
// `make` and outside of explore() they all act on the memory itself.
std::uint64_t load(const void* place, std::size_t size, int order);
void store(void* place, std::uint64_t value, std::size_t size, int order);
// Returns the value before. `change` returns false to leave the place as it is: then it was a load with order `failed`.
std::uint64_t modify(void* place, std::size_t size, int order, int failed,
                     const std::function<bool(std::uint64_t& value)>& change);
void fence(int order);
// A sequentially consistent fence in all threads at once, as of membarrier(2).
void fence_all();
// A mutex at this place.
void lock(const void* place);
void unlock(const void* place);

}  // namespace indurop::test::weak
