// SPDX-License-Identifier: Apache-2.0
// One variable of another board in this board's store: the value of the board that leads, its age, and its fallback
// when no board confirms it. Usually one board sends it, with a standby two do.

#pragma once

#include <indurop/detail/abi.h>

#include <cstdint>
#include <span>
#include <vector>

#include "core/schema/schema.h"
#include "network/mirror/frames/mirror_block.h"
#include "network/mirror/frames/update_word.h"
#include "store/vars/store.h"

namespace indurop::mirror {

// Not thread safe: all landings of a mirror are used under one mutex, which the control loop never takes.
class Landing {
 public:
  // If no source has sent anything by `patient_until_ns` (CLOCK_MONOTONIC), the variable gets its fallback.
  Landing(vars::Store& store, const vars::DirectoryEntry& entry, std::int64_t patient_until_ns);

  [[nodiscard]] const vars::DirectoryEntry& entry() const noexcept { return entry_; }
  [[nodiscard]] const schema::Variable& variable() const noexcept { return variable_; }

  // Adds a board that sends the variable, in the manifest's order. Returns its number for the calls below.
  // `patient_until_ns`: as above, if the variable was read from none any more.
  std::size_t add_source(std::int64_t patient_until_ns = 0);
  // The variable is no longer read from this board, or read from it again. If it is read from none, it keeps its value
  // and is one of this board. If it was, it waits for a value, until `patient_until_ns` as above.
  void leave(std::size_t source, std::int64_t now_ns, PeerRecord& record) noexcept;
  void enter(std::size_t source, std::int64_t patient_until_ns) noexcept;
  // Returns the space in the variable's entry for the update word of one of its boards; null if another board uses it.
  [[nodiscard]] std::atomic<std::uint64_t>* lend_room_for_word() noexcept;
  struct Arrival {
    std::size_t source = 0;
    std::uint64_t session = 0;   // distinguishes runs of a board
    UpdateWord* word = nullptr;  // the value is part of an update; null: it is sent on its own
    std::int64_t now_ns = 0;
  };
  // A value arrived: it is written if its source leads (leading_board.h) and the store's value differs.
  void deliver(const Arrival& arrival, std::span<const std::uint8_t> value, PeerRecord& record) noexcept;
  // The source's board is gone. If there is another source, its last value counts from now on.
  void silent(std::size_t source, std::int64_t now_ns, PeerRecord& record) noexcept;
  // Writes the fallback if it is due. Returns when to call again.
  std::int64_t expire(std::int64_t now_ns) noexcept;

 private:
  struct Source {
    bool is_read = true;
    std::uint64_t session = 0;  // 0: silent
    UpdateWord* word = nullptr;
    std::vector<std::uint8_t> last;  // only if there is more than one source
  };
  static constexpr std::size_t kNone = ~std::size_t{0};

  [[nodiscard]] std::size_t leader() const noexcept;
  [[nodiscard]] bool is_read() const noexcept;
  void await(std::int64_t patient_until_ns) noexcept;
  void put(std::span<const std::uint8_t> value, PeerRecord& record) noexcept;
  void follow(UpdateWord* word) noexcept;

  vars::Store& store_;
  // Copies: those of a variable that appeared in a run do not stay in their places.
  const vars::DirectoryEntry entry_;
  const schema::Variable variable_;
  std::atomic<std::int64_t>& confirmed_;
  std::atomic<std::int64_t>& update_offset_;
  UpdateWord* word_ = nullptr;  // update word of the source that leads
  bool room_lent_ = false;
  std::int64_t patient_until_ns_;
  std::vector<Source> sources_;
  std::vector<std::uint8_t> present_;  // the store's value, to compare with
  bool fallen_back_ = false;
};

}  // namespace indurop::mirror
