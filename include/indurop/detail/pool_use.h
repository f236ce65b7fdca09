// SPDX-License-Identifier: Apache-2.0
// What <indurop/pool.h> and libindurop.so pass to each other. Any change here requires a new abi::kVersion.

#pragma once

#include <indurop/detail/mark.h>

#include <atomic>
#include <cstdint>

namespace indurop::abi {

// A pool that the code of a loaded file uses. Registered when the file is loaded.
struct PoolUse {
  std::uint64_t name_hash;
  std::uint64_t type_hash;
  std::uint64_t chunk_bytes;
  const char* name;
  std::atomic<void*> binding{nullptr};  // libindurop's; null: there is no such pool now
};

// A chunk in the hand of this process. `data` is null in an empty one.
struct PoolChunk {
  void* data = nullptr;
  void* binding = nullptr;
  std::uint64_t number = 0;  // 0: it is being filled
  std::int64_t published_ns = 0;
  std::uint32_t chunk = 0;
  std::uint32_t epoch = 0;
};

}  // namespace indurop::abi

extern "C" {
void indurop_register_pool(indurop::abi::PoolUse* use);
void indurop_unregister_pool(indurop::abi::PoolUse* use);
// These leave `to` empty if there is no such chunk, and are real-time safe.
void indurop_pool_take(indurop::abi::PoolUse* use, indurop::abi::PoolChunk* to) noexcept;
void indurop_pool_latest(indurop::abi::PoolUse* use, indurop::abi::PoolChunk* to) noexcept;
void indurop_pool_next(indurop::abi::PoolUse* use, indurop::abi::PoolChunk* to) noexcept;
// These empty the chunk. Returns the number, 0 if the chunk was taken away.
std::uint64_t indurop_pool_publish(indurop::abi::PoolChunk* chunk) noexcept;
void indurop_pool_release(indurop::abi::PoolChunk* chunk) noexcept;
}
