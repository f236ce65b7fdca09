// SPDX-License-Identifier: Apache-2.0
// Frames -> store: what this board reads from one other board. Values are written where they differ from the store's,
// so a frame that comes twice does nothing and a value changed here by hand is set right again.

#pragma once

#include <indurop/detail/abi.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "mirror/entity.h"
#include "mirror/mirror_block.h"
#include "mirror/packing.h"
#include "mirror/settings.h"
#include "schema/schema.h"
#include "vars/store.h"
#include "wire.h"

namespace indurop::mirror {

class Receiver {
 public:
  // `variables` that the store does not hold are left out. A board not heard for `patience_ns` after this counts as
  // silent.
  Receiver(vars::Store& store, std::string board, const std::vector<std::string>& variables, std::int64_t patience_ns,
           PeerRecord& record);
  Receiver(const Receiver&) = delete;
  Receiver& operator=(const Receiver&) = delete;

  [[nodiscard]] const std::string& board() const noexcept { return board_; }

  // The board announced itself (again). Compares its variables with this board's and, if they agree, reads its frames
  // from now on; last values arrive at once. Called by the mirror's manager only.
  void announced(const indurop_wire_Catalogue& catalogue, dds_entity_t participant, const Settings& settings);
  // The board fell silent: its values are no longer confirmed.
  void silent() noexcept;
  // Values not confirmed for their maxage, or of a silent board, get their fallback. Returns when to look again,
  // CLOCK_MONOTONIC.
  std::int64_t expire(std::int64_t now_ns) noexcept;
  // Stops reading.
  void close() noexcept;

 private:
  struct Item {
    const vars::DirectoryEntry* entry = nullptr;
    std::atomic<std::int64_t>* confirmed = nullptr;
    std::int64_t maxage_ns = 0;
    const std::vector<std::uint8_t>* fallback = nullptr;
    bool fallen_back = false;
  };
  struct Arrival {  // where the board put an item
    std::uint32_t item = 0;
    std::uint32_t offset = 0;
  };
  struct Inbox {
    std::uint32_t size = 0;    // least number of bytes a frame must have
    std::uint64_t update = 0;  // newest one taken over
    std::vector<Arrival> content;
  };

  static void on_data(dds_entity_t reader, void* self);
  void take(dds_entity_t reader) noexcept;
  void apply(const indurop_wire_Frame& frame, std::uint64_t& newest_update, std::int64_t now_ns) noexcept;
  void put(Item& item, std::span<const std::uint8_t> value) noexcept;
  std::string match(const indurop_wire_Catalogue& catalogue, std::vector<Inbox>& inboxes) const;

  vars::Store& store_;
  std::string board_;
  PeerRecord& record_;
  std::int64_t patient_until_ns_;
  std::vector<Item> items_;
  std::vector<std::uint8_t> present_;  // a value of the store, to compare with
  std::mutex mutex_;                   // between the receive thread and the manager; the control loop never takes it
  std::uint64_t session_ = 0;
  std::uint64_t layout_ = 0;
  std::array<std::uint64_t, kStreams> newest_update_{};
  std::vector<Inbox> inboxes_;  // by part
  std::array<Entity, kStreams> readers_;
};

}  // namespace indurop::mirror
