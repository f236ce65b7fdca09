// SPDX-License-Identifier: Apache-2.0
#include "network/mirror/frames/sender.h"

#include <fmt/format.h>

#include <algorithm>

#include "network/dds/lent.h"
#include "network/mirror/frames/board_time.h"

namespace indurop::mirror {
namespace {

constexpr const char* kRelease = INDUROP_VERSION;

}  // namespace

Sender::Sender(vars::Store& store, const Settings& settings, std::uint64_t session, MirrorBlock& block)
    : store_(store),
      block_(block),
      session_(session),
      board_(settings.network.board),
      collectors_{ChangeCollector(store), ChangeCollector(store)} {
  std::vector<Parcel> parcels;
  std::vector<const vars::DirectoryEntry*> entries;
  std::vector<const Writers*> writers;
  schema::Schema types;
  for (const Outgoing& out : settings.outgoing) {
    const auto* entry = store_.find(abi::fnv1a64(out.variable.data(), out.variable.size()));
    if (entry == nullptr) {
      continue;
    }
    const schema::Variable& variable = store_.schema().variables[entry->schema_index];
    types.variables.push_back(variable);
    parcels.push_back({entry->value_size, out.every_ns, variable.maxage_ns, out.best_effort});
    entries.push_back(entry);
    writers.push_back(out.writers < 0 ? nullptr : &settings.writers[static_cast<std::size_t>(out.writers)]);
  }
  schema_text_ = schema::to_json(types);
  std::string layout_text = schema_text_;
  std::vector<Part> parts = pack(parcels);
  parts_.reserve(parts.size());  // the collectors hold pointers to them
  for (Part& part : parts) {
    Outbox& out = parts_.emplace_back();
    out.image.resize(part.size);
    const bool bulk = part.stream == Stream::Bulk;
    for (const Placed& placed : part.content) {
      const auto* entry = entries[placed.parcel];
      out.content.push_back(entry);
      collectors_[bulk ? 1 : 0].add(*entry, out.image.data() + placed.offset, &out.dirty,
                                    bulk ? nullptr : writers[placed.parcel]);
      layout_text += fmt::format("{}:{}:{}", parts_.size() - 1, placed.offset, entry->value_size);
    }
    out.part = std::move(part);
  }
  layout_ = abi::fnv1a64(layout_text.data(), layout_text.size());
  block_.outgoing = static_cast<std::uint32_t>(entries.size());
  block_.parts = static_cast<std::uint32_t>(parts_.size());
  for (ChangeCollector& collector : collectors_) {
    (void)collector.collect(0);
  }
}

bool Sender::has_bulk() const noexcept {
  return std::any_of(parts_.begin(), parts_.end(), [](const Outbox& out) { return out.part.stream == Stream::Bulk; });
}

Plane::Opened Sender::open(Plane& plane) {
  plane_ = &plane;
  for (const Outbox& out : parts_) {
    if (auto offered = plane.offer_frames(out.part.stream); !offered) {
      return offered;
    }
  }
  if (auto offered = plane.offer_catalogue(); !offered) {
    return offered;
  }
  for (Outbox& out : parts_) {
    out.dirty = true;
  }
  publish_catalogue();
  return {};
}

void Sender::publish_catalogue() noexcept {
  std::vector<indurop_wire_CatalogueEntry> entries;
  for (std::uint32_t number = 0; number < parts_.size(); ++number) {
    const Outbox& out = parts_[number];
    for (std::size_t i = 0; i < out.content.size(); ++i) {
      const vars::DirectoryEntry& entry = *out.content[i];
      const std::string& name = store_.schema().variables[entry.schema_index].name;
      entries.push_back({dds::lent(name), entry.type_hash, number, out.part.content[i].offset, entry.value_size,
                         static_cast<std::uint8_t>(out.part.stream)});
    }
  }
  indurop_wire_Catalogue sample{};
  sample.board = board_.data();
  sample.release = dds::lent(kRelease);
  sample.session = session_;
  sample.layout = layout_;
  sample.entries._length = sample.entries._maximum = static_cast<std::uint32_t>(entries.size());
  sample.entries._buffer = entries.data();
  sample.schema = schema_text_.data();
  if (!plane_->send(sample)) {
    block_.send_errors.fetch_add(1, std::memory_order_relaxed);
  }
}

// Chooses what is part of the next update. Returns false if there is nothing.
bool Sender::choose(std::int64_t now_ns, bool bulk) noexcept {
  const std::uint64_t update = updates_[bulk ? 1 : 0] + 1;
  bool any = false;
  for (Outbox& out : parts_) {
    if ((out.part.stream == Stream::Bulk) != bulk) {
      continue;
    }
    const std::int64_t since = now_ns - out.sent_ns;
    out.due = since >= out.part.every_ns && (out.dirty || since >= out.part.keepalive_ns);
    if (out.due) {
      any = true;
      if (out.together()) {
        update_sum_ += update - out.update;
      }
      out.update = update;
    }
  }
  return any;
}

bool Sender::cycle(std::int64_t now_ns, std::uint64_t tick, bool bulk) noexcept {
  const bool poll_again = collectors_[bulk ? 1 : 0].collect(now_ns);
  if (!choose(now_ns, bulk)) {
    return poll_again;
  }
  ++updates_[bulk ? 1 : 0];
  block_.updates.fetch_add(1, std::memory_order_relaxed);
  for (std::uint32_t number = 0; number < parts_.size(); ++number) {
    if ((parts_[number].part.stream == Stream::Bulk) == bulk && parts_[number].due) {
      send(number, tick, now_ns);
    }
  }
  return poll_again;
}

void Sender::send(std::uint32_t number, std::uint64_t tick, std::int64_t now_ns) noexcept {
  Outbox& out = parts_[number];
  indurop_wire_Frame frame{};
  frame.part = number;
  frame.layout = static_cast<std::uint32_t>(layout_);
  frame.session = session_;
  frame.update = out.update;
  frame.update_sum = out.together() ? update_sum_ : 0;
  frame.tick = tick;
  frame.source_time_ns = board_wall_ns(store_);
  frame.data._length = frame.data._maximum = static_cast<std::uint32_t>(out.image.size());
  frame.data._buffer = out.image.data();
  if (!plane_->send(frame, out.part.stream)) {
    block_.send_errors.fetch_add(1, std::memory_order_relaxed);
    return;  // stays dirty; readers get it with the next update
  }
  out.dirty = false;
  out.sent_ns = now_ns;
  block_.frames.fetch_add(1, std::memory_order_relaxed);
  block_.bytes.fetch_add(out.image.size(), std::memory_order_relaxed);
}

}  // namespace indurop::mirror
