// SPDX-License-Identifier: Apache-2.0
#include "control/io/ethercat/master/master.h"

#include <algorithm>
#include <set>
#include <utility>

namespace indurop::io::ethercat {

namespace {

constexpr std::size_t kSourceAt = 6;
constexpr unsigned kMaxReceived = 64;      // frames in one cycle
constexpr unsigned kServicePatience = 3;   // cycles
constexpr std::size_t kStatusWord = 2;     // of the broadcast that counts the slaves
constexpr std::size_t kClockBytes = 8;     // of a system time
constexpr std::uint16_t kClocks = 0xFFFF;  // as the place of a datagram: it is of no slave

std::size_t process_size(const SlavePlan& plan) noexcept {
  return plan.output_bytes + plan.input_bytes;
}

// Of its datagrams in a frame, without that data.
std::size_t process_overhead(const SlavePlan& plan) noexcept {
  const bool is_pair = !plan.uses_lrw && plan.output_bytes > 0 && plan.input_bytes > 0;
  return is_pair ? 2 * kDatagramOverhead : kDatagramOverhead;
}

bool want_clocks(const std::vector<SlavePlan>& plans) noexcept {
  return std::any_of(plans.begin(), plans.end(), [](const SlavePlan& plan) { return plan.sync.activation != 0; });
}

// The same datagrams, but for what slaves change.
bool are_same(Bytes sent, Bytes received) noexcept {
  FrameReader ours(sent);
  FrameReader theirs(received);
  Datagram a;
  Datagram b;
  while (ours.next(a)) {
    if (!theirs.next(b) || a.command != b.command || a.index != b.index || a.length != b.length ||
        (is_logical(a.command) ? a.address != b.address : a.address >> 16U != b.address >> 16U)) {
      return false;
    }
  }
  return !theirs.next(b);
}

}  // namespace

Master::Master(Link& link, std::vector<SlavePlan> plans, Clock period)
    : link_(link), plans_(std::move(plans)), clocks_(want_clocks(plans_) ? plans_.size() : 0, period) {
  for (std::size_t i = 0; i < plans_.size(); ++i) {
    slaves_.emplace_back(plans_[i], i, events_, clocks_);
    data_.push_back({plans_[i].safe_outputs, std::vector<std::uint8_t>(plans_[i].input_bytes), false, false});
  }
  plan_frames();
  service_.items.reserve(plans_.size() + 1);
}

void Master::plan_frames() {
  std::set<unsigned> rates = {1};  // the first frame is sent in each cycle: it counts the slaves and has the clock
  for (const SlavePlan& plan : plans_) {
    rates.insert(plan.every);
  }
  for (const unsigned every : rates) {
    plan_frames(every);
  }
}

// Frames of one rate take turns, so that cycles are filled evenly.
void Master::plan_frames(unsigned every) {
  std::size_t room = 0;
  unsigned frames = 0;
  const auto begin_frame = [&] {
    Frame& frame = process_.emplace_back();
    frame.every = every;
    frame.phase = frames++ % every;
    room = kMaxFrame - kFrameHeader - kDatagramOverhead - kStatusWord - kDatagramOverhead - kClockBytes;
  };
  if (process_.empty()) {
    begin_frame();
  }
  for (std::size_t i = 0; i < plans_.size(); ++i) {
    const std::size_t size = process_size(plans_[i]);
    if (plans_[i].every != every || size == 0) {
      continue;
    }
    const std::size_t needed = size + process_overhead(plans_[i]);
    if (needed > room) {
      begin_frame();
    }
    const auto place = static_cast<std::uint16_t>(i);
    if (plans_[i].uses_lrw) {
      process_.back().items.push_back({place, 0, size});
    } else {
      process_.back().pairs.push_back({place, 0, 0});
    }
    room -= needed;
  }
}

void Master::send(Clock now) noexcept {
  send_process(now);
  if (!service_.is_out) {
    send_service(now);
  }
}

void Master::receive(Clock now) noexcept {
  for (Frame& frame : process_) {
    if (std::exchange(frame.was_sent, false)) {
      for (const Item& item : frame.items) {
        data_[item.place].fresh = false;
      }
      for (const Pair& pair : frame.pairs) {
        data_[pair.place].fresh = false;
      }
    }
  }
  take_frames(now);
  if (const auto lost = clocks_.take_lost()) {
    events_.push({now, static_cast<std::uint16_t>(lost->place), Problem::ClockNotInStep,
                  static_cast<std::uint32_t>(lost->ahead_ns)});
  }
  if (clock_at_ != 0 && !process_.empty() && process_.front().is_out) {
    clocks_.not_passed();
  }
  expire(now);
}

void Master::take_frames(Clock now) noexcept {
  std::array<std::uint8_t, kMaxFrame + 8> buffer{};
  for (unsigned i = 0; i < kMaxReceived; ++i) {
    const std::size_t size = link_.receive(buffer);
    if (size == 0) {
      return;
    }
    take_frame(Bytes(buffer).first(std::min(size, buffer.size())), now);
  }
}

Master::Frame* Master::frame_of(std::uint8_t index) noexcept {
  if (service_.is_out && service_.index == index) {
    return &service_;
  }
  const auto found = std::find_if(process_.begin(), process_.end(),
                                  [index](const Frame& frame) { return frame.is_out && frame.index == index; });
  return found == process_.end() ? nullptr : &*found;
}

void Master::take_frame(Bytes bytes, Clock now) noexcept {
  FrameReader reader(bytes);
  Datagram first;
  if (!reader.next(first)) {
    ++counters_.foreign;
    return;
  }
  const bool is_ours = std::equal(kMasterMac.begin(), kMasterMac.end(), bytes.begin() + kSourceAt);
  if (!is_ours || slots_[first.index] == Slot::Free) {
    ++counters_.foreign;
    return;
  }
  auto& slot = slots_[first.index];
  if (slot != Slot::Out) {
    ++(slot == Slot::Lost ? counters_.late : counters_.duplicates);
    slot = Slot::Back;
    return;
  }
  Frame* const frame = frame_of(first.index);
  if (frame == nullptr || !are_same(frame->builder.finish(), bytes)) {
    ++counters_.foreign;
    return;
  }
  slot = Slot::Back;
  frame->is_out = false;
  if (frame == &service_) {
    take_service(*frame, bytes, now);
  } else {
    take_process(*frame, bytes, now);
  }
}

void Master::take_process(const Frame& frame, Bytes bytes, Clock now) noexcept {
  slaves_seen_ = load<std::uint16_t>(bytes, kFrameHeader + kDatagramHeader + kStatusWord);
  clocks_.count(slaves_seen_, now);
  if (&frame == &process_.front() && clock_at_ != 0) {
    take_clock(bytes, now);
  }
  for (const Item& item : frame.items) {
    const auto wkc = load<std::uint16_t>(bytes, item.data_at + item.size);
    take_inputs(item.place, wkc, bytes.subspan(item.data_at + data_[item.place].outputs.size()), now);
  }
  for (const Pair& pair : frame.pairs) {
    take_pair(pair, bytes, now);
  }
}

// Counts as a LRW does, in which a write counts twice: what a slave should add does not depend on the command then.
void Master::take_pair(const Pair& pair, Bytes bytes, Clock now) noexcept {
  const Data& data = data_[pair.place];
  unsigned wkc = 0;
  if (pair.write_at != 0) {
    wkc += 2U * load<std::uint16_t>(bytes, pair.write_at + data.outputs.size());
  }
  if (pair.read_at != 0) {
    wkc += load<std::uint16_t>(bytes, pair.read_at + data.inputs.size());
  }
  take_inputs(pair.place, static_cast<std::uint16_t>(wkc), bytes.subspan(pair.read_at), now);
}

void Master::take_inputs(std::size_t place, std::uint16_t wkc, Bytes bytes, Clock now) noexcept {
  SlaveControl& slave = slaves_[place];
  Data& data = data_[place];
  slave.check_counter(wkc, now);
  data.fresh = slave.operates() && wkc == slave.expected_counter();
  if (data.fresh) {
    std::copy_n(bytes.begin(), data.inputs.size(), data.inputs.begin());
  }
}

void Master::take_service(const Frame& frame, Bytes bytes, Clock now) noexcept {
  for (const Item& item : frame.items) {
    const bool is_answered = load<std::uint16_t>(bytes, item.data_at + item.size) > 0;
    if (item.place == kClocks) {
      clocks_.answer(bytes.subspan(item.data_at, item.size), is_answered, now);
      continue;
    }
    slaves_[item.place].answer(bytes.subspan(item.data_at, item.size), is_answered, now);
  }
}

void Master::expire(Clock now) noexcept {
  for (Frame& frame : process_) {
    if (frame.is_out) {
      frame.is_out = false;
      slots_[frame.index] = Slot::Lost;
      ++counters_.lost;
    }
  }
  if (service_.is_out && ++service_.age >= kServicePatience) {
    service_.is_out = false;
    slots_[service_.index] = Slot::Lost;
    ++counters_.lost;
    lose_service(now);
  }
}

void Master::lose_service(Clock now) noexcept {
  for (const Item& item : service_.items) {
    if (item.place == kClocks) {
      clocks_.lost(now);
    } else {
      slaves_[item.place].lost(now);
    }
  }
}

void Master::send_frame(Frame& frame) noexcept {
  if (!link_.send(frame.builder.finish())) {
    ++counters_.not_sent;
    slots_[frame.index] = Slot::Free;
    return;
  }
  ++counters_.sent;
  slots_[frame.index] = Slot::Out;
  frame.is_out = true;
  frame.age = 0;
}

// The reference writes its time into this datagram, and those behind it read it.
void Master::add_clock(Frame& frame, Clock now) noexcept {
  clock_at_ = 0;
  const auto reference = clocks_.reference();
  if (!reference) {
    return;
  }
  std::array<std::uint8_t, kClockBytes> time{};
  store<std::int64_t>(time, 0, clocks_.reference_time(now));
  clock_sent_at_ = now;
  clock_at_ = frame.builder.add(Command::Armw, frame.index, address_of(position(*reference), reg::kSystemTime), time)
                  .value_or(0);
}

void Master::take_clock(Bytes bytes, Clock now) noexcept {
  // No slave before the reference has a clock, so without it none counts.
  if (load<std::uint16_t>(bytes, clock_at_ + kClockBytes) > 0) {
    clocks_.passed(load<std::int64_t>(bytes, clock_at_), clock_sent_at_, now);
  } else {
    clocks_.not_passed();
  }
}

Bytes Master::outputs_now(std::size_t place) const noexcept {
  const bool live = data_[place].outputs_good && slaves_[place].operates();
  return live ? data_[place].outputs : plans_[place].safe_outputs;
}

void Master::add_pair(Frame& frame, Pair& pair) noexcept {
  const SlavePlan& plan = plans_[pair.place];
  if (plan.output_bytes > 0) {
    pair.write_at = frame.builder.add(Command::Lwr, frame.index, plan.logical, outputs_now(pair.place)).value_or(0);
  }
  if (plan.input_bytes > 0) {
    const auto inputs_at = static_cast<std::uint32_t>(plan.logical + plan.output_bytes);
    pair.read_at = frame.builder.add(Command::Lrd, frame.index, inputs_at, plan.input_bytes).value_or(0);
  }
}

void Master::send_process(Clock now) noexcept {
  const std::uint64_t cycle = cycles_++;
  for (Frame& frame : process_) {
    if (cycle % frame.every != frame.phase) {
      continue;
    }
    frame.was_sent = true;
    frame.index = next_index_++;
    frame.builder.clear();
    frame.builder.add(Command::Brd, frame.index, address_of(0, reg::kAlStatus), kStatusWord);
    if (&frame == &process_.front()) {
      add_clock(frame, now);
    }
    for (Item& item : frame.items) {
      const auto at = frame.builder.add(Command::Lrw, frame.index, plans_[item.place].logical, item.size);
      item.data_at = at.value_or(0);
      if (at) {
        frame.builder.fill(*at, outputs_now(item.place));
      }
    }
    for (Pair& pair : frame.pairs) {
      add_pair(frame, pair);
    }
    send_frame(frame);
  }
}

void Master::add_clock_query(Clock now) noexcept {
  const auto query = clocks_.query(now);
  if (!query) {
    return;
  }
  const std::size_t size = query->data.empty() ? query->length : query->data.size();
  if (const auto at = add(service_, *query)) {
    service_.items.push_back({kClocks, *at, size});
  }
}

std::optional<std::size_t> Master::add(Frame& frame, const Query& query) noexcept {
  return query.data.empty() ? frame.builder.add(query.command, frame.index, query.address, query.length)
                            : frame.builder.add(query.command, frame.index, query.address, query.data);
}

void Master::send_service(Clock now) noexcept {
  service_.builder.clear();
  service_.items.clear();
  service_.index = next_index_;
  for (std::size_t i = 0; i < slaves_.size(); ++i) {
    const std::size_t place = (next_service_ + i) % slaves_.size();
    const auto query = slaves_[place].query(now);
    if (!query) {
      continue;
    }
    const std::size_t size = query->data.empty() ? query->length : query->data.size();
    const auto at = add(service_, *query);
    if (!at) {
      next_service_ = place;  // it is first in the next frame
      break;
    }
    service_.items.push_back({static_cast<std::uint16_t>(place), *at, size});
  }
  add_clock_query(now);
  if (!service_.items.empty()) {
    ++next_index_;
    send_frame(service_);
    if (!service_.is_out) {
      lose_service(now);
    }
  }
}

}  // namespace indurop::io::ethercat
