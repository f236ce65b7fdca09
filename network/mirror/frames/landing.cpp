// SPDX-License-Identifier: Apache-2.0
#include "network/mirror/frames/landing.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "network/mirror/frames/leading_board.h"

namespace indurop::mirror {

Landing::Landing(vars::Store& store, const vars::DirectoryEntry& entry, std::int64_t patient_until_ns)
    : store_(store),
      entry_(entry),
      variable_(store.schema().variables[entry.schema_index]),
      confirmed_(abi::confirmed_of(store.entry(entry.name_hash, 0), entry.kind)),
      update_offset_(abi::update_offset_of(store.entry(entry.name_hash, 0), entry.kind)),
      patient_until_ns_(patient_until_ns),
      present_(entry.value_size) {
  await(patient_until_ns);
}

void Landing::await(std::int64_t patient_until_ns) noexcept {
  patient_until_ns_ = patient_until_ns;
  word_ = nullptr;
  fallen_back_ = false;
  update_offset_.store(abi::kAlone, std::memory_order_release);
  confirmed_.store(abi::kNeverConfirmed, std::memory_order_release);
}

std::atomic<std::uint64_t>* Landing::lend_room_for_word() noexcept {
  return std::exchange(room_lent_, true) ? nullptr
                                         : &abi::update_word_of(store_.entry(entry_.name_hash, 0), entry_.kind);
}

void Landing::follow(UpdateWord* word) noexcept {
  if (word_ == word) {
    return;
  }
  word_ = word;
  const void* const entry = store_.entry(entry_.name_hash, 0);
  update_offset_.store(word == nullptr ? abi::kAlone : word->offset_from(entry), std::memory_order_release);
}

std::size_t Landing::add_source(std::int64_t patient_until_ns) {
  if (!sources_.empty() && !is_read()) {
    await(patient_until_ns);
  }
  sources_.emplace_back();
  if (sources_.size() > 1) {
    for (Source& source : sources_) {
      source.last.resize(entry_.value_size);
    }
  }
  return sources_.size() - 1;
}

bool Landing::is_read() const noexcept {
  return std::any_of(sources_.begin(), sources_.end(), [](const Source& source) { return source.is_read; });
}

void Landing::enter(std::size_t source, std::int64_t patient_until_ns) noexcept {
  if (!is_read()) {
    await(patient_until_ns);
  }
  sources_[source].is_read = true;
}

void Landing::leave(std::size_t source, std::int64_t now_ns, PeerRecord& record) noexcept {
  silent(source, now_ns, record);
  sources_[source].is_read = false;
  if (!is_read()) {
    word_ = nullptr;
    update_offset_.store(0, std::memory_order_release);
    confirmed_.store(0, std::memory_order_release);
  }
}

std::size_t Landing::leader() const noexcept {
  std::size_t best = kNone;
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    if (sources_[i].session != 0 && (best == kNone || leads(sources_[i].session, sources_[best].session))) {
      best = i;
    }
  }
  return best;
}

void Landing::deliver(const Arrival& arrival, std::span<const std::uint8_t> value, PeerRecord& record) noexcept {
  Source& from = sources_[arrival.source];
  from.session = arrival.session;
  from.word = arrival.word;
  if (!from.last.empty()) {
    std::copy(value.begin(), value.end(), from.last.begin());
  }
  if (leader() != arrival.source) {
    return;
  }
  put(value, record);
  follow(arrival.word);  // after the value: a reader that sees the new word also sees the new value
  fallen_back_ = false;
  confirmed_.store(arrival.now_ns, std::memory_order_release);
}

void Landing::silent(std::size_t source, std::int64_t now_ns, PeerRecord& record) noexcept {
  const bool led = leader() == source;
  sources_[source].session = 0;
  if (!led) {
    return;
  }
  if (const std::size_t next = leader(); next != kNone) {
    put(sources_[next].last, record);
    follow(sources_[next].word);
    confirmed_.store(now_ns, std::memory_order_release);
    return;
  }
  if (const std::int64_t last = confirmed_.load(std::memory_order_relaxed); last > 0) {
    confirmed_.store(-last, std::memory_order_release);
  }
}

void Landing::put(std::span<const std::uint8_t> value, PeerRecord& record) noexcept {
  if (store_.read(entry_, 0, present_) && std::equal(value.begin(), value.end(), present_.begin())) {
    return;
  }
  const bool written = store_.write(entry_, 0, value).ok();
  (written ? record.values : record.busy).fetch_add(1, std::memory_order_relaxed);
}

std::int64_t Landing::expire(std::int64_t now_ns) noexcept {
  constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();
  if (variable_.fallback.empty() || fallen_back_ || !is_read()) {
    return kNever;
  }
  const std::int64_t maxage = variable_.maxage_ns;
  const std::int64_t last = confirmed_.load(std::memory_order_relaxed);
  std::int64_t ends = kNever;  // without a maxage a value is valid as long as its board lives
  if (last == abi::kNeverConfirmed) {
    ends = patient_until_ns_;
  } else if (last < 0) {
    ends = maxage > 0 ? maxage - last : now_ns;
  } else if (maxage > 0) {
    ends = last + maxage;
  }
  if (now_ns < ends) {
    return ends;
  }
  // No board has sent this value, so it does not belong to the others of its update.
  if (word_ != nullptr) {
    word_->begin();
  }
  fallen_back_ = store_.write(entry_, 0, variable_.fallback).ok();
  if (word_ != nullptr) {
    word_->end(false);
  }
  return fallen_back_ ? kNever : now_ns;
}

}  // namespace indurop::mirror
