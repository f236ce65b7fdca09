// SPDX-License-Identifier: Apache-2.0
// Functions that <indurop/pool.h> calls.

#include <indurop/detail/pool_use.h>

#include <optional>

#include "store/runtime/pool_bindings.h"
#include "store/runtime/process.h"

namespace indurop::runtime {

namespace {

PoolBinding* current(abi::PoolUse& use) noexcept {
  auto* binding = static_cast<PoolBinding*>(use.binding.load(std::memory_order_acquire));
  if (binding != nullptr && !binding->pool->retired()) [[likely]] {
    return binding;
  }
  return Process::get().pool_is_missing() ? static_cast<PoolBinding*>(use.binding.load(std::memory_order_acquire))
                                          : nullptr;
}

void fill_in(const PoolBinding& binding, std::uint32_t chunk, std::uint64_t number, abi::PoolChunk& to) noexcept {
  to = {binding.pool->data(chunk),
        const_cast<PoolBinding*>(&binding),  // NOLINT(*-const-cast): comes back to publish or release
        number,
        rt::to_ns(binding.chunks.time_of(chunk)),
        chunk,
        binding.epoch.load(std::memory_order_relaxed)};
}

// Returns the chunk's binding if the chunk is still in its hand, and empties it.
PoolBinding* hand_back(abi::PoolChunk& chunk) noexcept {
  auto* const binding = static_cast<PoolBinding*>(chunk.binding);
  chunk.data = nullptr;
  return binding->epoch.load(std::memory_order_relaxed) == chunk.epoch ? binding : nullptr;
}

template <class Read>
void read(abi::PoolUse& use, abi::PoolChunk& to, Read read) noexcept {
  if (PoolBinding* const binding = current(use); binding != nullptr) {
    if (const std::optional<pools::Held> held = read(*binding)) {
      fill_in(*binding, held->chunk, held->number, to);
    }
  }
}

}  // namespace

}  // namespace indurop::runtime

extern "C" {

using indurop::abi::PoolChunk;
using indurop::abi::PoolUse;
using indurop::runtime::PoolBinding;

void indurop_register_pool(PoolUse* use) {
  indurop::runtime::Process::get().register_pool(*use);
}

void indurop_unregister_pool(PoolUse* use) {
  indurop::runtime::Process::get().unregister_pool(*use);
}

void indurop_pool_take(PoolUse* use, PoolChunk* to) noexcept {
  if (PoolBinding* const binding = indurop::runtime::current(*use); binding != nullptr) {
    if (const auto chunk = binding->chunks.take(binding->seat)) {
      indurop::runtime::fill_in(*binding, *chunk, 0, *to);
    }
  }
}

void indurop_pool_latest(PoolUse* use, PoolChunk* to) noexcept {
  indurop::runtime::read(*use, *to, [](PoolBinding& binding) { return binding.chunks.latest(binding.seat); });
}

void indurop_pool_next(PoolUse* use, PoolChunk* to) noexcept {
  indurop::runtime::read(*use, *to, [](PoolBinding& binding) { return binding.chunks.next(binding.seat); });
}

std::uint64_t indurop_pool_publish(PoolChunk* chunk) noexcept {
  PoolBinding* const binding = indurop::runtime::hand_back(*chunk);
  return binding == nullptr ? 0
                            : binding->chunks.publish(binding->seat, chunk->chunk, indurop::runtime::schedule_now());
}

void indurop_pool_release(PoolChunk* chunk) noexcept {
  const bool is_draft = chunk->number == 0;
  PoolBinding* const binding = indurop::runtime::hand_back(*chunk);
  if (binding == nullptr) {
    return;
  }
  if (is_draft) {
    binding->chunks.discard(binding->seat, chunk->chunk);
  } else {
    binding->chunks.release(binding->seat, chunk->chunk);
  }
}
}
