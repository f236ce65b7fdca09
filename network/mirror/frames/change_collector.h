// SPDX-License-Identifier: Apache-2.0
// Copies values from the store to the images of frames. Variables that are written together are copied between two runs
// of their writers, all or none of them, so that no frame shows half a tick.

#pragma once

#include <indurop/detail/abi.h>

#include <cstdint>
#include <vector>

#include "network/mirror/frames/settings.h"
#include "store/vars/store.h"

namespace indurop::mirror {

class ChangeCollector {
 public:
  // `store`, and the addresses below, are borrowed until the end.
  explicit ChangeCollector(const vars::Store& store) : store_(store) {}

  // Copies the variable to `image` whenever it has changed, and sets `changed`. `writers` null: any process may write
  // it. Not during collect().
  void add(const vars::DirectoryEntry& entry, std::uint8_t* image, bool* changed, const Writers* writers);

  // Copies what has changed. Returns true if a writer that does not notify is in a run: then call again soon.
  bool collect(std::int64_t now_ns) noexcept;

 private:
  struct Item {
    vars::DirectoryEntry entry{};  // a copy: that of a variable that appeared in a run does not stay in its place
    const abi::RingHeader* ring = nullptr;  // null: scalar
    std::uint8_t* image = nullptr;
    bool* changed = nullptr;
    std::uint64_t seen = ~std::uint64_t{0};  // version of the ring that was copied last
    std::uint64_t fresh = 0;                 // version in `copies`
    std::uint32_t place = 0;                 // index in `copies`
  };
  struct Group {
    const Writers* writers = nullptr;
    std::vector<Item> items;
    std::vector<std::uint8_t> copies;
    std::vector<std::uint32_t> differing;  // items with a new value in `copies`
    std::int64_t waiting_since_ns = 0;     // 0: not waiting
  };

  void copy_differing(Group& group) const noexcept;
  bool copy_if_different(Group& group, Item& item) const noexcept;
  bool collect_group(Group& group, std::int64_t now_ns) const noexcept;

  const vars::Store& store_;
  std::vector<Group> groups_;
};

}  // namespace indurop::mirror
