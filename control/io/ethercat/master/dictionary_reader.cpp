// SPDX-License-Identifier: Apache-2.0
#include "control/io/ethercat/master/dictionary_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace indurop::io::ethercat {

DictionaryReader::DictionaryReader(Link& link, Requester::Wait wait, std::size_t place, const FoundSlave& slave)
    : session_(link, std::move(wait), place, slave), slave_(slave) {}

// All fragments of the answer.
Result<DictionaryReader::Message, std::string> DictionaryReader::ask(InformationCode code, Bytes data,
                                                                     InformationCode wanted) {
  const Message request = write_information(code, data, session_.room()).front();
  if (std::string wrong = session_.send(MailboxType::Coe, request); !wrong.empty()) {
    return wrong;
  }
  Message all;
  for (bool more = true; more;) {
    const auto message =
        session_.receive([](const Mailbox& mailbox) { return read_information(mailbox.data).has_value(); });
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
  if ((slave_.sii.coe_details & kCoeSdoInfo) == 0) {
    return std::string("it does not describe its objects (no SDO information)");
  }
  if (std::string wrong = session_.open(AlState::PreOp, kProtocolCoe); !wrong.empty()) {
    return wrong;
  }
  return read_all();
}

}  // namespace indurop::io::ethercat
