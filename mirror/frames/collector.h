// SPDX-License-Identifier: Apache-2.0
// Store -> images of frames. Variables that are written together are copied between two runs of their writers, all or
// none of them, so that no frame shows half a tick.

#pragma once

#include <indurop/detail/abi.h>

#include <cstdint>
#include <vector>

#include "mirror/frames/settings.h"
#include "vars/store.h"

namespace indurop::mirror {

class Collector {
 public:
  // Everything is borrowed until the end; `store` too.
  explicit Collector(const vars::Store& store) : store_(store) {}

  // Copies the variable to `image` whenever it changed, and says so in `changed`. `writers` null: anybody.
  void add(const vars::DirectoryEntry& entry, std::uint8_t* image, bool* changed, const Writers* writers);

  // Copies what changed. True: somebody who does not tell is in a run, so look again soon.
  bool collect(std::int64_t now_ns) noexcept;

 private:
  struct Item {
    const vars::DirectoryEntry* entry = nullptr;
    const abi::RingHeader* ring = nullptr;  // null: scalar
    std::uint8_t* image = nullptr;
    bool* changed = nullptr;
    std::uint64_t seen = ~std::uint64_t{0};  // version of the ring last copied
    std::uint64_t fresh = 0;                 // version in `copies`
    std::uint32_t place = 0;                 // in `copies`
  };
  struct Group {
    const Writers* writers = nullptr;
    std::vector<Item> items;
    std::vector<std::uint8_t> copies;
    std::vector<std::uint32_t> differing;  // items with a new value in `copies`
    std::int64_t waiting_since_ns = 0;     // 0: not
  };

  void copy_differing(Group& group) const noexcept;
  bool copy_if_different(Group& group, Item& item) const noexcept;
  bool collect_group(Group& group, std::int64_t now_ns) const noexcept;

  const vars::Store& store_;
  std::vector<Group> groups_;
};

}  // namespace indurop::mirror
