// SPDX-License-Identifier: Apache-2.0
#include "control/io/ethercat/simulator/slave.h"

#include <algorithm>
#include <array>
#include <utility>

#include "control/io/ethercat/simulator/pdo_rules.h"

namespace indurop::io::ethercat {

namespace {

constexpr std::size_t manager_at(unsigned number) {
  return reg::kSyncManager + std::size_t{number} * kSyncManagerBytes;
}

}  // namespace

Slave::Slave(SlaveConfig config, Application application)
    : dl_status_(config.esc.dl_status),
      esc_(std::move(config.esc)),
      objects_(std::move(config.objects)),
      application_(std::move(application)),
      state_time_(config.state_time),
      mailbox_time_(config.mailbox_time) {
  if (auto sii = read_sii(esc_.eeprom())) {
    sii_ = std::move(sii).value();
    const std::uint8_t out = first_manager(sii_, SyncManagerUse::Outputs);
    const std::uint8_t in = first_manager(sii_, SyncManagerUse::Inputs);
    output_manager_ = out == kNotAssigned ? output_manager_ : out;
    input_manager_ = in == kNotAssigned ? input_manager_ : in;
    add_pdo_objects(sii_, objects_);
    objects_.set_rule(
        [this](const ObjectDictionary& objects, std::uint16_t index, std::uint8_t subindex, std::uint64_t number) {
          return judge_mapping(sii_, objects, state(), {index, subindex, number});
        });
  }
}

AlState Slave::state() const noexcept {
  return static_cast<AlState>(esc_.at(reg::kAlStatus) & kAlStateMask);
}

void Slave::set_power(bool on) {
  if (on && !on_) {
    esc_.reset();
    sdo_.reset();
    add_pdo_objects(sii_, objects_);
    answers_.clear();
    last_answer_.clear();
    state_due_.reset();
    last_counter_ = 0;
    own_counter_ = 0;
    outputs_off_ = false;
  }
  on_ = on;
}

void Slave::set_ports(const std::array<bool, kPorts>& open) noexcept {
  unsigned status = dl_status_;
  for (unsigned port = 0; port < kPorts; ++port) {
    // Link and communication, or a closed loop.
    status |= open[port] ? 0x0010U << port | 0x0200U << (2 * port) : 0x0100U << (2 * port);
  }
  esc_.set<std::uint16_t>(reg::kDlStatus, static_cast<std::uint16_t>(status));
}

// --- frames ---

void Slave::process(std::span<std::uint8_t> frame, Time now, const Returns& returns) {
  advance_device(now);
  FrameReader reader(frame);
  Datagram datagram;
  while (reader.next(datagram)) {
    run_datagram(datagram, frame, now, returns);
    react(now);
  }
  // A slave without outputs measures for each frame.
  is_due_ |= state() >= AlState::SafeOp && area_of(output_manager_).length == 0;
}

bool Slave::is_station(std::uint16_t address) const noexcept {
  const bool alias = (esc_.at(reg::kDlControl + 3U) & 1U) != 0;
  return address == esc_.value<std::uint16_t>(reg::kStation) ||
         (alias && address == esc_.value<std::uint16_t>(reg::kAlias));
}

void Slave::run_datagram(const Datagram& datagram, std::span<std::uint8_t> frame, Time now, const Returns& returns) {
  const auto address = static_cast<std::uint16_t>(datagram.address);
  const auto offset = static_cast<std::uint16_t>(datagram.address >> 16U);
  bool by_position = false;
  bool is_mine = true;
  bool reads = false;
  bool writes = false;
  switch (datagram.command) {
    case Command::Nop:
      return;
    case Command::Lrd:
    case Command::Lwr:
    case Command::Lrw:
      access_logical(datagram, frame, now);
      return;
    case Command::Aprd:
    case Command::Apwr:
    case Command::Aprw:
      by_position = true;
      is_mine = address == 0;
      break;
    case Command::Fprd:
    case Command::Fpwr:
    case Command::Fprw:
      is_mine = is_station(address);
      break;
    case Command::Brd:
    case Command::Bwr:
    case Command::Brw:
      by_position = true;
      break;
    case Command::Armw:
    case Command::Frmw:
      by_position = datagram.command == Command::Armw;
      reads = by_position ? address == 0 : is_station(address);
      writes = !reads;
      break;
  }
  if (datagram.command <= Command::Brw) {
    const unsigned kind = (static_cast<unsigned>(datagram.command) - 1) % 3;  // read, write, both
    reads = kind != 1;
    writes = kind != 0;
  }
  if (by_position) {
    store<std::uint16_t>(frame, datagram.at + 2, static_cast<std::uint16_t>(address + 1));
  }
  if (is_mine) {
    if (writes && offset == reg::kReceiveTimes) {
      esc_.latch_receive_times(now, returns);
    }
    access(datagram, frame, reads, writes, now);
  }
}

void Slave::access(const Datagram& datagram, std::span<std::uint8_t> frame, bool reads, bool writes, Time now) {
  const auto offset = static_cast<std::uint16_t>(datagram.address >> 16U);
  const auto data = frame.subspan(datagram.data_at(), datagram.length);
  std::array<std::uint8_t, kMaxFrame> found{};
  const auto read = std::span(found).first(datagram.length);
  const bool has_read = reads && esc_.read(offset, read, now);
  const bool has_written = writes && esc_.write(offset, data, now);
  if (has_read) {
    const bool broadcast = datagram.command == Command::Brd || datagram.command == Command::Brw;
    for (std::size_t i = 0; i < data.size(); ++i) {
      data[i] = static_cast<std::uint8_t>(broadcast ? data[i] | read[i] : read[i]);
    }
  }
  const unsigned write_counts = reads ? 2 : 1;
  store<std::uint16_t>(frame, datagram.wkc_at(),
                       static_cast<std::uint16_t>(load<std::uint16_t>(frame, datagram.wkc_at()) + (has_read ? 1U : 0U) +
                                                  (has_written ? write_counts : 0U)));
}

void Slave::access_logical(const Datagram& datagram, std::span<std::uint8_t> frame, Time now) {
  if (datagram.command == Command::Lrw && (esc_.value<std::uint16_t>(reg::kFeatures) & kNoLrw) != 0) {
    return;  // it passes, as through a cable
  }
  const auto data = frame.subspan(datagram.data_at(), datagram.length);
  unsigned count = 0;
  std::array<std::uint8_t, kMaxFrame> copy{};
  std::copy(data.begin(), data.end(), copy.begin());
  if (datagram.command != Command::Lwr && esc_.read_logical(datagram.address, data, now)) {
    count += 1;
  }
  if (datagram.command != Command::Lrd && esc_.write_logical(datagram.address, Bytes(copy).first(data.size()))) {
    count += datagram.command == Command::Lrw ? 2 : 1;
  }
  store<std::uint16_t>(frame, datagram.wkc_at(),
                       static_cast<std::uint16_t>(load<std::uint16_t>(frame, datagram.wkc_at()) + count));
}

// --- the device ---

void Slave::react(Time now) {
  const EscEvents events = esc_.take_events();
  if (events.al_control && esc_.emulates_device()) {
    emulate_state();
    outputs_at_ = now;
  } else if (events.al_control) {
    state_due_ = now + (now < slow_until_ ? slow_time_ : state_time_);
  }
  if (events.mailbox) {
    receive_mailbox(now);
  }
  if (events.repeat && !last_answer_.empty()) {
    answers_.push_front({now + mailbox_time_, last_answer_});
    esc_.set_mailbox_full(kMailboxIn, false);
  }
  if (events.outputs) {
    outputs_at_ = now;
    outputs_off_ = false;
    is_due_ = true;
  }
}

void Slave::advance_device(Time now) {
  if (state_due_ && *state_due_ <= now) {
    state_due_.reset();
    change_state(esc_.at(reg::kAlControl));
    outputs_at_ = now;
  }
  const auto watchdog = Time(esc_.value<std::uint16_t>(reg::kWatchdogProcessData) * std::int64_t{40} *
                             (esc_.value<std::uint16_t>(reg::kWatchdogDivider) + 2));
  if (state() == AlState::Op && process_bytes(SyncManagerUse::Outputs) > 0 && now - outputs_at_ > watchdog &&
      (esc_.at(manager_at(output_manager_) + 4) & 0x40U) != 0) {
    is_due_ |= !outputs_off_;
    outputs_off_ = true;
    if (!esc_.emulates_device()) {
      fall_to(AlState::SafeOp, kAlSyncWatchdog);
    }
  }
  deliver_mailbox(now);
}

void Slave::fall_to(AlState state, std::uint16_t code) noexcept {
  esc_.set<std::uint16_t>(reg::kAlStatus, static_cast<std::uint16_t>(static_cast<unsigned>(state) | kAlError));
  esc_.set<std::uint16_t>(reg::kAlStatusCode, code);
}

void Slave::refuse_state(AlState state, std::uint16_t code, unsigned times) {
  refusal_ = {state, code, times};
}

void Slave::slow_down(Time state_time, Time until) noexcept {
  slow_time_ = state_time;
  slow_until_ = until;
}

void Slave::change_state(std::uint8_t request) {
  const AlState from = state();
  const auto to = static_cast<AlState>(request & kAlStateMask);
  const bool has_error = (esc_.at(reg::kAlStatus) & kAlError) != 0;
  if (has_error && (request & kAlError) == 0 && to != AlState::Init) {
    return;  // the master has not acknowledged
  }
  std::uint16_t code = check_change(from, to);
  if (code == kAlNoError) {
    code = take_refusal(to);
  }
  if (code != kAlNoError) {
    fall_to(from, code);
    return;
  }
  esc_.set<std::uint16_t>(reg::kAlStatus, static_cast<std::uint16_t>(to));
  esc_.set<std::uint16_t>(reg::kAlStatusCode, kAlNoError);
  if (to == AlState::Init) {
    answers_.clear();
    sdo_.reset();
    foe_.reset();
    last_counter_ = 0;
  }
  is_due_ = true;
}

std::uint16_t Slave::take_refusal(AlState to) noexcept {
  if (refusal_.times == 0 || refusal_.state != to || state() == to) {
    return kAlNoError;
  }
  --refusal_.times;
  return refusal_.code;
}

// The chip copies the request, with the bit that acknowledges errors, and checks nothing.
void Slave::emulate_state() noexcept {
  const auto request = static_cast<std::uint8_t>(esc_.at(reg::kAlControl) & (kAlStateMask | kAlError));
  if (const std::uint16_t code = take_refusal(static_cast<AlState>(request & kAlStateMask))) {
    fall_to(state(), code);
    return;
  }
  esc_.set<std::uint16_t>(reg::kAlStatus, request);
  esc_.set<std::uint16_t>(reg::kAlStatusCode, kAlNoError);
  is_due_ = true;
}

std::uint16_t Slave::check_change(AlState from, AlState to) const {
  if (to == AlState::Boot || from == AlState::Boot) {
    return check_boot(from, to);
  }
  if (to != AlState::Init && to != AlState::PreOp && to != AlState::SafeOp && to != AlState::Op) {
    return kAlUnknownState;
  }
  if (to <= from) {
    return kAlNoError;
  }
  if (from == AlState::Init) {
    if (to != AlState::PreOp) {
      return kAlInvalidChange;
    }
    return mailbox_fits(sii_.mailbox) ? kAlNoError : kAlInvalidMailbox;
  }
  if (from == AlState::PreOp) {
    if (to != AlState::SafeOp) {
      return kAlInvalidChange;
    }
    if (!process_data_fits(SyncManagerUse::Outputs, output_manager_)) {
      return kAlInvalidOutputs;
    }
    return process_data_fits(SyncManagerUse::Inputs, input_manager_) ? kAlNoError : kAlInvalidInputs;
  }
  return esc_.wants_pulses() && !esc_.has_pulses() ? kAlNoSync : kAlNoError;
}

Slave::Area Slave::area_of(unsigned sync_manager) const noexcept {
  const std::size_t at = manager_at(sync_manager);
  if ((esc_.at(at + 6) & 1U) == 0) {
    return {};
  }
  return {esc_.value<std::uint16_t>(at), esc_.value<std::uint16_t>(at + 2)};
}

bool Slave::mailbox_fits(const MailboxArea& area) const {
  if (area.receive_size == 0) {
    return true;
  }
  const Area out = area_of(kMailboxOut);
  const Area in = area_of(kMailboxIn);
  return out.start == area.receive_at && out.length == area.receive_size && in.start == area.send_at &&
         in.length == area.send_size;
}

// BOOT is between INIT and INIT.
std::uint16_t Slave::check_boot(AlState from, AlState to) const {
  if (sii_.bootstrap.receive_size == 0) {
    return kAlNoBoot;
  }
  if (to == AlState::Boot && from == AlState::Init) {
    return mailbox_fits(sii_.bootstrap) ? kAlNoError : kAlInvalidBootMailbox;
  }
  return to == AlState::Init || to == from ? kAlNoError : kAlInvalidChange;
}

std::size_t Slave::process_bytes(SyncManagerUse use) const {
  const unsigned number = use == SyncManagerUse::Outputs ? output_manager_ : input_manager_;
  std::size_t bits = 0;
  if (objects_.has(static_cast<std::uint16_t>(kPdoAssignment + number))) {
    const auto assignment = static_cast<std::uint16_t>(kPdoAssignment + number);
    for (std::uint64_t i = 1; i <= objects_.number(assignment, 0); ++i) {
      const auto pdo = static_cast<std::uint16_t>(objects_.number(assignment, static_cast<std::uint8_t>(i)));
      for (std::uint64_t k = 1; k <= objects_.number(pdo, 0); ++k) {
        bits += objects_.number(pdo, static_cast<std::uint8_t>(k)) & 0xFFU;
      }
    }
  } else {
    for (const Pdo& pdo : use == SyncManagerUse::Outputs ? sii_.outputs : sii_.inputs) {
      bits += pdo.sync_manager != 0xFF ? bits_of(pdo) : 0;
    }
  }
  return (bits + 7) / 8;
}

bool Slave::process_data_fits(SyncManagerUse use, unsigned number) const {
  if (sii_.mailbox.receive_size == 0) {
    return true;  // without a processor there is none that checks
  }
  return area_of(number).length == process_bytes(use);
}

void Slave::compute() {
  if (!std::exchange(is_due_, false) || !application_) {
    return;
  }
  const Area out = area_of(output_manager_);
  const Area in = area_of(input_manager_);
  const bool operates = state() == AlState::Op && !outputs_off_;
  application_(operates ? Bytes(esc_.memory(out.start, out.length)) : Bytes(), esc_.memory(in.start, in.length));
}

}  // namespace indurop::io::ethercat
