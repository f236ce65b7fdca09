// SPDX-License-Identifier: Apache-2.0
// A pool of a node: its file in shared memory, and the seats of the modules and programs that use it. Nothing here is
// real-time safe, except what chunks() returns.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "store/pools/chunks.h"
#include "store/pools/layout.h"
#include "store/vars/shm_file.h"

namespace indurop::pools {

// What two programs must agree on to share a pool.
struct Shape {
  std::string name;  // full name, "knu::Vision::camera"
  std::uint64_t type_hash = 0;
  std::uint64_t chunk_bytes = 0;
  std::uint32_t chunks = 0;
};

// What tools show of a seat and of a pool.
struct User {
  std::string name;
  std::int32_t pid = 0;
  std::uint64_t seen = 0;  // number of the newest chunk it has read, 0: none
  std::uint64_t missed = 0;
  std::uint64_t published = 0;
  std::uint64_t without_a_chunk = 0;
  std::uint32_t holds = 0;  // chunks in its hand to read
  std::uint32_t fills = 0;  // chunks in its hand to fill
};
struct Usage {
  std::uint32_t free = 0;
  std::uint64_t numbers = 0;          // chunks published so far
  std::uint64_t missed = 0;           // chunks that readers of each chunk were too slow for
  std::uint64_t without_a_chunk = 0;  // chunks that writers could not fill, because none was free
  std::uint64_t recovered = 0;        // chunks found in the hand of processes that were gone
  std::int64_t newest_ns = 0;         // when the newest one was published, in the node's time
  std::vector<User> users;
};

class Pool {
 public:
  // Makes the pool's file, or adopts the one of an earlier run with the same shape: its published chunks and the
  // processes that use it stay, what dead ones had in their hand is freed. Another file of this name is retired. Only
  // the holder of the node lock may call it. Errors: InvalidArgument (node name, shape), NoSpace, PermissionDenied (the
  // file is another user's), System. On error no file is left.
  static Result<Pool> create(const std::string& node, const Shape& shape);
  // Errors: NotFound (no such pool), PermissionDenied, VersionMismatch, TypeMismatch (another type), Corrupt, NoSpace,
  // System.
  static Result<Pool> open(const std::string& node, std::string_view name, std::uint64_t type_hash, vars::Mode mode);

  // Takes a seat for this process, after those of dead processes were freed. Errors: NoSpace (kSeats are taken), Busy
  // (the lock of the seats was not free in 5 ms: try again).
  Result<std::uint32_t> take_seat(std::string_view user);
  // Frees what the seat has in its hand, and the seat.
  void leave_seat(std::uint32_t seat) noexcept;
  // Frees the seats of processes that are gone, with all that they had in their hand. Returns how many chunks these
  // were. Called by the node in the background. Does nothing while another process does it.
  std::uint32_t sweep() noexcept;

  // Returns false if the node has another file for this pool, or none. Not real-time safe.
  [[nodiscard]] bool is_current() const noexcept { return !retired() && file_.named() == vars::ShmFile::Named::Whole; }

  // For its creator at the end: processes that use it find it retired, and the file is removed.
  void remove() noexcept;
  [[nodiscard]] bool retired() const noexcept { return header().retired.load(std::memory_order_acquire) != 0; }

  [[nodiscard]] Chunks chunks() const noexcept { return {header(), chunk_count_}; }
  [[nodiscard]] std::byte* data(std::uint32_t chunk) const noexcept {
    return file_.data() + data_offset_ + chunk * stride_;
  }
  [[nodiscard]] Shape shape() const;
  [[nodiscard]] Usage usage() const;
  [[nodiscard]] std::uint64_t bytes() const noexcept { return file_.size(); }
  void prefault() const noexcept { file_.prefault(); }

 private:
  explicit Pool(vars::ShmFile&& file) noexcept;
  [[nodiscard]] PoolHeader& header() const noexcept { return *reinterpret_cast<PoolHeader*>(file_.data()); }
  std::uint32_t free_dead_seats() noexcept;

  vars::ShmFile file_;
  std::string file_name_;
  // Copies: what is in the memory may be changed by any process that writes it.
  std::uint32_t chunk_count_;
  std::uint64_t stride_;
  std::uint64_t data_offset_;
};

// Retires and removes the files of a node's pools that are not among `files`. Only for the holder of the node lock.
void remove_others(const std::string& node, const std::vector<std::string>& files);

}  // namespace indurop::pools
