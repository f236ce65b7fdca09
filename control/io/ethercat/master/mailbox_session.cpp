// SPDX-License-Identifier: Apache-2.0
#include "control/io/ethercat/master/mailbox_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "control/io/ethercat/master/plan.h"

namespace indurop::io::ethercat {

namespace {

constexpr Clock kStatePatience = std::chrono::seconds(3);
constexpr Clock kSendPatience = std::chrono::seconds(1);
const std::string kSilent = "it does not answer any more";

}  // namespace

MailboxSession::MailboxSession(Link& link, Requester::Wait wait, std::size_t place, const FoundSlave& slave)
    : requester_(link, std::move(wait)), place_(place), slave_(slave) {}

MailboxSession::~MailboxSession() {
  if (is_open_) {
    static_cast<void>(take_to(AlState::Init));
  }
}

std::string MailboxSession::take_to(AlState state) {
  std::array<std::uint8_t, 2> word{};
  const unsigned acknowledge = state == AlState::Init ? kAlError : 0U;
  store<std::uint16_t>(word, 0, static_cast<std::uint16_t>(static_cast<unsigned>(state) | acknowledge));
  if (!requester_.write(place_, reg::kAlControl, word)) {
    return kSilent;
  }
  const Clock deadline = requester_.wait() + kStatePatience;
  for (Clock now{0}; now < deadline; now = requester_.wait()) {
    const auto status = requester_.read(place_, reg::kAlStatus, kStateBytes);
    if (!status) {
      return kSilent;
    }
    if (((*status)[0] & kAlError) != 0 && state != AlState::Init) {
      return fmt::format("it refuses {}: {}", to_string(state),
                         al_status_text(load<std::uint16_t>(*status, kStateCodeAt)));
    }
    if (((*status)[0] & kAlStateMask) == static_cast<unsigned>(state)) {
      return {};
    }
  }
  return fmt::format("it did not reach {} in time", to_string(state));
}

std::string MailboxSession::open(AlState state, std::uint16_t protocol) {
  Sii sii = slave_.sii;
  if (state == AlState::Boot) {
    sii.mailbox = sii.bootstrap;
  }
  area_ = sii.mailbox;
  const SlavePlan plan = plan_of(sii, 0);
  if (plan.mailbox_managers.empty() || (sii.protocols & protocol) == 0) {
    return fmt::format("it has no mailbox with {}{}", protocol == kProtocolFoe ? "FoE" : "CoE",
                       state == AlState::Boot ? " in BOOT" : "");
  }
  if (slave_.state != AlState::Init && slave_.state != AlState::PreOp && slave_.state != AlState::Boot) {
    return fmt::format("it is in {}: a master runs it", to_string(slave_.state));
  }
  is_open_ = true;
  if (std::string wrong = take_to(AlState::Init); !wrong.empty()) {
    return wrong;
  }
  const std::array<std::uint8_t, 1> of_device = {kEepromOfDevice};
  if (!requester_.write(place_, reg::kSyncManager, plan.mailbox_managers) ||
      !requester_.write(place_, reg::kEepromConfig, of_device)) {
    return kSilent;
  }
  return take_to(state);
}

std::string MailboxSession::send(MailboxType type, Bytes message) {
  std::vector<std::uint8_t> bytes(area_.receive_size);  // the last byte of the area has to be written
  counter_ = next_counter(counter_);
  write_mailbox_header(bytes, message.size(), type, counter_);
  std::copy(message.begin(), message.end(), bytes.begin() + kMailboxHeader);
  const Clock deadline = requester_.wait() + kSendPatience;
  while (!requester_.write(place_, area_.receive_at, bytes)) {
    if (requester_.wait() > deadline) {
      return "its mailbox stays full";
    }
  }
  return {};
}

Result<std::vector<std::uint8_t>, std::string> MailboxSession::receive(
    const std::function<bool(const Mailbox&)>& is_wanted, Clock patience) {
  const Clock deadline = requester_.wait() + patience;
  for (Clock now{0}; now < deadline; now = requester_.wait()) {
    const auto status = requester_.read(place_, kAnswerStatus, 1);
    if (!status) {
      return kSilent;
    }
    if (((*status)[0] & kMailboxFull) == 0) {
      continue;
    }
    const auto bytes = requester_.read(place_, area_.send_at, area_.send_size);
    const auto mailbox = bytes ? read_mailbox(*bytes) : std::nullopt;
    if (mailbox && is_wanted(*mailbox)) {
      return std::vector<std::uint8_t>(mailbox->data.begin(), mailbox->data.end());
    }
  }
  return std::string("it does not answer through its mailbox");
}

}  // namespace indurop::io::ethercat
