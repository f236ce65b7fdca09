// SPDX-License-Identifier: Apache-2.0
#include "network/mirror/frames/receiver.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

#include "core/rt/relaxed.h"
#include "network/mirror/frames/board_time.h"

namespace indurop::mirror {
namespace {

constexpr std::size_t kMaxParts = 100'000;  // maximum of a valid catalogue

// The schema is read only now: that takes longer than the rest of a catalogue.
std::string difference(const schema::Variable& mine, const char* their_schema) {
  if (their_schema == nullptr) {
    return "another type";
  }
  const auto theirs = schema::from_json(their_schema);
  const auto* other = theirs ? schema::find_variable(theirs.value(), mine.name) : nullptr;
  return other != nullptr ? schema::first_difference(mine.type, other->type) : "another type";
}

}  // namespace

Receiver::Receiver(std::string board, const vars::Store& store, const std::vector<Landing*>& landings,
                   std::mutex& mutex, PeerRecord& record)
    : board_(std::move(board)), store_(store), mutex_(mutex), record_(record) {
  for (Landing* landing : landings) {
    items_.push_back({landing, landing->add_source()});
    lend_room(*landing);
  }
  record_.wanted = static_cast<std::uint32_t>(items_.size());
}

void Receiver::lend_room(Landing& landing) {
  if (std::atomic<std::uint64_t>* const room = has_room_ ? nullptr : landing.lend_room_for_word(); room != nullptr) {
    word_ = UpdateWord(room);
    has_room_ = true;
  }
}

Receiver::Match Receiver::match(const char* schema) const {
  Match all;
  std::size_t more = 0;
  const auto complain = [&](const Item& item, const auto& text) {
    all.agrees = all.agrees && !item.at_start;
    if (all.problem.empty()) {
      all.problem = text();
    } else {
      ++more;
    }
  };
  for (const Offer& offer : offers_) {
    if (offer.part >= all.inboxes.size() && offer.part < kMaxParts) {
      all.inboxes.resize(offer.part + 1);
    }
  }
  for (std::uint32_t i = 0; i < items_.size(); ++i) {
    const Item& item = items_[i];
    const schema::Variable& mine = item.landing->variable();
    if (!item.is_read) {
      continue;
    }
    const auto found = std::find_if(offers_.begin(), offers_.end(),
                                    [hash = mine.name_hash()](const Offer& offer) { return offer.name_hash == hash; });
    if (found == offers_.end()) {
      complain(item,
               [&] { return fmt::format("board {} does not send {}: it runs another deployment", board_, mine.name); });
      continue;
    }
    if (found->type_hash != mine.type_hash || found->size != item.landing->entry().value_size) {
      complain(item, [&] {
        return fmt::format("{} differs between the boards: {} (here / on {}); build both from the same .glb", mine.name,
                           difference(mine, schema), board_);
      });
      continue;
    }
    if (found->part >= kMaxParts || found->offset > std::numeric_limits<std::uint32_t>::max() - found->size ||
        found->stream >= kStreams) {
      complain(item, [&] { return fmt::format("the catalogue of board {} is damaged", board_); });
      continue;
    }
    Inbox& inbox = all.inboxes[found->part];
    inbox.stream = static_cast<Stream>(found->stream);
    inbox.size = std::max(inbox.size, found->offset + found->size);
    inbox.content.push_back({i, found->offset});
  }
  if (more > 0) {
    all.problem += fmt::format(" (and {} more)", more);
  }
  if (!all.agrees) {
    all.inboxes.clear();
  }
  return all;
}

void Receiver::announced(const indurop_wire_Catalogue& catalogue, Plane& plane) {
  if (std::exchange(other_release_, false)) {
    record_.problem.set({});
  }
  const bool goes_on = catalogue.session == session_ && catalogue.layout == layout_;
  if (goes_on && catalogue.entries._length == offers_.size()) {
    record_.state.store(matched_ ? PeerState::Alive : PeerState::Mismatched, std::memory_order_release);
    return;
  }
  if (!goes_on) {
    close();
  }
  offers_.clear();
  for (std::uint32_t i = 0; i < catalogue.entries._length; ++i) {
    const indurop_wire_CatalogueEntry& entry = catalogue.entries._buffer[i];
    offers_.push_back({abi::fnv1a64(entry.name, std::strlen(entry.name)), entry.type_hash, entry.part, entry.offset,
                       entry.size, entry.stream});
  }
  {
    const std::lock_guard<std::mutex> guard(mutex_);
    if (!goes_on) {
      session_ = catalogue.session;
      layout_ = catalogue.layout;
      inboxes_.clear();
      staging_.reset({});
      for (Port& port : ports_) {
        port.newest_update = 0;
      }
    }
    read_again(catalogue.schema);
  }
  record_.session.store(session_, std::memory_order_relaxed);
  record_.state.store(matched_ ? PeerState::Alive : PeerState::Mismatched, std::memory_order_release);
  subscribe(plane);
}

void Receiver::follow(const std::vector<Landing*>& landings, std::int64_t patience_ns, Plane* plane) {
  {
    const std::lock_guard<std::mutex> guard(mutex_);
    const std::int64_t now = board_ns(store_);
    for (Item& item : items_) {
      const bool wanted = std::find(landings.begin(), landings.end(), item.landing) != landings.end();
      if (item.is_read && !wanted) {
        item.landing->leave(item.source, now, record_);
      } else if (!item.is_read && wanted) {
        item.landing->enter(item.source, now + patience_ns);
      }
      item.is_read = wanted;
    }
    for (Landing* const landing : landings) {
      const auto known =
          std::find_if(items_.begin(), items_.end(), [landing](const Item& item) { return item.landing == landing; });
      if (known == items_.end()) {
        items_.push_back({landing, landing->add_source(now + patience_ns), true, false});
        lend_room(*landing);
      }
    }
    record_.wanted = static_cast<std::uint32_t>(landings.size());
    if (session_ != 0) {
      read_again(nullptr);
      for (PeerState state : {PeerState::Alive, PeerState::Mismatched}) {
        record_.state.compare_exchange_strong(state, matched_ ? PeerState::Alive : PeerState::Mismatched);
      }
    }
  }
  if (session_ != 0 && plane != nullptr) {
    subscribe(*plane);
  }
}

// What waits for the rest of its update is written as it is; parts that go on keep what is known of them.
void Receiver::read_again(const char* schema) {
  if (staging_.has_waiting()) {
    word_.begin();
    staging_.take([this](std::uint32_t part, std::span<const std::uint8_t> data) {
      deliver(inboxes_[part], data, &word_, board_ns(store_));
    });
    word_.end(false);
  }
  Match matched = match(schema);
  matched_ = matched.agrees;
  for (std::size_t i = 0; i < std::min(inboxes_.size(), matched.inboxes.size()); ++i) {
    matched.inboxes[i].update = inboxes_[i].update;
  }
  inboxes_ = std::move(matched.inboxes);
  std::vector<std::uint32_t> sizes;
  for (const Inbox& inbox : inboxes_) {
    sizes.push_back(inbox.size);
  }
  staging_.resize(sizes);
  record_.problem.set(matched.problem);
}

// Reads the streams that have what this board reads: each costs a reader that all boards discover.
void Receiver::subscribe(Plane& plane) {
  for (const Inbox& inbox : inboxes_) {
    Port& port = ports_[static_cast<std::size_t>(inbox.stream)];
    if (inbox.content.empty() || port.subscription != nullptr) {
      continue;
    }
    auto subscription = plane.subscribe(board_, inbox.stream, *this);
    if (subscription) {
      port.subscription = std::move(subscription).value();
    } else {
      record_.problem.set(subscription.error().text);
    }
  }
}

void Receiver::close() noexcept {
  for (Port& port : ports_) {
    port.subscription.reset();  // waits for a listener that is running
  }
}

void Receiver::frame_came(const indurop_wire_Frame& frame, Stream stream) noexcept {
  const std::lock_guard<std::mutex> guard(mutex_);
  accept(frame, ports_[static_cast<std::size_t>(stream)]);
}

void Receiver::accept(const indurop_wire_Frame& frame, Port& port) noexcept {
  using rt::kRelaxed;
  if (frame.session != session_ || frame.layout != static_cast<std::uint32_t>(layout_) ||
      frame.part >= inboxes_.size() || frame.data._length < inboxes_[frame.part].size) {
    record_.refused.fetch_add(1, kRelaxed);
    return;
  }
  if (frame.update > port.newest_update) {
    if (port.newest_update != 0) {
      record_.lost_updates.fetch_add(frame.update - port.newest_update - 1, kRelaxed);
    }
    port.newest_update = frame.update;
  }
  const std::int64_t now = board_ns(store_);
  if (frame.update_sum != 0) {
    apply_together(frame, now);
  } else {
    apply_alone(frame, now);
  }
  if (inboxes_[frame.part].content.empty()) {
    return;  // has nothing that this board reads
  }
  record_.heard_ns.store(now, kRelaxed);
  record_.delay_ns.store(board_wall_ns(store_) - frame.source_time_ns, kRelaxed);
  record_.tick.store(frame.tick, kRelaxed);
  record_.frames.fetch_add(1, kRelaxed);
}

void Receiver::apply_alone(const indurop_wire_Frame& frame, std::int64_t now_ns) noexcept {
  Inbox& inbox = inboxes_[frame.part];
  if (frame.update >= inbox.update) {  // else older than the present value
    inbox.update = frame.update;
    deliver(inbox, {frame.data._buffer, frame.data._length}, nullptr, now_ns);
  }
}

void Receiver::apply_together(const indurop_wire_Frame& frame, std::int64_t now_ns) noexcept {
  const Staging::Verdict verdict =
      staging_.arrived(frame.part, frame.update, frame.update_sum, {frame.data._buffer, frame.data._length}, now_ns);
  if (verdict == Staging::Verdict::Old || verdict == Staging::Verdict::Wait) {
    return;
  }
  word_.begin();
  staging_.take(
      [&](std::uint32_t part, std::span<const std::uint8_t> data) { deliver(inboxes_[part], data, &word_, now_ns); });
  word_.end(verdict == Staging::Verdict::Whole);
}

void Receiver::deliver(const Inbox& inbox, std::span<const std::uint8_t> data, UpdateWord* word,
                       std::int64_t now_ns) noexcept {
  for (const Arrival& arrival : inbox.content) {
    const Item& item = items_[arrival.item];
    item.landing->deliver({item.source, session_, word, now_ns},
                          data.subspan(arrival.offset, item.landing->entry().value_size), record_);
  }
}

void Receiver::silent() noexcept {
  const std::lock_guard<std::mutex> guard(mutex_);
  if (record_.state.exchange(PeerState::Silent) == PeerState::Silent) {
    return;
  }
  record_.losses.fetch_add(1, std::memory_order_relaxed);
  const std::int64_t now = board_ns(store_);
  // Values that a standby takes over must not be read together with values that are still this board's.
  word_.begin();
  for (const Item& item : items_) {
    item.landing->silent(item.source, now, record_);
  }
  word_.end(word_.whole());
}

void Receiver::alive(std::uint64_t session) noexcept {
  const std::lock_guard<std::mutex> guard(mutex_);
  PeerState silent = PeerState::Silent;
  if (session == session_ && session_ != 0) {
    record_.state.compare_exchange_strong(silent, matched_ ? PeerState::Alive : PeerState::Mismatched);
  }
}

void Receiver::other_release(const std::string& problem) {
  const PeerState state = record_.state.load(std::memory_order_relaxed);
  const bool announced = state == PeerState::Alive || (state == PeerState::Mismatched && !other_release_);
  if (announced || other_release_ == !problem.empty()) {
    return;
  }
  other_release_ = !problem.empty();
  record_.problem.set(problem);
  record_.state.store(other_release_  ? PeerState::Mismatched
                      : session_ != 0 ? PeerState::Silent
                                      : PeerState::Absent,
                      std::memory_order_release);
}

}  // namespace indurop::mirror
