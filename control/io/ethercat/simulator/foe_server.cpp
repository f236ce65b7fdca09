// SPDX-License-Identifier: Apache-2.0
#include "control/io/ethercat/simulator/foe_server.h"

#include <algorithm>

namespace indurop::io::ethercat {

namespace {

constexpr std::size_t kMaxFile = 16 * std::size_t{1024} * 1024;

}  // namespace

std::vector<std::uint8_t> FoeServer::answer(Bytes message, bool in_boot, Room room) {
  const auto request = read_foe(message);
  if (!request) {
    return write_foe(FoeCode::Error, kFoePacket);
  }
  if (busy_ > 0) {
    --busy_;
    return write_foe(FoeCode::Busy, 0);
  }
  switch (request->code) {
    case FoeCode::Read:
    case FoeCode::Write:
      return begin(*request, in_boot, room);
    case FoeCode::Data:
      return take(*request, room.in);
    case FoeCode::Acknowledge:
      if (!transfer_ || !transfer_->reads || request->number != transfer_->packet) {
        transfer_.reset();
        return write_foe(FoeCode::Error, kFoePacket);
      }
      return give(room.out);
    default:
      transfer_.reset();
      return {};
  }
}

std::vector<std::uint8_t> FoeServer::begin(const Foe& request, bool in_boot, Room room) {
  transfer_.reset();
  const std::string name(request.data.begin(), std::find(request.data.begin(), request.data.end(), std::uint8_t{0}));
  if (password_ != 0 && request.number != password_) {
    return write_foe(FoeCode::Error, kFoeAccess, "wrong password");
  }
  if (request.code == FoeCode::Write) {
    if (name.starts_with("firmware") && !in_boot) {
      return write_foe(FoeCode::Error, kFoeBootOnly);
    }
    transfer_ = Transfer{name, {}, 0, 0, false};
    return write_foe(FoeCode::Acknowledge, 0);
  }
  const auto found = files_.find(name);
  if (found == files_.end()) {
    return write_foe(FoeCode::Error, kFoeNotFound, name);
  }
  transfer_ = Transfer{name, found->second, 0, 0, true};
  return give(room.out);
}

std::vector<std::uint8_t> FoeServer::take(const Foe& packet, std::size_t room) {
  if (!transfer_ || transfer_->reads || packet.number != transfer_->packet + 1) {
    transfer_.reset();
    return write_foe(FoeCode::Error, kFoePacket);
  }
  if (transfer_->content.size() + packet.data.size() > kMaxFile) {
    transfer_.reset();
    return write_foe(FoeCode::Error, kFoeFull);
  }
  transfer_->content.insert(transfer_->content.end(), packet.data.begin(), packet.data.end());
  transfer_->packet = packet.number;
  if (packet.data.size() < room - kFoeHeader) {
    files_[transfer_->name] = std::move(transfer_->content);
    transfer_.reset();
  }
  return write_foe(FoeCode::Acknowledge, packet.number);
}

// The next packet; nothing after one that was not full.
std::vector<std::uint8_t> FoeServer::give(std::size_t room) {
  const std::size_t most = room - kFoeHeader;
  Transfer& transfer = *transfer_;
  if (transfer.packet > 0 && transfer.done < transfer.packet * most) {
    transfer_.reset();
    return {};
  }
  const Bytes part =
      Bytes(transfer.content).subspan(transfer.done, std::min(most, transfer.content.size() - transfer.done));
  transfer.done += part.size();
  return write_foe(FoeCode::Data, ++transfer.packet, part);
}

}  // namespace indurop::io::ethercat
