// SPDX-License-Identifier: Apache-2.0
#include "doors/pools/assembler.h"

#include <algorithm>
#include <cstring>

namespace indurop::pool_door {

Assembler::Sender& Assembler::sender_of(std::uint64_t session, Time now) {
  const auto known = std::ranges::find(senders_, session, &Sender::session);
  if (known != senders_.end()) {
    known->heard = now;
    return *known;
  }
  if (senders_.size() == kMostSenders) {
    const auto silent = std::ranges::min_element(senders_, {}, &Sender::heard);
    give_up(*silent);
    senders_.erase(silent);
  }
  Sender& added = senders_.emplace_back();
  added.session = session;
  added.heard = now;
  return added;
}

void Assembler::begin(Sender& sender, std::uint64_t number) {
  give_up(sender);
  sender.number = number;
  if (const auto place = places_->take()) {
    sender.state = State::Filling;
    sender.place = *place;
    sender.missing = parts_of(chunk_bytes_);
    sender.has.assign(sender.missing, false);
  } else {
    ++counts_.no_place;
  }
}

void Assembler::give_up(Sender& sender) {
  if (sender.state == State::Filling) {
    places_->discard(sender.place);
    ++counts_.incomplete;
  }
  sender.state = State::GivenUp;
}

void Assembler::add(const Part& part, Time now) {
  if (!is_part_of(part, chunk_bytes_)) {
    ++counts_.malformed;
    return;
  }
  Sender& sender = sender_of(part.session, now);
  if (part.number < sender.number) {
    ++counts_.late;
    return;
  }
  if (part.number > sender.number) {
    begin(sender, part.number);
  }
  const std::uint64_t index = part.offset / kPartBytes;
  if (sender.state != State::Filling || sender.has[index]) {
    counts_.repeated += sender.state == State::GivenUp ? 0 : 1;
    return;
  }
  std::memcpy(sender.place.data + part.offset, part.data.data(), part.data.size());
  sender.has[index] = true;
  if (--sender.missing == 0) {
    places_->publish(sender.place, part.published_ns);
    sender.state = State::Published;
    ++counts_.complete;
  }
}

void Assembler::give_up_silent(Time now) {
  for (Sender& sender : senders_) {
    if (sender.state == State::Filling && now - sender.heard >= kPatience) {
      give_up(sender);
    }
  }
}

void Assembler::give_up_all() {
  for (Sender& sender : senders_) {
    give_up(sender);
  }
  senders_.clear();
}

}  // namespace indurop::pool_door
