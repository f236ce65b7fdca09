// SPDX-License-Identifier: Apache-2.0
#include "control/io/ethercat/simulator/object_dictionary.h"

#include <algorithm>
#include <array>

namespace indurop::io::ethercat {

namespace {

// Offsets after the mailbox header.
constexpr std::size_t kAnswerCommand = 2;
constexpr std::size_t kAnswerIndex = 3;
constexpr std::size_t kAnswerSubindex = 5;
constexpr std::size_t kAnswerData = 6;
constexpr std::size_t kAnswerBytes = kAnswerData + 4;
constexpr std::size_t kSegmentData = 3;

std::vector<std::uint8_t> sdo_message(CoeService service, std::uint8_t command, std::uint16_t index,
                                      std::uint8_t subindex, std::uint32_t data) {
  std::vector<std::uint8_t> bytes(kAnswerBytes);
  store<std::uint16_t>(bytes, 0, static_cast<std::uint16_t>(static_cast<unsigned>(service) << 12U));
  bytes[kAnswerCommand] = command;
  store<std::uint16_t>(bytes, kAnswerIndex, index);
  bytes[kAnswerSubindex] = subindex;
  store<std::uint32_t>(bytes, kAnswerData, data);
  return bytes;
}

std::vector<std::uint8_t> sdo_answer(std::uint8_t command, std::uint16_t index, std::uint8_t subindex,
                                     std::uint32_t data) {
  return sdo_message(CoeService::SdoResponse, command, index, subindex, data);
}

// An abort is a request, also from a slave.
std::vector<std::uint8_t> sdo_abort(std::uint16_t index, std::uint8_t subindex, std::uint32_t code) {
  return sdo_message(CoeService::SdoRequest, kSdoAbort, index, subindex, code);
}

std::uint64_t number_of(Bytes bytes) {
  std::uint64_t number = 0;
  for (std::size_t i = 0; i < std::min(bytes.size(), sizeof(number)); ++i) {
    number |= std::uint64_t{bytes[i]} << (8U * i);
  }
  return number;
}

}  // namespace

void ObjectDictionary::add(std::uint16_t index, std::uint8_t subindex, std::vector<std::uint8_t> value, bool writable) {
  objects_[{index, subindex}] = {std::move(value), writable, 0, {}};
  ++changes_;
}

void ObjectDictionary::describe(std::uint16_t index, std::uint8_t subindex, std::uint8_t type, std::string name) {
  if (const auto found = objects_.find({index, subindex}); found != objects_.end()) {
    found->second.type = type;
    found->second.name = std::move(name);
  }
}

std::vector<std::uint16_t> ObjectDictionary::indices() const {
  std::vector<std::uint16_t> all;
  for (const auto& [at, object] : objects_) {
    if (all.empty() || all.back() != at.first) {
      all.push_back(at.first);
    }
  }
  return all;
}

std::vector<ObjectDictionary::Known> ObjectDictionary::entries(std::uint16_t index) const {
  std::vector<Known> all;
  for (auto found = objects_.lower_bound({index, 0}); found != objects_.end() && found->first.first == index; ++found) {
    const Object& object = found->second;
    all.push_back({found->first.second, object.value.size(), object.writable, object.type, object.name});
  }
  return all;
}

std::uint64_t ObjectDictionary::number(std::uint16_t index, std::uint8_t subindex) const {
  const auto found = objects_.find({index, subindex});
  return found == objects_.end() ? 0 : number_of(found->second.value);
}

std::span<std::uint8_t> ObjectDictionary::storage(std::uint16_t index, std::uint8_t subindex) {
  const auto found = objects_.find({index, subindex});
  return found == objects_.end() ? std::span<std::uint8_t>() : std::span(found->second.value);
}

bool ObjectDictionary::is_writable(std::uint16_t index, std::uint8_t subindex) const {
  const auto found = objects_.find({index, subindex});
  return found != objects_.end() && found->second.writable;
}

bool ObjectDictionary::has(std::uint16_t index) const {
  return objects_.contains({index, 0});
}

std::optional<std::uint32_t> ObjectDictionary::read(std::uint16_t index, std::uint8_t subindex, bool complete,
                                                    std::vector<std::uint8_t>& value) const {
  if (!has(index)) {
    return kAbortNoObject;
  }
  auto found = objects_.find({index, subindex});
  if (found == objects_.end()) {
    return kAbortNoSubindex;
  }
  if (!complete) {
    value = found->second.value;
    return std::nullopt;
  }
  value.clear();
  for (; found != objects_.end() && found->first.first == index; ++found) {
    value.insert(value.end(), found->second.value.begin(), found->second.value.end());
    if (found->first.second == 0) {
      value.resize(2);
    }
  }
  return std::nullopt;
}

std::optional<std::uint32_t> ObjectDictionary::write(std::uint16_t index, std::uint8_t subindex, bool complete,
                                                     Bytes value) {
  if (!has(index)) {
    return kAbortNoObject;
  }
  auto found = objects_.find({index, subindex});
  if (found == objects_.end()) {
    return kAbortNoSubindex;
  }
  auto rest = value;
  std::vector<std::pair<std::uint8_t, Bytes>> parts;  // by subindex
  for (; found != objects_.end() && found->first.first == index && (complete || parts.empty()); ++found) {
    const bool counts = complete && found->first.second == 0;
    const std::size_t size = counts ? 2 : found->second.value.size();
    if (!found->second.writable) {
      return kAbortReadOnly;
    }
    if (rest.size() < size) {
      if (complete && rest.empty()) {
        break;
      }
      return kAbortLength;
    }
    parts.emplace_back(found->first.second, rest.first(counts ? 1 : size));
    rest = rest.subspan(size);
  }
  if (!rest.empty()) {
    return kAbortLength;
  }
  if (complete && rule_ && parts.front().first == 0) {
    const std::array<std::uint8_t, 1> none{};
    if (const auto refused = put(index, 0, none)) {
      return refused;
    }
    std::rotate(parts.begin(), parts.begin() + 1, parts.end());
  }
  for (const auto& part : parts) {
    if (const auto refused = put(index, part.first, part.second)) {
      return refused;
    }
  }
  ++changes_;
  return std::nullopt;
}

std::optional<std::uint32_t> ObjectDictionary::put(std::uint16_t index, std::uint8_t subindex, Bytes value) {
  if (rule_) {
    if (const auto refused = rule_(*this, index, subindex, number_of(value))) {
      return refused;
    }
  }
  std::copy(value.begin(), value.end(), storage(index, subindex).begin());
  return std::nullopt;
}

std::vector<std::uint8_t> SdoServer::answer(Bytes message, ObjectDictionary& objects, std::size_t room) {
  if (message.size() < kAnswerBytes) {
    return sdo_abort(0, 0, kAbortCommand);
  }
  const unsigned command = message[kAnswerCommand];
  if (refusal_) {
    const std::uint32_t code = *refusal_;
    refusal_.reset();
    transfer_.reset();
    return code == 0 ? std::vector<std::uint8_t>()
                     : sdo_abort(load<std::uint16_t>(message, kAnswerIndex), message[kAnswerSubindex], code);
  }
  switch (command & kSdoCommandMask) {
    case 0:
      return download_segment(message, objects);
    case kSdoDownload:
      return download(message, objects);
    case kSdoUpload:
      return upload(message, objects, room);
    case kSdoUploadSegment:
      return upload_segment(message, room);
    case kSdoAbort:
      transfer_.reset();
      return {};
    default:
      return sdo_abort(load<std::uint16_t>(message, kAnswerIndex), message[kAnswerSubindex], kAbortCommand);
  }
}

std::vector<std::uint8_t> SdoServer::finish_download(const Transfer& transfer, ObjectDictionary& objects) {
  if (const auto refused = objects.write(transfer.index, transfer.subindex, transfer.complete, transfer.value)) {
    return sdo_abort(transfer.index, transfer.subindex, *refused);
  }
  ++downloads_;
  return {};
}

std::vector<std::uint8_t> SdoServer::download(Bytes message, ObjectDictionary& objects) {
  const unsigned command = message[kAnswerCommand];
  Transfer transfer;
  transfer.index = load<std::uint16_t>(message, kAnswerIndex);
  transfer.subindex = message[kAnswerSubindex];
  transfer.complete = (command & kSdoComplete) != 0;
  transfer_.reset();
  if ((command & kSdoExpedited) != 0) {
    const std::size_t unused = (command & kSdoSized) != 0 ? command >> 2U & 3U : 0;
    const auto data = message.subspan(kAnswerData, 4 - unused);
    transfer.value.assign(data.begin(), data.end());
  } else {
    transfer.done = load<std::uint32_t>(message, kAnswerData);  // bytes that are announced
    const auto data = message.subspan(kAnswerBytes);
    transfer.value.assign(data.begin(),
                          data.begin() + static_cast<std::ptrdiff_t>(std::min(data.size(), transfer.done)));
    if (transfer.value.size() < transfer.done) {
      const auto index = transfer.index;
      const auto subindex = transfer.subindex;
      transfer_ = std::move(transfer);
      return sdo_answer(kSdoDownloaded, index, subindex, 0);
    }
  }
  auto refused = finish_download(transfer, objects);
  return refused.empty() ? sdo_answer(kSdoDownloaded, transfer.index, transfer.subindex, 0) : refused;
}

std::vector<std::uint8_t> SdoServer::download_segment(Bytes message, ObjectDictionary& objects) {
  const unsigned command = message[kAnswerCommand];
  if (!transfer_) {
    return sdo_abort(0, 0, kAbortCommand);
  }
  const bool toggle = (command & kSdoToggle) != 0;
  if (toggle != transfer_->toggle) {
    const Transfer broken = *std::exchange(transfer_, std::nullopt);
    return sdo_abort(broken.index, broken.subindex, kAbortToggle);
  }
  auto data = message.subspan(kSegmentData);
  if (data.size() <= kMinSegment) {
    data = data.first(std::min<std::size_t>(data.size(), kMinSegment - (command >> 1U & 7U)));
  }
  transfer_->value.insert(transfer_->value.end(), data.begin(), data.end());
  transfer_->toggle = !toggle;
  if ((command & kSdoLast) != 0) {
    const Transfer whole = *std::exchange(transfer_, std::nullopt);
    if (auto refused = finish_download(whole, objects); !refused.empty()) {
      return refused;
    }
  }
  auto bytes = sdo_answer(static_cast<std::uint8_t>(kSdoDownload | (toggle ? kSdoToggle : 0)), 0, 0, 0);
  return bytes;
}

std::vector<std::uint8_t> SdoServer::upload(Bytes message, const ObjectDictionary& objects, std::size_t room) {
  const unsigned command = message[kAnswerCommand];
  Transfer transfer;
  transfer.index = load<std::uint16_t>(message, kAnswerIndex);
  transfer.subindex = message[kAnswerSubindex];
  transfer_.reset();
  if (const auto refused =
          objects.read(transfer.index, transfer.subindex, (command & kSdoComplete) != 0, transfer.value)) {
    return sdo_abort(transfer.index, transfer.subindex, *refused);
  }
  const std::size_t size = transfer.value.size();
  const auto complete = static_cast<std::uint8_t>(command & kSdoComplete);
  if (size > 0 && size <= 4) {
    const auto unused = static_cast<unsigned>(4 - size) << 2U;
    auto bytes = sdo_answer(static_cast<std::uint8_t>(kSdoUpload | complete | unused | kSdoExpedited | kSdoSized),
                            transfer.index, transfer.subindex, 0);
    std::copy(transfer.value.begin(), transfer.value.end(), bytes.begin() + kAnswerData);
    return bytes;
  }
  auto bytes = sdo_answer(static_cast<std::uint8_t>(kSdoUpload | complete | kSdoSized), transfer.index,
                          transfer.subindex, static_cast<std::uint32_t>(size));
  const std::size_t first = std::min(size, room - kSdoHeader);
  bytes.insert(bytes.end(), transfer.value.begin(), transfer.value.begin() + static_cast<std::ptrdiff_t>(first));
  if (first < size) {
    transfer.done = first;
    transfer_ = std::move(transfer);
  }
  return bytes;
}

std::vector<std::uint8_t> SdoServer::upload_segment(Bytes message, std::size_t room) {
  const bool toggle = (message[kAnswerCommand] & kSdoToggle) != 0;
  if (!transfer_) {
    return sdo_abort(0, 0, kAbortCommand);
  }
  if (toggle != transfer_->toggle) {
    const Transfer broken = *std::exchange(transfer_, std::nullopt);
    return sdo_abort(broken.index, broken.subindex, kAbortToggle);
  }
  const std::size_t left = transfer_->value.size() - transfer_->done;
  const std::size_t size = std::min(left, room - kSegmentHeader);
  const std::size_t unused = size < kMinSegment ? kMinSegment - size : 0;
  std::vector<std::uint8_t> bytes(kSegmentData);
  store<std::uint16_t>(bytes, 0, static_cast<std::uint16_t>(static_cast<unsigned>(CoeService::SdoResponse) << 12U));
  bytes[kAnswerCommand] =
      static_cast<std::uint8_t>((toggle ? kSdoToggle : 0U) | unused << 1U | (size == left ? kSdoLast : 0U));
  const auto from = transfer_->value.begin() + static_cast<std::ptrdiff_t>(transfer_->done);
  bytes.insert(bytes.end(), from, from + static_cast<std::ptrdiff_t>(size));
  bytes.resize(std::max(bytes.size(), kSegmentData + kMinSegment));
  transfer_->done += size;
  transfer_->toggle = !toggle;
  if (size == left) {
    transfer_.reset();
  }
  return bytes;
}

}  // namespace indurop::io::ethercat
