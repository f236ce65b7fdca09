// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/jog/jog_desk.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <utility>

#include "core/rt/clock.h"
#include "store/operate/set.h"
#include "store/vars/custody.h"
#include "tools/cli/values/here_source.h"
#include "tools/serve/random_word.h"

namespace indurop::serve {
namespace {

using base::Problem;

constexpr double kMost = 100;  // %
constexpr int kWorkFrame = 3;  // ROBOT_JOG.eFrame

// Converts to ROBOT_JOG.eFrame. Any word other than the first three is a work frame, which the robot accepts or
// rejects.
Result<int, Problem> number_of(const std::string& frame) {
  constexpr std::array<std::string_view, 3> kWords{"axes", "base", "tool"};
  constexpr std::size_t kLongest = 31;  // size of ROBOT_JOG.frame
  const auto usual = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
  if (frame.empty() || frame.size() > kLongest || !std::all_of(frame.begin(), frame.end(), usual)) {
    return Problem{"frame is axes, base, tool or the name of a work frame"};
  }
  return static_cast<int>(std::find(kWords.begin(), kWords.end(), frame) - kWords.begin());
}

std::optional<Problem> wrong_with(const JogWish& wish, std::size_t axes) {
  const auto moves = [](double speed) { return speed != 0; };
  if (wish.speed.size() > axes || std::count_if(wish.speed.begin(), wish.speed.end(), moves) != 1) {
    return Problem{fmt::format("speed has at most {} numbers, of which one is not 0", axes)};
  }
  if (!std::all_of(wish.speed.begin(), wish.speed.end(), [](double speed) { return std::abs(speed) <= kMost; })) {
    return Problem{"speed is -100 to 100 %"};
  }
  return std::nullopt;
}

// The enabling switch of one robot.
struct Switch {
  const vars::DirectoryEntry* entry = nullptr;
  schema::Type type;
  std::uint32_t beat_offset = 0;
  std::size_t axes = 0;
};
Result<Switch, Problem> switch_of(const vars::Store& store, const std::string& robot) {
  const std::string name = robot.empty() ? "ROBOT_JOG" : robot + "::ROBOT_JOG";
  const schema::Variable* variable = schema::find_variable(store.schema(), name);
  const auto* entry = variable != nullptr ? store.find(variable->name_hash()) : nullptr;
  if (entry == nullptr) {
    return Problem{fmt::format("there is no {}", name)};
  }
  std::string message;
  const auto beat = schema::find_place(store.schema(), name + ".nBeat", message);
  const auto speed = schema::find_place(store.schema(), name + ".dSpeed", message);
  if (!beat || !speed || speed->type.dims.size() != 1 || beat->type.base != schema::Base::UInt32) {
    return Problem{
        fmt::format("{} has no nBeat: its robot was built before there was one, and is not moved from afar", name)};
  }
  return Switch{entry, variable->type, beat->offset, speed->type.dims[0]};
}

}  // namespace

struct JogDesk::Hand {
  std::string board;
  std::string robot;
  std::string who;
  std::string from;
  std::string what;  // for the audit log
  vars::Store store;
  Switch place;
  std::uint32_t beat = 0;
  std::int64_t until_ns = 0;  // CLOCK_MONOTONIC

