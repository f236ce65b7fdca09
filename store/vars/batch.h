// SPDX-License-Identifier: Apache-2.0
// Several values that change in one tick: a process outside the node writes them into a file of shared memory, and the
// tick applies them before anything of it runs, all or none. A tick without such a request costs one load.

#pragma once

#include <indurop/result.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "store/vars/shm_file.h"
#include "store/vars/store.h"

namespace indurop::vars {

// Limits of one request, so that the tick stays short.
inline constexpr std::size_t kMaxBatchValues = 512;
inline constexpr std::size_t kMaxBatchBytes = std::size_t{32} << 10U;

enum class BatchState : std::uint32_t { Free, Staged, Working, Done, Busy, Wrong };

struct BatchEntry {
  std::uint32_t variable;  // index in the store's directory
  std::uint32_t offset;    // of the part
  std::uint32_t size;
  std::uint32_t data;  // position of its bytes
};

struct BatchBlock {
  std::atomic<std::uint64_t> magic;  // stored last
  std::uint64_t layout_hash;         // of the store that it belongs to
  abi::SharedMutex lock;             // for processes that make requests
  std::atomic<BatchState> state;
  std::uint32_t count;
  std::atomic<std::uint64_t> tick;  // the tick that applied it
  BatchEntry entries[kMaxBatchValues];
  unsigned char data[kMaxBatchBytes];
};

std::string batch_file(const std::string& node);  // indurop.<node>.batch

// The node's end.
class Batch {
 public:
  // Creates the file for one run of a node; replaces that of an earlier run. Errors: as of ShmFile::create, System.
  static Result<Batch> create(const std::string& node, const Store& store);
  // Applies a request; on the tick thread, before anything of the tick runs. Real-time safe: does not wait for a
  // variable that is just being written, the next tick tries again.
  void carry_out(const Store& store, std::uint64_t tick) noexcept {
    if (block().state.load(std::memory_order_relaxed) == BatchState::Staged) [[unlikely]] {
      carry_out_staged(store, tick);
    }
  }

 private:
  void carry_out_staged(const Store& store, std::uint64_t tick) noexcept;
  explicit Batch(ShmFile file) noexcept : file_(std::move(file)) {}
  [[nodiscard]] BatchBlock& block() const noexcept { return *reinterpret_cast<BatchBlock*>(file_.data()); }

  ShmFile file_;
  std::uint32_t tries_ = 0;
};

struct Change {
  const DirectoryEntry* variable = nullptr;
  std::uint32_t offset = 0;
  std::span<const std::uint8_t> bytes;
};

// Asks the running node for the changes and waits until they are done. Returns the tick. Errors: NotFound (the node is
// of a version that does not support this), InvalidArgument (more than the limits of one tick), TypeMismatch (its
// variables have changed meanwhile), Busy (another process's request is not done, or a stopped process is writing a
// variable), Timeout (no tick came; they are not done and will not be), PermissionDenied.
Result<std::uint64_t> change_in_one_tick(const std::string& node, const Store& store, std::span<const Change> changes,
                                         std::chrono::nanoseconds patience);

}  // namespace indurop::vars
