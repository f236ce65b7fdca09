// SPDX-License-Identifier: Apache-2.0
#include "network/mirror/frames/sender.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "network/dds/lent.h"
#include "network/mirror/frames/board_time.h"

namespace indurop::mirror {
namespace {

constexpr const char* kRelease = INDUROP_VERSION;
constexpr std::int64_t kCatalogueAheadNs = 200'000'000;  // a lost catalogue is repeated within this

}  // namespace

Sender::Sender(vars::Store& store, const Settings& settings, std::uint64_t session, MirrorBlock& block)
    : store_(store),
      block_(block),
      session_(session),
      board_(settings.network.board),
      schema_text_(schema::to_json({})),
      sides_{Side(store), Side(store)} {
  const std::string places = place(settings.routes.outgoing, settings.routes.writers, 0);
  const std::string layout_text = schema_text_ + places;
  layout_ = abi::fnv1a64(layout_text.data(), layout_text.size());
  for (Side& side : sides_) {
    (void)side.collector.collect(0);
  }
}

bool Sender::sends(const std::string& variable) const noexcept {
  return std::any_of(sides_.begin(), sides_.end(), [&variable](const Side& side) {
    return std::any_of(side.parts.begin(), side.parts.end(), [&variable](const auto& out) {
      return std::any_of(out->content.begin(), out->content.end(),
                         [&variable](const Content& one) { return one.name == variable; });
    });
  });
}

std::string Sender::place(std::span<const Outgoing> outgoing, const std::deque<Writers>& writers,
                          std::int64_t not_before_ns) {
  std::vector<Parcel> parcels;
  std::vector<Content> contents;
  std::vector<const Writers*> written_by;
  schema::Schema types;
  if (auto known = schema::from_json(schema_text_); known) {
    types = std::move(known).value();
  }
  for (const Outgoing& out : outgoing) {
    const auto* entry = store_.find(abi::fnv1a64(out.variable.data(), out.variable.size()));
    if (entry == nullptr || sends(out.variable)) {
      continue;
    }
    const schema::Variable& variable = store_.schema().variables[entry->schema_index];
    types.variables.push_back(variable);
    parcels.push_back({entry->value_size, out.every_ns, variable.maxage_ns, out.best_effort});
    contents.push_back({*entry, variable.name});
    written_by.push_back(out.writers < 0 ? nullptr : &writers[static_cast<std::size_t>(out.writers)]);
  }
  schema_text_ = schema::to_json(types);
  std::string places;
  for (Part& part : pack(parcels)) {
    const bool bulk = part.stream == Stream::Bulk;
    auto out = std::make_unique<Outbox>();
    out->number = part_count_++;
    out->not_before_ns = not_before_ns;
    out->image.resize(part.size);
    Side& side = sides_[bulk ? 1 : 0];
    const std::lock_guard<std::mutex> guard(side.mutex);
    for (const Placed& placed : part.content) {
      const Content& content = out->content.emplace_back(std::move(contents[placed.parcel]));
      side.collector.add(content.entry, out->image.data() + placed.offset, &out->dirty,
                         bulk ? nullptr : written_by[placed.parcel]);
      places += fmt::format("{}:{}:{}", out->number, placed.offset, content.entry.value_size);
    }
    out->part = std::move(part);
    side.parts.push_back(std::move(out));
  }
  block_.outgoing += static_cast<std::uint32_t>(parcels.size());
  block_.parts = part_count_;
  return places;
}

Plane::Opened Sender::offer() {
  for (const Side& side : sides_) {
    for (const auto& out : side.parts) {
      if (auto offered = plane_->offer_frames(out->part.stream); !offered) {
        return offered;
      }
    }
  }
  return {};
}

Plane::Opened Sender::open(Plane& plane) {
  plane_ = &plane;
  if (auto offered = offer(); !offered) {
    return offered;
  }
  if (auto offered = plane.offer_catalogue(); !offered) {
    return offered;
  }
  for (Side& side : sides_) {
    const std::lock_guard<std::mutex> guard(side.mutex);
    for (const auto& out : side.parts) {
      out->dirty = true;
    }
  }
  publish_catalogue();
  return {};
}

Plane::Opened Sender::add(std::span<const Outgoing> outgoing, const std::deque<Writers>& writers, std::int64_t now_ns) {
  const std::uint32_t before = part_count_;
  (void)place(outgoing, writers, now_ns + kCatalogueAheadNs);
  if (part_count_ == before || plane_ == nullptr) {
    return {};
  }
  if (auto offered = offer(); !offered) {
    return offered;
  }
  publish_catalogue();
  return {};
}

void Sender::publish_catalogue() noexcept {
  std::vector<indurop_wire_CatalogueEntry> entries;
  for (const Side& side : sides_) {
    for (const auto& out : side.parts) {
      for (std::size_t i = 0; i < out->content.size(); ++i) {
        const Content& one = out->content[i];
        entries.push_back({dds::lent(one.name), one.entry.type_hash, out->number, out->part.content[i].offset,
                           one.entry.value_size, static_cast<std::uint8_t>(out->part.stream)});
      }
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
bool Sender::choose(Side& side, std::int64_t now_ns) noexcept {
  const std::uint64_t update = side.updates + 1;
  bool any = false;
  for (const auto& out : side.parts) {
    const std::int64_t since = now_ns - out->sent_ns;
    out->due =
        now_ns >= out->not_before_ns && since >= out->part.every_ns && (out->dirty || since >= out->part.keepalive_ns);
    if (out->due) {
      any = true;
      if (out->together()) {
        update_sum_ += update - out->update;
      }
      out->update = update;
    }
  }
  return any;
}

bool Sender::cycle(std::int64_t now_ns, std::uint64_t tick, bool bulk) noexcept {
  Side& side = sides_[bulk ? 1 : 0];
  const std::lock_guard<std::mutex> guard(side.mutex);
  const bool poll_again = side.collector.collect(now_ns);
  if (!choose(side, now_ns)) {
    return poll_again;
  }
  ++side.updates;
  block_.updates.fetch_add(1, std::memory_order_relaxed);
  for (const auto& out : side.parts) {
    if (out->due) {
      send(*out, tick, now_ns);
    }
  }
  return poll_again;
}

void Sender::send(Outbox& out, std::uint64_t tick, std::int64_t now_ns) noexcept {
  indurop_wire_Frame frame{};
  frame.part = out.number;
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
