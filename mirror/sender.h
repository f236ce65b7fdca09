// SPDX-License-Identifier: Apache-2.0
// Store -> frames: looks which of the board's outgoing variables changed and sends their parts.

#pragma once

#include <indurop/detail/abi.h>

#include <array>
#include <cstdint>
#include <vector>

#include "mirror/entity.h"
#include "mirror/mirror_block.h"
#include "mirror/packing.h"
#include "mirror/settings.h"
#include "schema/schema.h"
#include "vars/store.h"
#include "wire.h"

namespace indurop::mirror {

class Sender {
 public:
  // `session` tells this run of the board from earlier ones. Variables the store does not hold are left out.
  Sender(vars::Store& store, const Settings& settings, std::uint64_t session, MirrorBlock& block);

  // Makes the writers and publishes the catalogue. False: `problem` says why.
  bool open(dds_entity_t participant, const Settings& settings, std::string& problem);

  // Sends what changed, and what has not been sent for its keep-alive time. Only with `bulk` the large values. One
  // thread at a time for each of the two.
  void cycle(std::int64_t now_ns, std::uint64_t tick, bool bulk) noexcept;

  [[nodiscard]] bool has_bulk() const noexcept;
  [[nodiscard]] bool empty() const noexcept { return parts_.empty(); }

 private:
  struct Item {
    const vars::DirectoryEntry* entry = nullptr;
    const abi::RingHeader* ring = nullptr;  // null: scalar
    std::uint32_t offset = 0;               // in the part
    std::uint64_t seen = 0;                 // version of the ring last copied
  };
  struct Outbox {
    Part part;
    std::vector<Item> items;
    std::vector<std::uint8_t> image;
    std::int64_t sent_ns = 0;
    bool dirty = true;
  };

  bool refresh(Outbox& out) noexcept;
  bool send(Outbox& out, std::uint32_t number, std::uint64_t update, std::uint64_t tick, std::int64_t now_ns) noexcept;
  void publish_catalogue() noexcept;

  vars::Store& store_;
  MirrorBlock& block_;
  std::uint64_t session_;
  std::uint64_t layout_ = 0;
  std::string board_;
  std::string schema_text_;
  std::vector<Outbox> parts_;
  std::array<Entity, kStreams> writers_;
  Entity catalogue_;
  std::array<std::uint64_t, 2> updates_{};  // of the prompt and of the bulk thread
};

}  // namespace indurop::mirror
