// SPDX-License-Identifier: Apache-2.0
#include "control/io/ethercat/simulator/information_server.h"

#include <algorithm>
#include <array>

#include "control/io/ethercat/sdo_information.h"

namespace indurop::io::ethercat {

namespace {

using Buffer = std::vector<std::uint8_t>;
using Known = ObjectDictionary::Known;

struct Reply {
  InformationCode code{};
  Buffer data;
};

Reply refusal(std::uint32_t abort) {
  Buffer data(sizeof abort);
  store<std::uint32_t>(data, 0, abort);
  return {InformationCode::Error, std::move(data)};
}

// As CoE numbers unsigned numbers of this size, and texts.
std::uint16_t type_of(const Known& entry) {
  if (entry.type != 0) {
    return entry.type;
  }
  switch (entry.bytes) {
    case 1:
      return 0x05;
    case 2:
      return 0x06;
    case 4:
      return 0x07;
    case 8:
      return 0x1B;
    default:
      return 0x09;
  }
}

bool is_in(const std::vector<Pdo>& pdos, std::uint16_t index, std::uint8_t subindex) {
  return std::any_of(pdos.begin(), pdos.end(), [=](const Pdo& pdo) {
    return std::any_of(pdo.entries.begin(), pdo.entries.end(),
                       [=](const PdoEntry& entry) { return entry.index == index && entry.subindex == subindex; });
  });
}

Reply list(const ObjectDictionary& objects, std::uint16_t type) {
  if (type != kAllObjects) {
    return refusal(kAbortUnsupported);
  }
  const auto indices = objects.indices();
  Buffer data(sizeof type * (1 + indices.size()));
  store<std::uint16_t>(data, 0, type);
  for (std::size_t i = 0; i < indices.size(); ++i) {
    store<std::uint16_t>(data, sizeof type * (1 + i), indices[i]);
  }
  return {InformationCode::List, std::move(data)};
}

Reply object(const ObjectDictionary& objects, std::uint16_t index) {
  const auto entries = objects.entries(index);
  if (entries.empty()) {
    return refusal(kAbortNoObject);
  }
  const bool is_variable = entries.size() == 1 && entries.front().subindex == 0;
  return {InformationCode::Object,
          write_object({index, is_variable ? type_of(entries.front()) : std::uint16_t{0}, entries.back().subindex,
                        is_variable ? ObjectCode::Variable : ObjectCode::Record, entries.front().name})};
}

Reply entry(const ObjectDictionary& objects, const Sii& sii, std::uint16_t index, std::uint8_t subindex) {
  const auto entries = objects.entries(index);
  const auto found =
      std::find_if(entries.begin(), entries.end(), [=](const Known& one) { return one.subindex == subindex; });
  if (found == entries.end()) {
    return refusal(entries.empty() ? kAbortNoObject : kAbortNoSubindex);
  }
  unsigned access = kEntryReadable;
  access |= found->writable ? unsigned{kEntryWritable} : 0U;
  access |= is_in(sii.outputs, index, subindex) ? unsigned{kEntryForOutputs} : 0U;
  access |= is_in(sii.inputs, index, subindex) ? unsigned{kEntryForInputs} : 0U;
  return {InformationCode::Entry,
          write_entry({index, subindex, type_of(*found), static_cast<std::uint16_t>(8 * found->bytes),
                       static_cast<std::uint16_t>(access), found->name})};
}

Reply reply(const Information& request, const ObjectDictionary& objects, const Sii& sii) {
  std::array<std::uint8_t, 4> data{};
  std::copy_n(request.data.begin(), std::min(request.data.size(), data.size()), data.begin());
  const auto first = load<std::uint16_t>(data, 0);
  switch (request.code) {
    case InformationCode::ListRequest:
      return list(objects, first);
    case InformationCode::ObjectRequest:
      return object(objects, first);
    case InformationCode::EntryRequest:
      return entry(objects, sii, first, data[2]);
    default:
      return refusal(kAbortCommand);
  }
}

}  // namespace

std::vector<std::vector<std::uint8_t>> answer_information(Bytes message, const ObjectDictionary& objects,
                                                          const Sii& sii, std::size_t room) {
  const auto request = read_information(message);
  if (!request) {
    return {};
  }
  const Reply made = reply(*request, objects, sii);
  return write_information(made.code, made.data, room - kMailboxHeader);
}

}  // namespace indurop::io::ethercat
