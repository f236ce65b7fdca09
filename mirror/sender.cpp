// SPDX-License-Identifier: Apache-2.0
#include "mirror/sender.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "mirror/dds_setup.h"
#include "rt/clock.h"

namespace indurop::mirror {
namespace {

constexpr const char* kRelease = INDUROP_VERSION;

std::uint64_t mix(std::uint64_t hash, const std::string& text) noexcept {
  for (const char c : text) {
    hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  }
  return hash;
}

}  // namespace

Sender::Sender(vars::Store& store, const Settings& settings, std::uint64_t session, MirrorBlock& block)
    : store_(store), block_(block), session_(session), board_(settings.board) {
  std::vector<Parcel> parcels;
  std::vector<const vars::DirectoryEntry*> entries;
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
  }
  schema_text_ = schema::to_json(types);
  layout_ = mix(0xcbf29ce484222325ULL, schema_text_);
  for (Part& part : pack(parcels)) {
    Outbox out;
    out.image.resize(part.size);
    for (const Placed& placed : part.content) {
      const auto* entry = entries[placed.parcel];
      auto* memory = store_.entry(entry->name_hash, 0);
      out.items.push_back({entry,
                           entry->kind == abi::Kind::Ring ? static_cast<const abi::RingHeader*>(memory) : nullptr,
                           placed.offset, ~std::uint64_t{0}});
      layout_ = mix(layout_, fmt::format("{}:{}:{}", parts_.size(), placed.offset, entry->value_size));
    }
    out.part = std::move(part);
    parts_.push_back(std::move(out));
  }
  block_.outgoing = static_cast<std::uint32_t>(entries.size());
  block_.parts = static_cast<std::uint32_t>(parts_.size());
}

bool Sender::has_bulk() const noexcept {
  return std::any_of(parts_.begin(), parts_.end(), [](const Outbox& out) { return out.part.stream == Stream::Bulk; });
}

bool Sender::open(dds_entity_t participant, const Settings& settings, std::string& problem) {
  for (const Outbox& out : parts_) {
    Entity& writer = writers_[static_cast<std::size_t>(out.part.stream)];
    if (writer.ok()) {
      continue;
    }
    writer = make_writer(participant, indurop_wire_Frame_desc,
                         frames_topic(settings.plant, settings.board, out.part.stream), settings, out.part.stream);
    if (!writer.ok()) {
      problem = "cannot send values: " + writer.why();
      return false;
    }
  }
  catalogue_ =
      make_writer(participant, indurop_wire_Catalogue_desc, catalogue_topic(settings.plant), settings, Stream::Prompt);
  if (!catalogue_.ok()) {
    problem = "cannot send the catalogue: " + catalogue_.why();
    return false;
  }
  for (Outbox& out : parts_) {
    out.dirty = true;
  }
  publish_catalogue();
  return true;
}

void Sender::publish_catalogue() noexcept {
  std::vector<indurop_wire_CatalogueEntry> entries;
  for (std::uint32_t number = 0; number < parts_.size(); ++number) {
    for (const Item& item : parts_[number].items) {
      // The sample is only read, and copied before dds_write returns.
      const std::string& name = store_.schema().variables[item.entry->schema_index].name;
      entries.push_back(
          {const_cast<char*>(name.c_str()), item.entry->type_hash, number, item.offset, item.entry->value_size});
    }
  }
  indurop_wire_Catalogue sample{};
  sample.board = board_.data();
  sample.release = const_cast<char*>(kRelease);
  sample.session = session_;
  sample.layout = layout_;
  sample.entries._length = sample.entries._maximum = static_cast<std::uint32_t>(entries.size());
  sample.entries._buffer = entries.data();
  sample.schema = schema_text_.data();
  if (dds_write(catalogue_.get(), &sample) < 0) {
    block_.send_errors.fetch_add(1, std::memory_order_relaxed);
  }
}

void Sender::cycle(std::int64_t now_ns, std::uint64_t tick, bool bulk) noexcept {
  std::uint64_t& updates = updates_[bulk ? 1 : 0];
  bool sent = false;
  for (std::uint32_t number = 0; number < parts_.size(); ++number) {
    Outbox& out = parts_[number];
    if ((out.part.stream == Stream::Bulk) != bulk) {
      continue;
    }
    const std::int64_t since = now_ns - out.sent_ns;
    if (since < out.part.every_ns) {
      continue;
    }
    out.dirty = refresh(out) || out.dirty;
    if (out.dirty || since >= out.part.keepalive_ns) {
      sent = send(out, number, updates + 1, tick, now_ns) || sent;
    }
  }
  if (sent) {
    ++updates;
    block_.updates.fetch_add(1, std::memory_order_relaxed);
  }
}

bool Sender::refresh(Outbox& out) noexcept {
  bool changed = false;
  for (Item& item : out.items) {
    std::uint8_t* const at = out.image.data() + item.offset;
    const std::uint32_t size = item.entry->value_size;
    if (item.ring == nullptr) {
      std::array<std::uint8_t, sizeof(std::uint64_t)> value{};
      (void)store_.read(*item.entry, 0, {value.data(), size});
      if (std::memcmp(value.data(), at, size) != 0) {
        std::memcpy(at, value.data(), size);
        changed = true;
      }
      continue;
    }
    const std::uint64_t version = item.ring->seq.load(std::memory_order_acquire);
    if (version != item.seen && store_.read(*item.entry, 0, {at, size})) {
      item.seen = version;  // a commit during the copy is seen next time
      changed = true;
    }
  }
  return changed;
}

bool Sender::send(Outbox& out, std::uint32_t number, std::uint64_t update, std::uint64_t tick,
                  std::int64_t now_ns) noexcept {
  indurop_wire_Frame frame{};
  frame.part = number;
  frame.layout = static_cast<std::uint32_t>(layout_);
  frame.session = session_;
  frame.update = update;
  frame.tick = tick;
  frame.source_time_ns = rt::wall_ns();
  frame.data._length = frame.data._maximum = static_cast<std::uint32_t>(out.image.size());
  frame.data._buffer = out.image.data();
  if (dds_write(writers_[static_cast<std::size_t>(out.part.stream)].get(), &frame) < 0) {
    block_.send_errors.fetch_add(1, std::memory_order_relaxed);
    return false;  // stays dirty
  }
  out.dirty = false;
  out.sent_ns = now_ns;
  block_.frames.fetch_add(1, std::memory_order_relaxed);
  block_.bytes.fetch_add(out.image.size(), std::memory_order_relaxed);
  return true;
}

}  // namespace indurop::mirror
