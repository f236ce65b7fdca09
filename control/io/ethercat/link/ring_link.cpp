// SPDX-License-Identifier: Apache-2.0
#include "control/io/ethercat/link/ring_link.h"

#include <algorithm>

namespace indurop::io::ethercat {

namespace {

constexpr std::size_t kFrames = 64;     // under way at most
constexpr std::size_t kSourceEnd = 11;  // last byte of the source address
constexpr std::uint8_t kLastEnd = 0x80;
constexpr std::size_t kIndexAt = kFrameHeader + 1;  // of the first datagram

bool is_by_position(Command command) noexcept {
  return command == Command::Aprd || command == Command::Apwr || command == Command::Aprw || command == Command::Armw;
}

bool is_broadcast(Command command) noexcept {
  return command == Command::Brd || command == Command::Bwr || command == Command::Brw;
}

std::size_t place_of(const Datagram& datagram) noexcept {
  return static_cast<std::uint16_t>(0U - (datagram.address & 0xFFFFU));
}

std::uint16_t counter(Bytes frame, const Datagram& datagram) noexcept {
  return load<std::uint16_t>(frame, datagram.wkc_at());
}

// How many slaves have passed the first broadcast that reads; nothing if there is none.
std::optional<std::size_t> slaves_of(Bytes frame) noexcept {
  FrameReader reader(frame);
  Datagram datagram;
  while (reader.next(datagram)) {
    if (datagram.command == Command::Brd) {
      return datagram.wkc;
    }
  }
  return std::nullopt;
}

}  // namespace

RingLink::RingLink(Link& first, Link& last) : first_(first), last_(last), sent_(kFrames) {}

// Positions count from the end at which a frame comes in. Whom it cannot reach from the last end it leaves alone: on a
// cable that is cut this very moment, the position would be that of another slave.
void RingLink::mark_for_last(std::span<std::uint8_t> frame) const noexcept {
  frame[kSourceEnd] ^= kLastEnd;
  FrameReader reader(frame);
  Datagram datagram;
  while (reader.next(datagram)) {
    if (!is_by_position(datagram.command)) {
      continue;
    }
    const std::size_t place = place_of(datagram);
    if (cut_ && place >= cut_->behind) {
      store<std::uint16_t>(frame, datagram.at + 2, position(place - cut_->behind));
    } else {
      frame[datagram.at] = static_cast<std::uint8_t>(Command::Nop);
    }
  }
}

bool RingLink::send(Bytes frame) noexcept {
  Sent& sent = sent_[next_++ % sent_.size()];
  sent.is_out = true;
  sent.is_whole = false;
  sent.first.size = 0;
  sent.last.size = 0;
  sent.frame.size = std::min(frame.size(), sent.frame.bytes.size());
  std::copy_n(frame.begin(), sent.frame.size, sent.frame.bytes.begin());
  std::array<std::uint8_t, kMaxFrame> copy = sent.frame.bytes;
  const auto marked = std::span(copy).first(sent.frame.size);
  mark_for_last(marked);
  const bool at_first = first_.send(frame);
  const bool at_last = last_.send(marked);
  sent.is_out = at_first || at_last;
  return sent.is_out;
}

void RingLink::take(Bytes frame, End from) noexcept {
  if (frame.size() <= kIndexAt || FrameReader(frame).fault() != FrameFault::None) {
    return;
  }
  const bool is_last = (frame[kSourceEnd] & kLastEnd) != 0;
  const auto found = std::find_if(sent_.begin(), sent_.end(), [&](const Sent& sent) {
    return sent.is_out && sent.frame.size == frame.size() && sent.frame.bytes[kIndexAt] == frame[kIndexAt];
  });
  if (found == sent_.end()) {
    return;
  }
  if (is_last && from == End::First) {
    return;  // the cable is whole, and no slave has worked on this copy
  }
  Copy& copy = is_last ? found->last : found->first;
  copy.size = frame.size();
  std::copy_n(frame.begin(), copy.size, copy.bytes.begin());
  copy.bytes[kSourceEnd] &= static_cast<std::uint8_t>(~kLastEnd);
  found->is_whole |= !is_last && from == End::Last;
}

// Where the cable is cut, by copies that came back at the end where they left.
void RingLink::learn(const Sent& sent) noexcept {
  const auto before = sent.first.size > 0 ? slaves_of(sent.first.frame()) : std::nullopt;
  const auto behind = sent.last.size > 0 ? slaves_of(sent.last.frame()) : std::nullopt;
  if (sent.is_whole) {
    cut_.reset();
    slaves_ = before.value_or(slaves_);
  } else if (before || behind) {
    const std::size_t at_first = before.value_or(0);
    const std::size_t at_last = behind.value_or(0);
    slaves_ = std::max(slaves_, at_first + at_last);
    cut_ = Cut{at_first, slaves_ - at_last};
  }
}

void RingLink::merge_datagram(const Datagram& asked, const Sent& sent, std::span<std::uint8_t> to) const noexcept {
  const Bytes first = sent.first.frame();
  const Bytes last = sent.last.frame();
  const auto first_wkc = first.empty() ? std::uint16_t{0} : counter(first, asked);
  const auto last_wkc = last.empty() ? std::uint16_t{0} : counter(last, asked);
  bool takes_last = first_wkc == 0 && last_wkc > 0;
  if (is_by_position(asked.command)) {
    takes_last = cut_ && place_of(asked) >= cut_->behind;
  }
  const Bytes from = takes_last ? last : first;
  if (!from.empty()) {
    std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(asked.data_at()), asked.length,
                to.begin() + static_cast<std::ptrdiff_t>(asked.data_at()));
  }
  unsigned wkc = takes_last ? last_wkc : first_wkc;
  if (!is_by_position(asked.command)) {
    wkc = static_cast<unsigned>(first_wkc) + last_wkc;
  }
  if (is_broadcast(asked.command) && !takes_last && !last.empty() && last_wkc > 0) {
    for (std::size_t i = asked.data_at(); i < asked.wkc_at(); ++i) {
      to[i] |= last[i];
    }
  }
  store<std::uint16_t>(to, asked.wkc_at(), static_cast<std::uint16_t>(wkc));
}

std::size_t RingLink::merge(Sent& sent, std::span<std::uint8_t> to) const noexcept {
  const std::size_t size = std::min(sent.frame.size, to.size());
  const Copy& whole = sent.is_whole ? sent.first : sent.frame;
  std::copy_n(whole.bytes.begin(), size, to.begin());
  if (!sent.is_whole) {
    FrameReader reader(sent.frame.frame());
    Datagram asked;
    while (reader.next(asked)) {
      merge_datagram(asked, sent, to);
    }
  }
  sent.is_out = false;
  return size;
}

std::size_t RingLink::receive(std::span<std::uint8_t> to) noexcept {
  std::array<std::uint8_t, kMaxFrame> buffer{};
  for (const End end : {End::First, End::Last}) {
    Link& link = end == End::First ? first_ : last_;
    while (const std::size_t size = link.receive(buffer)) {
      take(Bytes(buffer).first(std::min(size, buffer.size())), end);
    }
  }
  // In the order in which they were sent.
  for (std::size_t i = 0; i < sent_.size(); ++i) {
    Sent& sent = sent_[(next_ + i) % sent_.size()];
    if (sent.is_out && (sent.first.size > 0 || sent.last.size > 0)) {
      learn(sent);
      return merge(sent, to);
    }
  }
  return 0;
}

}  // namespace indurop::io::ethercat
