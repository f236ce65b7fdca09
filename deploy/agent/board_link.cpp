// SPDX-License-Identifier: Apache-2.0
#include "deploy/agent/board_link.h"

#include <fmt/format.h>

#include <chrono>

#include "core/keys/participant_keys.h"
#include "deploy/link/link_keys.h"

namespace indurop::deploy {
namespace {

constexpr std::chrono::milliseconds kLinkRetry{500};
constexpr std::chrono::seconds kKeyCheckInterval{1};

}  // namespace

bool BoardLink::keep(rt::MonoTime now, const std::string& plant, bool idle) {
  if (now >= next_check_ && (link_ == nullptr || idle)) {
    next_check_ = now + kKeyCheckInterval;
    OwnKeys present = keys_.own(plant);
    if (present != own_ && link_ != nullptr) {
      log_.info("the keys of this board have changed: joining the network of agents again");
      leave();
    }
    own_ = std::move(present);
  }
  if (link_ != nullptr || now < join_at_) {
    return false;
  }
  join_at_ = now + kLinkRetry;
  warn(join());
  return link_ != nullptr;
}

void BoardLink::warn(const std::string& message) {
  if (!message.empty() && message != last_warning_) {
    log_.warning("{}", message);
  }
  last_warning_ = message;
}

std::string BoardLink::join() {
  if (!own_.problem.empty()) {
    return own_.problem;
  }
  std::string note;
  settings_.network.security = {};
  if (!own_.folder.empty()) {
    const keys::KeyCheck check =
        keys::check_board_keys(own_.folder, own_.plant, settings_.network.board, keys::instant_now());
    if (check.fault == keys::KeyFault::Missing || check.fault == keys::KeyFault::Wrong) {
      return fmt::format("not in the network of agents: keys of plant {}: {}", own_.plant, check.problem);
    }
    if (check.fault != keys::KeyFault::None) {
      note = fmt::format("keys of plant {}: {}; indurop keys renew {}, and copy permissions.p7s and identity.pem here",
                         own_.plant, check.problem, settings_.network.board);
    }
    note = note.empty() ? check.exposed : note;
    keys::ParticipantKeys own(own_.folder);
    const keys::BoardTrust trust = keys_.trust(own_.plant).current();
    own.revoked = trust.revoked;
    note = note.empty() ? trust.problem : note;
    settings_.network.security = security_of(own);
  }
  auto opened = DeployLink::open(settings_);
  if (!opened) {
    return opened.error().text;
  }
  auto commands = CommandLink::open(*opened->link, CommandSide::Agent);
  if (!commands) {
    return commands.error().text;
  }
  auto platform = opened->link->open_platform();
  if (!platform) {
    return platform.error().text;
  }
  link_ = std::move(opened->link);
  platform_ = std::move(platform).value();
  commands_ = std::move(commands).value();
  if (own_.folder.empty()) {
    log_.info("open: this board has no keys, so any program on this network can command its agent");
  } else {
    log_.info("accepting only participants with keys of plant {}", own_.plant);
  }
  return note.empty() ? opened->note : note;
}

void BoardLink::leave() noexcept {
  commands_.reset();
  platform_.reset();
  link_.reset();
}

}  // namespace indurop::deploy
