// SPDX-License-Identifier: Apache-2.0
#include "network/mirror/frames/change_collector.h"

#include <algorithm>
#include <cstring>

namespace indurop::mirror {

void ChangeCollector::add(const vars::DirectoryEntry& entry, std::uint8_t* image, bool* changed,
                          const Writers* writers) {
  auto group = std::find_if(groups_.begin(), groups_.end(), [&](const Group& g) { return g.writers == writers; });
  if (group == groups_.end()) {
    groups_.push_back({writers, {}, {}, {}, 0});
    group = groups_.end() - 1;
  }
  Item item;
  item.entry = entry;
  item.ring =
      entry.kind == abi::Kind::Ring ? static_cast<const abi::RingHeader*>(store_.entry(entry.name_hash, 0)) : nullptr;
  item.image = image;
  item.changed = changed;
  item.place = static_cast<std::uint32_t>(group->copies.size());
  group->copies.resize(group->copies.size() + entry.value_size);
  group->items.push_back(item);
  group->differing.reserve(group->items.size());
}

bool ChangeCollector::copy_if_different(Group& group, Item& item) const noexcept {
  std::uint8_t* const to = group.copies.data() + item.place;
  const std::span<std::uint8_t> value(to, item.entry.value_size);
  if (item.ring == nullptr) {
    return store_.read(item.entry, 0, value).ok() && std::memcmp(to, item.image, value.size()) != 0;
  }
  const std::uint64_t version = item.ring->seq.load(std::memory_order_acquire);
  if (version == item.seen || !store_.read(item.entry, 0, value)) {
    return false;
  }
  item.fresh = version;  // a commit during the copy is seen next time
  return true;
}

void ChangeCollector::copy_differing(Group& group) const noexcept {
  group.differing.clear();
  for (std::uint32_t i = 0; i < group.items.size(); ++i) {
    if (copy_if_different(group, group.items[i])) {
      group.differing.push_back(i);
    }
  }
}

// Returns false if the writers are in a run.
bool ChangeCollector::collect_group(Group& group, std::int64_t now_ns) const noexcept {
  const std::uint64_t before = group.writers == nullptr ? 0 : group.writers->runs();
  const bool patient = group.writers == nullptr || group.waiting_since_ns == 0 ||
                       now_ns - group.waiting_since_ns < group.writers->patience_ns;
  if (before % 2 != 0 && patient) {
    return false;
  }
  copy_differing(group);
  std::atomic_thread_fence(std::memory_order_acquire);
  if (patient && group.writers != nullptr && group.writers->runs() != before) {
    return false;  // a run has begun meanwhile: this may be half of its output
  }
  for (const std::uint32_t i : group.differing) {
    Item& item = group.items[i];
    std::memcpy(item.image, group.copies.data() + item.place, item.entry.value_size);
    item.seen = item.fresh;
    *item.changed = true;
  }
  return true;
}

bool ChangeCollector::collect(std::int64_t now_ns) noexcept {
  bool poll_again = false;
  for (Group& group : groups_) {
    if (collect_group(group, now_ns)) {
      group.waiting_since_ns = 0;
      continue;
    }
    group.waiting_since_ns = group.waiting_since_ns == 0 ? now_ns : group.waiting_since_ns;
    poll_again = poll_again || !group.writers->notifies;
  }
  return poll_again;
}

}  // namespace indurop::mirror
