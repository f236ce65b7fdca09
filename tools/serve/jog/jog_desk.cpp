// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/jog/jog_desk.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <cmath>
#include <cstring>
#include <optional>
#include <span>
#include <thread>
#include <utility>
#include <vector>

#include "core/base/name_patterns.h"
#include "core/schema/write_field.h"
#include "store/operate/set.h"
#include "store/vars/custody.h"
#include "tools/client/robot/guided_record.h"
#include "tools/serve/jog/guided_path.h"

namespace indurop::serve {
namespace {

using base::Problem;

constexpr double kMaxSpeed = 100;  // %
constexpr int kWorkFrame = 3;      // ROBOT_JOG.eFrame
constexpr int kByHand = tools::GuidedRecord::kByHand;
constexpr int kWorld = 5;

// Converts to ROBOT_JOG.eFrame. Any word other than these is a work frame, which the robot accepts or rejects.
Result<int, Problem> number_of(const std::string& frame) {
  constexpr std::array<std::string_view, 3> kWords{"axes", "base", "tool"};
  constexpr std::size_t kLongest = 31;  // size of ROBOT_JOG.frame
  const auto usual = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
  if (frame.empty() || frame.size() > kLongest || !std::all_of(frame.begin(), frame.end(), usual)) {
    return Problem{"frame is axes, base, tool, world, hand or the name of a work frame"};
  }
  if (frame == "world") {
    return kWorld;
  }
  if (frame == "hand") {
    return kByHand;
  }
  return static_cast<int>(std::find(kWords.begin(), kWords.end(), frame) - kWords.begin());
}

std::optional<Problem> wrong_with(const JogRequest& request, int frame, std::size_t axes) {
  if (frame == kByHand) {
    return request.speed.empty() ? std::nullopt : std::optional(Problem{"a hand sets the speed: leave speed out"});
  }
  const auto moves = [](double speed) { return speed != 0; };
  if (request.speed.size() > axes || std::count_if(request.speed.begin(), request.speed.end(), moves) != 1) {
    return Problem{fmt::format("speed has at most {} numbers, of which one is not 0", axes)};
  }
  if (!std::all_of(request.speed.begin(), request.speed.end(),
                   [](double speed) { return std::abs(speed) <= kMaxSpeed; })) {
    return Problem{"speed is -100 to 100 %"};
  }
  return std::nullopt;
}

}  // namespace

Result<JogDesk::Switch, Problem> JogDesk::switch_of(const vars::Store& store, const std::string& robot) {
  const std::string name = robot.empty() ? "ROBOT_JOG" : robot + "::ROBOT_JOG";
  const schema::Variable* variable = schema::find_variable(store.schema(), name);
  const auto* entry = variable != nullptr ? store.find(variable->name_hash()) : nullptr;
  if (entry == nullptr) {
    return Problem{fmt::format("there is no {}", name)};
  }
  const auto beat = schema::find_place(store.schema(), name + ".nBeat");
  const auto enable = schema::find_place(store.schema(), name + ".bEnable");
  const auto speed = schema::find_place(store.schema(), name + ".dSpeed");
  if (!beat || !enable || !speed || speed->type.dims.size() != 1 || beat->type.base != schema::Base::UInt32) {
    return Problem{
        fmt::format("{} has no nBeat: its robot was built with an older release and cannot be jogged remotely", name)};
  }
  return Switch{entry, name, variable->type, beat->offset, enable->offset, enable->type.size(), speed->type.dims[0]};
}

void JogDesk::Hand::count_beat() {
  beat = std::max(beat + 1, 1U);  // 0 has another meaning
}

bool JogDesk::Hand::is_pressed(std::span<const std::uint8_t> bytes) const {
  const auto enable = bytes.subspan(place.enable_offset, place.enable_size);
  return std::any_of(enable.begin(), enable.end(), [](std::uint8_t byte) { return byte != 0; });
}

const char* JogDesk::Hand::send_beat() {
  const std::uint32_t last = beat;
  count_beat();
  bool own = true;
  const bool may =
      !store.retired() && store.header().generation.load() == run && vars::lock_of(board).lock == vars::WriteLock::None;
  std::vector<std::uint8_t> bytes(place.type.size());
  if (may && store.read(*place.entry, 0, bytes).ok()) {
    std::uint32_t found = 0;
    std::memcpy(&found, bytes.data() + place.beat_offset, sizeof found);
    own = found == last && is_pressed(bytes);
    // Only this field: another client may release the switch just now.
    const std::span beats(reinterpret_cast<const std::uint8_t*>(&beat), sizeof beat);
    if (own && store.write(*place.entry, place.beat_offset, beats).ok()) {
      return nullptr;
    }
  }
  release();
  return own ? "ended: it can no longer be written" : "ended: another client has written ROBOT_JOG";
}

void JogDesk::Hand::release() {
  if (path) {
    path->stop();
  }
  (void)store.write(*place.entry, place.enable_offset, std::vector<std::uint8_t>(place.enable_size));
}

JogDesk::~JogDesk() {
  desk_.expire([](Hand& hand) { hand.release(); }, "ended: the server ends", true);
}

void JogDesk::release_before(Hand& hand) {
  constexpr std::chrono::milliseconds kPeriods{100};  // longer than the period of any robot
  std::vector<std::uint8_t> bytes(hand.place.type.size());
  if (hand.store.read(*hand.place.entry, 0, bytes).ok() && hand.is_pressed(bytes)) {
    hand.release();
    std::this_thread::sleep_for(kPeriods);
  }
}

std::optional<Problem> JogDesk::record_path(Hand& hand) {
  if (auto refused = tools::why_not_guided(hand.store, hand.robot)) {
    return Problem{std::move(*refused)};
  }
  auto store = vars::Store::attach(hand.board, vars::Mode::ReadOnly);
  if (!store) {
    return Problem{fmt::format("its variables cannot be opened: {}", store.error().where)};
  }
  auto record = tools::GuidedRecord::open(*store, hand.robot);
  if (!record) {
    return record.error();
  }
  hand.path = std::make_shared<GuidedPath>(std::move(store).value(), std::move(record).value());
  const std::lock_guard guard(mutex_);
  paths_[{hand.board, hand.robot}] = hand.path;
  return std::nullopt;
}

std::shared_ptr<const GuidedPath> JogDesk::guided_path(const std::string& board, const std::string& robot) const {
  const std::lock_guard guard(mutex_);
  const auto found = paths_.find({board, robot});
  return found == paths_.end() ? nullptr : found->second;
}

Result<std::string, Problem> JogDesk::begin(const std::string& board, const std::string& robot, const std::string& who,
                                            const std::string& from, const JogRequest& request) {
  const auto frame = number_of(request.frame);
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
  if (auto wrong = wrong_with(request, *frame, place->axes)) {
    return std::move(*wrong);
  }
  for (const vars::Force& force : store->forces()) {
    if (force.variable == place->entry) {
      return Problem{operate::is_forced(robot.empty() ? "ROBOT_JOG" : robot + "::ROBOT_JOG")};
    }
  }
  std::vector<double> speed = request.speed;
  speed.resize(place->axes);
  Hand hand(std::move(store).value(), std::move(place).value());
  hand.run = hand.store.header().generation.load();
  hand.board = board;
  hand.robot = robot;
  hand.who = {who, from, {}};
  hand.keep_ns = *frame == kByHand ? kKeepByHandNs : 0;
  hand.what = *frame == kByHand ? fmt::format("{} by hand", robot)
                                : fmt::format("{} {} [{}]", robot, request.frame, fmt::join(speed, ", "));
  return desk_.add(std::move(hand), [&](Hand& pressed, const auto& others) -> std::optional<Problem> {
    for (const auto& [name, other] : others) {
      if (other.board == board && other.robot == robot) {
        return Problem{fmt::format("{} is moving it already", other.who.name)};
      }
    }
    if (auto refused = *frame == kByHand ? record_path(pressed) : std::nullopt) {
      return refused;
    }
    release_before(pressed);
    (void)pressed.store.read(*pressed.place.entry, pressed.place.beat_offset,
                             {reinterpret_cast<std::uint8_t*>(&pressed.beat), sizeof pressed.beat});
    pressed.count_beat();
    const schema::Type& type = pressed.place.type;
    std::vector<std::uint8_t> bytes(type.size());
    const bool written =
        pressed.store.read(*pressed.place.entry, 0, bytes).ok() && schema::write_field(type, "bEnable", 1.0, bytes) &&
        schema::write_field(type, "eFrame", *frame, bytes) && schema::write_field(type, "dSpeed", speed, bytes) &&
        schema::write_field(type, "nBeat", pressed.beat, bytes) &&
        (*frame != kWorkFrame || schema::write_field(type, "frame", std::string_view(request.frame), bytes)) &&
        pressed.store.write(*pressed.place.entry, 0, bytes).ok();
    if (!written) {
      pressed.release();
      return Problem{"ROBOT_JOG cannot be written"};
    }
    return std::nullopt;
  });
}

bool JogDesk::keep(const std::string& board, const std::string& name, const Client& client) {
  end_overdue();
  return desk_.keep(board, name, client.name, [&client](Hand& hand) -> const char* {
    if (!base::matches_any_variable(client.variables, hand.place.name)) {
      hand.release();
      return "ended: its user may no longer change ROBOT_JOG";
    }
    return hand.send_beat();
  });
}

bool JogDesk::end(const std::string& board, const std::string& name, const std::string& who) {
  return desk_.end(board, name, who, [](Hand& hand) { hand.release(); });
}

void JogDesk::end_overdue() {
  desk_.expire([](Hand& hand) { hand.release(); }, "ended: its client did not renew it in time");
  desk_.check_all([](Hand& hand) { return hand.path ? hand.send_beat() : nullptr; });
}

}  // namespace indurop::serve
