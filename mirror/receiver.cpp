// SPDX-License-Identifier: Apache-2.0
#include "mirror/receiver.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "mirror/dds_setup.h"
#include "rt/clock.h"

namespace indurop::mirror {
namespace {

constexpr std::size_t kMostParts = 100'000;  // of a sane catalogue
constexpr std::int64_t kNoHurryNs = 100'000'000;

const schema::Variable* find_variable(const schema::Schema& schema, const std::string& name) {
  const auto found = std::find_if(schema.variables.begin(), schema.variables.end(),
                                  [&](const schema::Variable& v) { return v.name == name; });
  return found == schema.variables.end() ? nullptr : &*found;
}

}  // namespace

Receiver::Receiver(vars::Store& store, std::string board, const std::vector<std::string>& variables,
                   std::int64_t patience_ns, PeerRecord& record)
    : store_(store), board_(std::move(board)), record_(record), patient_until_ns_(rt::now_ns() + patience_ns) {
  for (const std::string& name : variables) {
    const auto* entry = store_.find(abi::fnv1a64(name.data(), name.size()));
    if (entry == nullptr) {
      continue;
    }
    const schema::Variable& variable = store_.schema().variables[entry->schema_index];
    auto& confirmed = abi::confirmed_of(store_.entry(entry->name_hash, 0), entry->kind);
    confirmed.store(abi::kNeverConfirmed, std::memory_order_release);
    items_.push_back(
        {entry, &confirmed, variable.maxage_ns, variable.fallback.empty() ? nullptr : &variable.fallback, false});
    present_.resize(std::max<std::size_t>(present_.size(), entry->value_size));
  }
  record_.wanted = static_cast<std::uint32_t>(items_.size());
}

std::string Receiver::match(const indurop_wire_Catalogue& catalogue, std::vector<Inbox>& inboxes) const {
  std::string problem;
  std::size_t more = 0;
  const auto complain = [&](std::string text) {
    if (problem.empty()) {
      problem = std::move(text);
    } else {
      ++more;
    }
  };
  const auto theirs = schema::from_json(catalogue.schema);
  const indurop_wire_CatalogueEntry* const first = catalogue.entries._buffer;
  const indurop_wire_CatalogueEntry* const last = first + catalogue.entries._length;
  for (std::uint32_t i = 0; i < items_.size(); ++i) {
    const Item& item = items_[i];
    const schema::Variable& mine = store_.schema().variables[item.entry->schema_index];
    const auto* found = std::find_if(first, last, [&](const auto& entry) { return mine.name == entry.name; });
    if (found == last) {
      complain(fmt::format("board {} does not send {}: it runs another deployment", board_, mine.name));
      continue;
    }
    if (found->type_hash != mine.type_hash || found->size != item.entry->value_size) {
      const auto* other = theirs ? find_variable(theirs.value(), mine.name) : nullptr;
      complain(fmt::format("{} differs between the boards: {} (here / on {}); build both from the same .glb", mine.name,
                           other != nullptr ? schema::first_difference(mine.type, other->type) : "another type",
                           board_));
      continue;
    }
    if (found->part >= kMostParts || found->offset > std::numeric_limits<std::uint32_t>::max() - found->size) {
      complain(fmt::format("the catalogue of board {} is damaged", board_));
      continue;
    }
    if (found->part >= inboxes.size()) {
      inboxes.resize(found->part + 1);
    }
    Inbox& inbox = inboxes[found->part];
    inbox.size = std::max(inbox.size, found->offset + found->size);
    inbox.content.push_back({i, found->offset});
  }
  return more > 0 ? fmt::format("{} (and {} more)", problem, more) : problem;
}

void Receiver::announced(const indurop_wire_Catalogue& catalogue, dds_entity_t participant, const Settings& settings) {
  if (catalogue.session == session_ && catalogue.layout == layout_) {
    record_.state.store(readers_[0].ok() || items_.empty() ? PeerState::Alive : PeerState::Mismatched,
                        std::memory_order_release);
    return;
  }
  close();
  std::vector<Inbox> inboxes;
  const std::string problem = match(catalogue, inboxes);
  record_.problem.set(problem);
  {
    const std::lock_guard<std::mutex> guard(mutex_);
    session_ = catalogue.session;
    layout_ = catalogue.layout;
    newest_update_ = {};
    inboxes_ = std::move(inboxes);
  }
  if (!problem.empty()) {
    record_.state.store(PeerState::Mismatched, std::memory_order_release);
    return;
  }
  record_.state.store(PeerState::Alive, std::memory_order_release);
  dds_listener_t* listener = dds_create_listener(this);
  dds_lset_data_available(listener, &Receiver::on_data);
  for (std::size_t i = 0; i < kStreams && !items_.empty(); ++i) {
    const auto stream = static_cast<Stream>(i);
    readers_[i] = make_reader(participant, indurop_wire_Frame_desc, frames_topic(settings.plant, board_, stream),
                              settings, stream, listener);
    if (!readers_[i].ok()) {
      record_.problem.set("cannot receive: " + readers_[i].why());
    }
  }
  dds_delete_listener(listener);
}

void Receiver::close() noexcept {
  for (Entity& reader : readers_) {
    reader.reset();  // waits for a listener that is running
  }
}

void Receiver::on_data(dds_entity_t reader, void* self) {
  static_cast<Receiver*>(self)->take(reader);
}

void Receiver::take(dds_entity_t reader) noexcept {
  constexpr std::uint32_t kAtOnce = 32;
  std::size_t stream = 0;
  while (stream + 1 < kStreams && readers_[stream].get() != reader) {
    ++stream;
  }
  std::array<void*, kAtOnce> samples{};
  std::array<dds_sample_info_t, kAtOnce> infos{};
  for (;;) {
    samples[0] = nullptr;  // lend us memory
    const int count = dds_take(reader, samples.data(), infos.data(), kAtOnce, kAtOnce);
    if (count <= 0) {
      return;
    }
    {
      const std::lock_guard<std::mutex> guard(mutex_);
      const std::int64_t now = rt::now_ns();
      for (int i = 0; i < count; ++i) {
        if (infos[static_cast<std::size_t>(i)].valid_data) {
          apply(*static_cast<const indurop_wire_Frame*>(samples[static_cast<std::size_t>(i)]), newest_update_[stream],
                now);
        }
      }
    }
    (void)dds_return_loan(reader, samples.data(), count);
  }
}

void Receiver::apply(const indurop_wire_Frame& frame, std::uint64_t& newest_update, std::int64_t now_ns) noexcept {
  constexpr auto kRelaxed = std::memory_order_relaxed;
  if (frame.session != session_ || frame.layout != static_cast<std::uint32_t>(layout_)) {
    record_.refused.fetch_add(1, kRelaxed);
    return;
  }
  if (frame.part >= inboxes_.size() || inboxes_[frame.part].content.empty()) {
    return;  // holds nothing this board reads
  }
  Inbox& inbox = inboxes_[frame.part];
  if (frame.data._length < inbox.size) {
    record_.refused.fetch_add(1, kRelaxed);
    return;
  }
  if (frame.update < inbox.update) {
    return;  // older than what is here
  }
  inbox.update = frame.update;
  if (frame.update > newest_update) {
    if (newest_update != 0) {
      record_.lost_updates.fetch_add(frame.update - newest_update - 1, kRelaxed);
    }
    newest_update = frame.update;
  }
  for (const Arrival& arrival : inbox.content) {
    Item& item = items_[arrival.item];
    put(item, {frame.data._buffer + arrival.offset, item.entry->value_size});
    item.fallen_back = false;
    item.confirmed->store(now_ns, std::memory_order_release);
  }
  record_.heard_ns.store(now_ns, kRelaxed);
  record_.delay_ns.store(rt::wall_ns() - frame.source_time_ns, kRelaxed);
  record_.tick.store(frame.tick, kRelaxed);
  record_.frames.fetch_add(1, kRelaxed);
}

void Receiver::put(Item& item, std::span<const std::uint8_t> value) noexcept {
  const std::span<std::uint8_t> present(present_.data(), value.size());
  if (store_.read(*item.entry, 0, present) && std::equal(value.begin(), value.end(), present.begin())) {
    return;
  }
  const bool written = store_.write(*item.entry, 0, value).ok();
  (written ? record_.values : record_.busy).fetch_add(1, std::memory_order_relaxed);
}

void Receiver::silent() noexcept {
  const std::lock_guard<std::mutex> guard(mutex_);
  if (record_.state.exchange(PeerState::Silent) == PeerState::Silent) {
    return;
  }
  record_.losses.fetch_add(1, std::memory_order_relaxed);
  for (Item& item : items_) {
    const std::int64_t last = item.confirmed->load(std::memory_order_relaxed);
    if (last > 0) {
      item.confirmed->store(-last, std::memory_order_release);
    }
  }
}

std::int64_t Receiver::expire(std::int64_t now_ns) noexcept {
  const std::lock_guard<std::mutex> guard(mutex_);
  std::int64_t next = now_ns + kNoHurryNs;
  for (Item& item : items_) {
    if (item.fallback == nullptr || item.fallen_back) {
      continue;
    }
    const std::int64_t last = item.confirmed->load(std::memory_order_relaxed);
    // Without a maxage a value is good for as long as its board lives.
    std::int64_t ends = std::numeric_limits<std::int64_t>::max();
    if (last == abi::kNeverConfirmed) {
      ends = patient_until_ns_;
    } else if (last < 0) {
      ends = item.maxage_ns > 0 ? item.maxage_ns - last : now_ns;
    } else if (item.maxage_ns > 0) {
      ends = last + item.maxage_ns;
    }
    if (now_ns >= ends) {
      item.fallen_back = store_.write(*item.entry, 0, *item.fallback).ok();
    } else {
      next = std::min(next, ends);
    }
  }
  return next;
}

}  // namespace indurop::mirror
