// SPDX-License-Identifier: Apache-2.0
#include "control/io/ethercat/master/sdo_client.h"

#include <algorithm>
#include <utility>

namespace indurop::io::ethercat {

namespace {

constexpr Clock kAnswerTimeout = std::chrono::seconds(1);
constexpr Clock kIdlePoll = std::chrono::milliseconds(10);  // for emergencies
constexpr std::uint16_t kAnswerActivate = kAnswerStatus + 1;
constexpr std::uint16_t kAnswerPdi = kAnswerStatus + 2;
constexpr std::uint8_t kEnabled = 0x01;
constexpr std::uint8_t kRepeatBit = 0x02;

// Offsets behind the mailbox header.
constexpr std::size_t kCommandAt = 2;
constexpr std::size_t kObjectAt = 3;
constexpr std::size_t kDataAt = 6;
constexpr std::size_t kValueAt = 10;
constexpr std::size_t kSegmentAt = 3;

}  // namespace

void SdoClient::open(std::uint16_t station, const MailboxArea& area) {
  station_ = station;
  area_ = area;
  message_.assign(area.receive_size, 0);
  received_.assign(area.send_size, 0);
}

void SdoClient::reset() noexcept {
  if (transfer_ != nullptr) {
    finish(SdoTransfer::State::TimedOut);
  }
  step_ = Step::Idle;
  counter_ = 0;
  std::fill(received_.begin(), received_.end(), std::uint8_t{0});
  repeat_ = 0;
  next_poll_ = Clock(0);
}

void SdoClient::start(SdoTransfer& transfer, Clock now) noexcept {
  transfer.state = SdoTransfer::State::Waiting;
  transfer.size = 0;
  transfer_ = &transfer;
  done_ = 0;
  toggle_ = false;
  in_segments_ = false;
  write_request(now);
}

void SdoClient::begin_message(std::size_t size) noexcept {
  std::fill(message_.begin(), message_.end(), std::uint8_t{0});
  counter_ = next_counter(counter_);
  write_mailbox_header(message_, size - kMailboxHeader, MailboxType::Coe, counter_);
  write_coe_header(message_, CoeService::SdoRequest);
  step_ = Step::Write;
}

void SdoClient::write_request(Clock now) noexcept {
  const auto& transfer = *transfer_;
  deadline_ = now + kAnswerTimeout;
  const std::size_t size = transfer.sent.size();
  const bool expedited = !transfer.upload && size > 0 && size <= 4;
  const std::size_t first = transfer.upload || expedited ? 0 : std::min(size, message_.size() - kSdoHeader);
  begin_message(kSdoHeader + first);
  const auto sdo = std::span(message_).subspan(kMailboxHeader);
  unsigned command = transfer.upload ? kSdoUpload : kSdoDownload | kSdoSized;
  if (expedited) {
    command |= kSdoExpedited | static_cast<unsigned>(4 - size) << 2U;
    std::copy(transfer.sent.begin(), transfer.sent.end(), sdo.begin() + kDataAt);
    done_ = size;
  } else if (!transfer.upload) {
    store<std::uint32_t>(sdo, kDataAt, static_cast<std::uint32_t>(size));
    std::copy_n(transfer.sent.begin(), first, sdo.begin() + kValueAt);
    done_ = first;
  }
  sdo[kCommandAt] = static_cast<std::uint8_t>(command | (transfer.complete ? kSdoComplete : 0U));
  store<std::uint16_t>(sdo, kObjectAt, transfer.index);
  sdo[kObjectAt + 2] = transfer.subindex;
}

void SdoClient::write_segment() noexcept {
  const std::size_t left = transfer_->sent.size() - done_;
  const std::size_t size = std::min(left, message_.size() - kSegmentHeader);
  begin_message(kSegmentHeader + std::max(size, kMinSegment));
  const auto sdo = std::span(message_).subspan(kMailboxHeader);
  const std::size_t unused = size < kMinSegment ? kMinSegment - size : 0;
  sdo[kCommandAt] =
      static_cast<std::uint8_t>((toggle_ ? kSdoToggle : 0U) | unused << 1U | (size == left ? kSdoLast : 0U));
  std::copy_n(transfer_->sent.begin() + static_cast<std::ptrdiff_t>(done_), size, sdo.begin() + kSegmentAt);
  done_ += size;
}

void SdoClient::write_upload_segment() noexcept {
  begin_message(kSdoHeader);
  message_[kMailboxHeader + kCommandAt] = static_cast<std::uint8_t>(kSdoUploadSegment | (toggle_ ? kSdoToggle : 0U));
}

bool SdoClient::times_out(Clock now) noexcept {
  if (transfer_ == nullptr || now <= deadline_) {
    return false;
  }
  finish(SdoTransfer::State::TimedOut);
  return true;
}

void SdoClient::finish(SdoTransfer::State state, std::uint32_t code) noexcept {
  transfer_->abort_code = code;
  transfer_->state = state;
  transfer_ = nullptr;
  step_ = Step::Idle;
}

std::optional<Query> SdoClient::query(Clock now) noexcept {
  if (times_out(now) || (step_ == Step::Idle && now < next_poll_)) {
    return std::nullopt;
  }
  asked_ = step_;
  switch (step_) {
    case Step::Write:
      return Query{Command::Fpwr, address_of(station_, area_.receive_at), message_, 0};
    case Step::Idle:
    case Step::Poll:
      return Query{Command::Fprd, address_of(station_, kAnswerStatus), {}, 1};
    case Step::Read:
      return Query{Command::Fprd, address_of(station_, area_.send_at), {}, area_.send_size};
    case Step::Repeat:
      return Query{Command::Fpwr, address_of(station_, kAnswerActivate), std::span(&repeat_, 1), 0};
    case Step::RepeatAck:
      break;
  }
  return Query{Command::Fprd, address_of(station_, kAnswerPdi), {}, 1};
}

void SdoClient::answer(Bytes data, bool is_answered, Clock now) noexcept {
  if (asked_ != step_) {
    return;  // a transfer began meanwhile
  }
  if (!is_answered) {
    if (step_ == Step::Read) {
      step_ = Step::Poll;
    }
    return;  // the mailbox is still full, or the slave is gone: the deadline decides
  }
  switch (step_) {
    case Step::Write:
      step_ = Step::Poll;
      return;
    case Step::Idle:
      next_poll_ = now + kIdlePoll;
      [[fallthrough]];
    case Step::Poll:
      if ((data[0] & kMailboxFull) != 0) {
        step_ = Step::Read;
      }
      return;
    case Step::Read:
      step_ = transfer_ != nullptr ? Step::Poll : Step::Idle;
      receive(data);
      return;
    case Step::Repeat:
      step_ = Step::RepeatAck;
      return;
    case Step::RepeatAck:
      if (((data[0] ^ repeat_) & kRepeatBit) == 0) {
        step_ = Step::Poll;
      }
      return;
  }
}

void SdoClient::lost(Clock /*now*/) noexcept {
  if (asked_ == Step::Read && step_ == Step::Read) {  // the slave may believe that the message was read
    repeat_ = static_cast<std::uint8_t>((repeat_ ^ kRepeatBit) | kEnabled);
    step_ = Step::Repeat;
  }
}

std::optional<Emergency> SdoClient::take_emergency() noexcept {
  return std::exchange(emergency_, std::nullopt);
}

// The same counter alone does not prove it: slaves with one that never changes exist.
bool SdoClient::is_repeated(const Mailbox& mailbox, Bytes bytes) noexcept {
  const auto received = std::span(received_).first(std::min(received_.size(), bytes.size()));
  const bool is_same = mailbox.counter != 0 && std::equal(received.begin(), received.end(), bytes.begin());
  std::copy_n(bytes.begin(), received.size(), received.begin());
  return is_same;
}

void SdoClient::receive(Bytes bytes) noexcept {
  const auto mailbox = read_mailbox(bytes);
  if (mailbox && is_repeated(*mailbox, bytes)) {
    return;
  }
  const auto service = mailbox ? service_of(*mailbox) : std::nullopt;
  if (service == CoeService::Emergency && mailbox->data.size() >= kValueAt) {
    Emergency emergency;
    emergency.code = load<std::uint16_t>(mailbox->data, 2);
    emergency.error_register = mailbox->data[4];
    std::copy_n(mailbox->data.begin() + 5, emergency.data.size(), emergency.data.begin());
    emergency_ = emergency;
    return;
  }
  const auto size = mailbox ? mailbox->data.size() : 0;
  if (service == std::nullopt || transfer_ == nullptr || size < kValueAt) {
    return;
  }
  const unsigned command = mailbox->data[kCommandAt];
  if (command == kSdoAbort) {
    if (load<std::uint16_t>(mailbox->data, kObjectAt) == transfer_->index || in_segments_) {
      finish(SdoTransfer::State::Aborted, load<std::uint32_t>(mailbox->data, kDataAt));
    }
    return;
  }
  if (service != CoeService::SdoResponse) {
    return;
  }
  if (!in_segments_ && (load<std::uint16_t>(mailbox->data, kObjectAt) != transfer_->index ||
                        mailbox->data[kObjectAt + 2] != transfer_->subindex)) {
    return;  // the late answer to an earlier request
  }
  if (transfer_->upload) {
    receive_upload(command, mailbox->data);
  } else {
    receive_download(command);
  }
}

void SdoClient::receive_download(unsigned command) noexcept {
  const unsigned expected = in_segments_ ? kSdoDownload | (toggle_ ? kSdoToggle : 0U) : kSdoDownloaded;
  if ((command & (in_segments_ ? kSdoCommandMask | kSdoToggle : kSdoCommandMask)) != expected) {
    finish(SdoTransfer::State::Aborted, in_segments_ ? kAbortToggle : kAbortCommand);
    return;
  }
  if (done_ == transfer_->sent.size()) {
    finish(SdoTransfer::State::Done);
    return;
  }
  toggle_ = in_segments_ && !toggle_;
  in_segments_ = true;
  write_segment();
}

void SdoClient::receive_upload(unsigned command, Bytes data) noexcept {
  if (in_segments_) {
    if ((command & (kSdoCommandMask | kSdoToggle)) != (toggle_ ? kSdoToggle : 0U)) {
      finish(SdoTransfer::State::Aborted, kAbortToggle);
      return;
    }
    auto segment = data.subspan(kSegmentAt);
    if (segment.size() == kMinSegment) {
      segment = segment.first(kMinSegment - (command >> 1U & 7U));
    }
    take(segment);
    toggle_ = !toggle_;
    if (transfer_ != nullptr && (command & kSdoLast) != 0) {
      finish(done_ == total_ ? SdoTransfer::State::Done : SdoTransfer::State::Aborted,
             done_ == total_ ? 0U : kAbortLength);
      return;
    }
  } else {
    if ((command & kSdoCommandMask) != kSdoUpload) {
      finish(SdoTransfer::State::Aborted, kAbortCommand);
      return;
    }
    if ((command & kSdoExpedited) != 0) {
      take(data.subspan(kDataAt, 4 - ((command & kSdoSized) != 0 ? command >> 2U & 3U : 0U)));
      total_ = done_;
    } else {
      total_ = load<std::uint32_t>(data, kDataAt);
      take(data.subspan(kValueAt, std::min(total_, data.size() - kValueAt)));
    }
    in_segments_ = true;
    if (transfer_ != nullptr && done_ >= total_) {
      finish(SdoTransfer::State::Done);
      return;
    }
  }
  if (transfer_ != nullptr) {
    write_upload_segment();
  }
}

void SdoClient::take(Bytes data) noexcept {
  if (data.size() > transfer_->room.size() - done_) {
    finish(SdoTransfer::State::Aborted, kAbortMemory);
    return;
  }
  std::copy(data.begin(), data.end(), transfer_->room.begin() + static_cast<std::ptrdiff_t>(done_));
  done_ += data.size();
  transfer_->size = done_;
}

}  // namespace indurop::io::ethercat
