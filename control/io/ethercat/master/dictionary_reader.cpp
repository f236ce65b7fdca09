// SPDX-License-Identifier: Apache-2.0
#include "control/io/ethercat/master/dictionary_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "control/io/ethercat/master/plan.h"
#include "control/io/ethercat/master/slave_control.h"

namespace indurop::io::ethercat {

namespace {

using std::chrono::milliseconds;

constexpr Clock kStatePatience = milliseconds(3000);
constexpr Clock kAnswerPatience = milliseconds(1000);
constexpr std::uint16_t kAnswerStatus = reg::kSyncManager + kSyncManagerBytes + 5;
constexpr std::uint8_t kMailboxFull = 0x08;
const std::string kSilent = "it does not answer any more";

}  // namespace

DictionaryReader::DictionaryReader(Link& link, Requester::Wait wait, std::size_t place, const FoundSlave& slave)
    : requester_(link, std::move(wait)), place_(place), slave_(slave) {}

// Returns what is wrong, as the following.
std::string DictionaryReader::take_to(AlState state) {
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

std::string DictionaryReader::open_mailbox() {
  const SlavePlan plan = plan_of(slave_.sii, 0);
  if (plan.mailbox_managers.empty() || (slave_.sii.protocols & kProtocolCoe) == 0) {
    return "it has no mailbox with CoE";
  }
  if ((slave_.sii.coe_details & kCoeSdoInfo) == 0) {
    return "it does not describe its objects (no SDO information)";
  }
  if (slave_.state != AlState::Init && slave_.state != AlState::PreOp) {
    return fmt::format("it is in {}: a master runs it", to_string(slave_.state));
  }
  if (std::string wrong = take_to(AlState::Init); !wrong.empty()) {
    return wrong;
  }
  const std::array<std::uint8_t, 1> of_device = {kEepromOfDevice};
  if (!requester_.write(place_, reg::kSyncManager, plan.mailbox_managers) ||
      !requester_.write(place_, reg::kEepromConfig, of_device)) {
    return kSilent;
  }
  return take_to(AlState::PreOp);
}

std::string DictionaryReader::send(InformationCode code, Bytes data) {
  const MailboxArea& area = slave_.sii.mailbox;
  const Message message = write_information(code, data, area.receive_size - kMailboxHeader).front();
  Message bytes(area.receive_size);  // the last byte of the area has to be written
  counter_ = next_counter(counter_);
  write_mailbox_header(bytes, message.size(), MailboxType::Coe, counter_);
  std::copy(message.begin(), message.end(), bytes.begin() + kMailboxHeader);
  const Clock deadline = requester_.wait() + kAnswerPatience;
  while (!requester_.write(place_, area.receive_at, bytes)) {
    if (requester_.wait() > deadline) {
      return "its mailbox stays full";
    }
  }
  return {};
}

Result<DictionaryReader::Message, std::string> DictionaryReader::receive() {
  const Clock deadline = requester_.wait() + kAnswerPatience;
  for (Clock now{0}; now < deadline; now = requester_.wait()) {
    const auto status = requester_.read(place_, kAnswerStatus, 1);
    if (!status) {
      return kSilent;
    }
    if (((*status)[0] & kMailboxFull) == 0) {
      continue;
    }
    const auto bytes = requester_.read(place_, slave_.sii.mailbox.send_at, slave_.sii.mailbox.send_size);
    const auto mailbox = bytes ? read_mailbox(*bytes) : std::nullopt;
    if (mailbox && read_information(mailbox->data)) {  // what else comes is not for us
      return Message(mailbox->data.begin(), mailbox->data.end());
    }
  }
  return std::string("it does not answer through its mailbox");
}

// All fragments of the answer.
Result<DictionaryReader::Message, std::string> DictionaryReader::ask(InformationCode code, Bytes data,
                                                                     InformationCode wanted) {
  if (std::string wrong = send(code, data); !wrong.empty()) {
    return wrong;
  }
  Message all;
  for (bool more = true; more;) {
    const auto message = receive();
    if (!message) {
      return message.error();
    }
    const Information part = *read_information(*message);
    if (part.code == InformationCode::Error && part.data.size() >= sizeof(std::uint32_t)) {
      return fmt::format("it refuses: {}", sdo_abort_text(load<std::uint32_t>(part.data, 0)));
    }
    if (part.code != wanted) {
      return fmt::format("it answers with something else ({})", static_cast<unsigned>(part.code));
    }
    all.insert(all.end(), part.data.begin(), part.data.end());
    more = part.is_incomplete;
  }
  return all;
}

Result<DescribedObject, std::string> DictionaryReader::read_one(std::uint16_t index) {
  std::array<std::uint8_t, 4> request{};
  store<std::uint16_t>(request, 0, index);
  const auto described = ask(InformationCode::ObjectRequest, Bytes(request).first(2), InformationCode::Object);
  if (!described) {
    return described.error();
  }
  auto object = read_object(*described);
  if (!object) {
    return std::string("its answer is too short");
  }
  DescribedObject found{std::move(*object), {}};
  const unsigned last = found.object.code == ObjectCode::Variable ? 0 : found.object.last_subindex;
  for (unsigned subindex = 0; subindex <= last; ++subindex) {
    request[2] = static_cast<std::uint8_t>(subindex);
    // A record may have gaps: what is refused is not there.
    const auto entry = ask(InformationCode::EntryRequest, request, InformationCode::Entry);
    if (auto one = entry ? read_entry(*entry) : std::nullopt; one && one->bits > 0) {
      found.entries.push_back(std::move(*one));
    }
  }
  return found;
}

Result<std::vector<DescribedObject>, std::string> DictionaryReader::read_all() {
  std::array<std::uint8_t, 2> type{};
  store<std::uint16_t>(type, 0, kAllObjects);
  const auto list = ask(InformationCode::ListRequest, type, InformationCode::List);
  if (!list) {
    return list.error();
  }
  std::vector<DescribedObject> objects;
  for (std::size_t at = sizeof(std::uint16_t); at + 1 < list->size(); at += sizeof(std::uint16_t)) {
    const auto index = load<std::uint16_t>(*list, at);
    auto object = read_one(index);
    if (!object) {
      return fmt::format("object {:04x}: {}", index, object.error());
    }
    objects.push_back(std::move(*object));
  }
  return objects;
}

Result<std::vector<DescribedObject>, std::string> DictionaryReader::run() {
  if (std::string wrong = open_mailbox(); !wrong.empty()) {
    return wrong;
  }
  auto objects = read_all();
  static_cast<void>(take_to(AlState::Init));
  return objects;
}

}  // namespace indurop::io::ethercat