  // Returns false if it cannot be written.
  bool write(const std::string& text) {
    std::vector<std::uint8_t> bytes(place.type.size());
    std::string message;
    return store.read(*place.entry, 0, bytes).ok() && schema::parse_value(place.type, text, bytes, message).ok() &&
           store.write(*place.entry, 0, bytes).ok();
  }
};

JogDesk::JogDesk(const Audit& audit) : audit_(&audit) {}

JogDesk::~JogDesk() {
  for (const auto& [name, hand] : all_) {
    release(*hand, "ended: the server ends");
  }
}

Result<std::string, Problem> JogDesk::begin(const std::string& board, const std::string& robot, const std::string& who,
                                            const std::string& from, const JogWish& wish) {
  const auto frame = number_of(wish.frame);
  if (!frame) {
    return frame.error();
  }
  auto store = vars::Store::attach(board, vars::Mode::ReadWrite);
  if (!store) {
    return Problem{fmt::format("its variables cannot be opened: {}", store.error().where)};
  }
  auto place = switch_of(*store, robot);
  if (!place) {
    return place.error();
  }
  if (auto wrong = wrong_with(wish, place->axes)) {
    return std::move(*wrong);
  }
  for (const vars::Force& force : store->forces()) {
    if (force.variable == place->entry) {
      return Problem{operate::is_forced(robot.empty() ? "ROBOT_JOG" : robot + "::ROBOT_JOG")};
    }
  }
  const std::lock_guard guard(mutex_);
  for (const auto& [name, hand] : all_) {
    if (hand->board == board && hand->robot == robot) {
      return Problem{fmt::format("{} is moving it already", hand->who)};
    }
  }
  auto hand = std::make_unique<Hand>(
      Hand{board, robot, who, from, {}, std::move(store).value(), std::move(place).value(), 0, rt::now_ns() + kKeepNs});
  std::vector<double> speed = wish.speed;
  speed.resize(hand->place.axes);
  hand->what = fmt::format("{} {} [{}]", robot, wish.frame, fmt::join(speed, ", "));
  (void)hand->store.read(*hand->place.entry, hand->place.beat_offset,
                         {reinterpret_cast<std::uint8_t*>(&hand->beat), sizeof hand->beat});
  hand->beat = std::max(hand->beat + 1, 1U);
  const std::string named = *frame == kWorkFrame ? fmt::format(", frame: \"{}\"", wish.frame) : "";
  if (!hand->write(fmt::format("{{bEnable: 1, eFrame: {}, dSpeed: [{}], nBeat: {}{}}}", *frame, fmt::join(speed, ", "),
                               hand->beat, named))) {
    (void)hand->write("{bEnable: 0}");
    return Problem{"ROBOT_JOG cannot be written"};
  }
  hands_ = all_.size() + 1;
  return all_.emplace(random_word(), std::move(hand)).first->first;
}

bool JogDesk::keep(const std::string& board, const std::string& name, const std::string& who) {
  look();
  const std::lock_guard guard(mutex_);
  const auto found = all_.find(name);
  if (found == all_.end() || found->second->board != board || found->second->who != who) {
    return false;
  }
  Hand& hand = *found->second;
  hand.beat = std::max(hand.beat + 1, 1U);
  const bool sound = !hand.store.retired() && vars::lock_of(board).lock == vars::WriteLock::None &&
                     hand.write(fmt::format("{{nBeat: {}}}", hand.beat));
  if (!sound) {
    release(hand, "ended: it can no longer be written");
    all_.erase(found);
    hands_ = all_.size();
    return false;
  }
  hand.until_ns = rt::now_ns() + kKeepNs;
  return true;
}

bool JogDesk::end(const std::string& board, const std::string& name, const std::string& who) {
  const std::lock_guard guard(mutex_);
  const auto found = all_.find(name);
  if (found == all_.end() || found->second->board != board || found->second->who != who) {
    return false;
  }
  release(*found->second, "done");
  all_.erase(found);
  hands_ = all_.size();
  return true;
}

void JogDesk::look() {
  const std::int64_t now = rt::now_ns();
  const std::lock_guard guard(mutex_);
  std::erase_if(all_, [&](const auto& one) {
    if (one.second->until_ns > now) {
      return false;
    }
    release(*one.second, "ended: its client was not heard any more");
    return true;
  });
  hands_ = all_.size();
}

void JogDesk::release(Hand& hand, const char* outcome) {
  (void)hand.write("{bEnable: 0}");
  AuditEntry entry;
  entry.who = hand.who;
  entry.from = hand.from;
  entry.board = hand.board;
  entry.action = "end of jog";
  entry.what = hand.what;
  entry.outcome = outcome;
  (void)audit_->note(entry);
}

}  // namespace indurop::serve
