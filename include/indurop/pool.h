// SPDX-License-Identifier: Apache-2.0
// Large data that is filled and read in place: pool struct { uint8_t pixels[480][640]; } camera[4];
//   if (auto frame = camera.take()) { frame->pixels = ...; frame.publish(); }
//   if (auto frame = camera.latest()) { look_at(frame->pixels); }

#pragma once

#include <indurop/detail/pool_use.h>
#include <indurop/detail/variable_access.h>

#include <chrono>
#include <cstdint>
#include <type_traits>
#include <utility>

namespace irp {
std::int64_t now_ns() noexcept;  // <indurop/irp.h>
}

namespace indurop {

namespace detail {

// A chunk in the hand of a module, which goes back to its pool at the end of the scope.
class ChunkInHand {
 public:
  explicit ChunkInHand(abi::PoolChunk chunk) noexcept : chunk_(chunk) {}
  ChunkInHand(ChunkInHand&& other) noexcept : chunk_(std::exchange(other.chunk_, {})) {}
  ChunkInHand& operator=(ChunkInHand&& other) noexcept {
    std::swap(chunk_, other.chunk_);
    return *this;
  }
  ChunkInHand(const ChunkInHand&) = delete;
  ChunkInHand& operator=(const ChunkInHand&) = delete;
  ~ChunkInHand() { release(); }

  explicit operator bool() const noexcept { return chunk_.data != nullptr; }
  // Gives the chunk back before the end of the scope.
  void release() noexcept {
    if (chunk_.data != nullptr) {
      indurop_pool_release(&chunk_);
    }
  }

 protected:
  abi::PoolChunk chunk_;  // NOLINT(*-non-private-member-variables-in-classes): of the two classes below
};

}  // namespace detail

// A chunk to fill. Its content is that of an earlier use: nothing is cleared. A chunk that is not published is free
// again at the end of its scope. Belongs to one thread at a time.
template <class T>
class Draft : public detail::ChunkInHand {
 public:
  using ChunkInHand::ChunkInHand;
  // Requires a chunk: *this is true.
  T& operator*() const noexcept { return *static_cast<T*>(chunk_.data); }
  T* operator->() const noexcept { return static_cast<T*>(chunk_.data); }
  // Readers get it from here on; the draft is empty. Returns its number, from 1 on; 0 if there was no chunk, or if it
  // was taken away because the module had faulted. Real-time safe.
  std::uint64_t publish() noexcept { return chunk_.data == nullptr ? 0 : indurop_pool_publish(&chunk_); }
};

// A published chunk. It stays as it is as long as this object lives. Belongs to one thread at a time.
template <class T>
class Chunk : public detail::ChunkInHand {
 public:
  using ChunkInHand::ChunkInHand;
  // Requires a chunk: *this is true.
  const T& operator*() const noexcept { return *static_cast<const T*>(chunk_.data); }
  const T* operator->() const noexcept { return static_cast<const T*>(chunk_.data); }
  [[nodiscard]] std::uint64_t number() const noexcept { return chunk_.number; }
  // Time since it was published, of the node's clock. Real-time safe.
  [[nodiscard]] std::chrono::nanoseconds age() const noexcept {
    return std::chrono::nanoseconds(irp::now_ns() - chunk_.published_ns);
  }
};

// A pool of a .glb file. Every function is real-time safe: bounded, without lock, allocation and system call. Without a
// node all return nothing. A module may hold several chunks at once; each is one less for its writers.
template <class Tag>
class Pool {
 public:
  using value_type = typename Tag::chunk_type;
  using tag_type = Tag;

  // Returns a chunk to fill: a free one, else the oldest that no user holds and that is not the newest one. Nothing if
  // there is none, which is counted as a drop.
  [[nodiscard]] Draft<value_type> take() const noexcept {
    detail::record_access<Tag, detail::kWrite>();
    abi::PoolChunk chunk;
    indurop_pool_take(&use_.use, &chunk);
    return Draft<value_type>(chunk);
  }
  // Returns the chunk that was published last, also if this module has read it already (number() tells). Nothing if
  // none was published yet.
  [[nodiscard]] Chunk<value_type> latest() const noexcept {
    detail::record_access<Tag, detail::kRead>();
    abi::PoolChunk chunk;
    indurop_pool_latest(&use_.use, &chunk);
    return Chunk<value_type>(chunk);
  }
  // Returns the first chunk after the one that this module has read last, beginning with the latest. Nothing if there
  // is no new one. Chunks that were used again before are counted as missed.
  [[nodiscard]] Chunk<value_type> next() const noexcept {
    detail::record_access<Tag, detail::kRead>();
    abi::PoolChunk chunk;
    indurop_pool_next(&use_.use, &chunk);
    return Chunk<value_type>(chunk);
  }

 private:
  static_assert(std::is_trivially_copyable_v<value_type>, "chunks are plain bytes");
  // Only pools that the code uses are registered: others would take seats and map memory.
  struct Registered {
    Registered() { indurop_register_pool(&use); }
    Registered(const Registered&) = delete;
    Registered& operator=(const Registered&) = delete;
    ~Registered() { indurop_unregister_pool(&use); }
    abi::PoolUse use{Tag::kNameHash, Tag::kTypeHash, sizeof(value_type), Tag::kName};
  };
  // One for each program that uses the pool. NOLINTNEXTLINE(*-avoid-non-const-global-variables,*-identifier-naming)
  static inline Registered use_;
};

}  // namespace indurop
