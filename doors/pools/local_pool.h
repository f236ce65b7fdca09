// SPDX-License-Identifier: Apache-2.0
// A pool of a node of this machine, as a user of it that survives the node: it takes a seat, and another one when the
// node has been started again. Used by one thread. Not real-time safe.

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "core/base/log.h"
#include "core/rt/clock.h"
#include "store/pools/pool.h"
#include "store/vars/store.h"

namespace indurop::pool_door {

class LocalPool {
 public:
  // `pool`: full name.
  LocalPool(std::string node, std::string pool) : node_(std::move(node)), name_(std::move(pool)) {}
  LocalPool(const LocalPool&) = delete;
  LocalPool& operator=(const LocalPool&) = delete;
  ~LocalPool() { leave(); }

  // Returns true if the pool is the one that the node has now, or if the node does not run and left it.
  [[nodiscard]] bool is_current() const;
  // Takes a seat in the pool that the node has now; must not have one. Returns false if that is impossible at the
  // moment; the log says why, once for each reason.
  bool enter(const base::Log& log);
  // Frees the seat, with the chunks in its hand.
  void leave() noexcept;

  [[nodiscard]] bool entered() const noexcept { return seat_.has_value(); }
  [[nodiscard]] const std::string& node() const noexcept { return node_; }
  [[nodiscard]] const std::string& name() const noexcept { return name_; }

  // The rest requires a seat.
  [[nodiscard]] const pools::Shape& shape() const noexcept { return shape_; }
  [[nodiscard]] const std::string& type() const noexcept { return type_; }  // of a chunk
  [[nodiscard]] std::byte* data(std::uint32_t chunk) const noexcept { return pool_->data(chunk); }
  [[nodiscard]] rt::MonoTime now() const noexcept;  // in the node's time
  [[nodiscard]] rt::MonoTime time_of(std::uint32_t chunk) const noexcept { return pool_->chunks().time_of(chunk); }
  std::optional<pools::Held> latest() noexcept { return pool_->chunks().latest(*seat_); }
  void release(const pools::Held& held) noexcept { pool_->chunks().release(*seat_, held.chunk); }
  std::optional<std::uint32_t> take() noexcept { return pool_->chunks().take(*seat_); }
  void publish(std::uint32_t chunk, rt::MonoTime at) noexcept { (void)pool_->chunks().publish(*seat_, chunk, at); }
  void discard(std::uint32_t chunk) noexcept { pool_->chunks().discard(*seat_, chunk); }

 private:
  bool try_enter();
  bool fail(std::string problem);

  std::string node_;
  std::string name_;
  std::string problem_;   // of the last attempt; empty: none
  std::string reported_;  // the last problem in the log
  std::string type_;
  pools::Shape shape_;
  std::optional<vars::Store> store_;
  std::optional<pools::Pool> pool_;
  std::optional<std::uint32_t> seat_;
};

}  // namespace indurop::pool_door
