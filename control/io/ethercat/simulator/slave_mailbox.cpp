// SPDX-License-Identifier: Apache-2.0
// The mailbox of a simulated slave: what it answers, and when.
#include <algorithm>
#include <utility>

#include "control/io/ethercat/simulator/information_server.h"
#include "control/io/ethercat/simulator/slave.h"

namespace indurop::io::ethercat {

void Slave::receive_mailbox(Time now) {
  const Area area = area_of(kMailboxOut);
  esc_.set_mailbox_full(kMailboxOut, false);
  const auto mailbox = read_mailbox(esc_.memory(area.start, area.length));
  if (!mailbox || state() == AlState::Init) {
    return;
  }
  if (mailbox->counter != 0 && mailbox->counter == last_counter_) {
    return;  // the same again: its answer was lost, or it was
  }
  last_counter_ = mailbox->counter;
  if (mailbox->type == MailboxType::Foe && (sii().protocols & kProtocolFoe) != 0) {
    const FoeServer::Room room{area_of(kMailboxOut).length - kMailboxHeader,
                               area_of(kMailboxIn).length - kMailboxHeader};
    if (const auto bytes = foe_.answer(mailbox->data, state() == AlState::Boot, room); !bytes.empty()) {
      answer_with(MailboxType::Foe, bytes, now);
    }
  }
  if (state() != AlState::Boot) {
    answer_coe(*mailbox, now);
  }
}

void Slave::answer_coe(const Mailbox& mailbox, Time now) {
  const std::size_t room = area_of(kMailboxIn).length;
  if (service_of(mailbox) == CoeService::SdoInformation && (sii().coe_details & kCoeSdoInfo) != 0) {
    for (const auto& bytes : answer_information(mailbox.data, objects_, sii(), room)) {
      answer_with(MailboxType::Coe, bytes, now);
    }
  }
  if (service_of(mailbox) == CoeService::SdoRequest) {
    if (const auto bytes = sdo_.answer(mailbox.data, objects_, room); !bytes.empty()) {
      answer_with(MailboxType::Coe, bytes, now);
    }
  }
}

void Slave::answer_with(MailboxType type, Bytes bytes, Time now) {
  own_counter_ = next_counter(own_counter_);
  std::vector<std::uint8_t> message(kMailboxHeader);
  write_mailbox_header(message, bytes.size(), type, own_counter_);
  message.insert(message.end(), bytes.begin(), bytes.end());
  if (now < repeats_until_) {
    answers_.push_back({now + mailbox_time_, message});
  }
  answers_.push_back({now + mailbox_time_, std::move(message)});
}

void Slave::send_emergency(const Emergency& emergency) {
  std::vector<std::uint8_t> message(kCoeHeader + 8);
  own_counter_ = next_counter(own_counter_);
  write_mailbox_header(message, message.size() - kMailboxHeader, MailboxType::Coe, own_counter_);
  write_coe_header(message, CoeService::Emergency);
  store<std::uint16_t>(message, kCoeHeader, emergency.code);
  message[kCoeHeader + 2] = emergency.error_register;
  std::copy(emergency.data.begin(), emergency.data.end(), message.begin() + kCoeHeader + 3);
  answers_.push_back({Time(0), std::move(message)});
}

void Slave::deliver_mailbox(Time now) {
  const Area area = area_of(kMailboxIn);
  if (answers_.empty() || answers_.front().due > now || area.length == 0 || state() == AlState::Init ||
      esc_.mailbox_is_full(kMailboxIn)) {
    return;
  }
  last_answer_ = std::move(answers_.front().bytes);
  answers_.pop_front();
  const auto to = esc_.memory(area.start, area.length);
  std::fill(to.begin(), to.end(), std::uint8_t{0});
  std::copy_n(last_answer_.begin(), std::min(last_answer_.size(), to.size()), to.begin());
  esc_.set_mailbox_full(kMailboxIn, true);
}

}  // namespace indurop::io::ethercat
