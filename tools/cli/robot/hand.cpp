// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/robot/hand.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <optional>

#include "control/robot/files/teach.h"
#include "core/rt/clock.h"
#include "tools/cli/values/forcing.h"
#include "tools/client/node/node_choice.h"
#include "tools/client/process/interrupt.h"

namespace indurop::tools {
namespace {

constexpr int kWorkFrame = 3;  // ROBOT_JOG.eFrame

struct Direction {
  int frame = 0;  // ROBOT_JOG.eFrame
  int index = 0;  // in dSpeed
  double sign = 1;
};

// Returns nothing if it is not a direction.
std::optional<Direction> read_direction(const Hand& hand) {
  constexpr std::array<std::string_view, 6> kTip{"x", "y", "z", "rx", "ry", "rz"};
  std::string word = hand.direction;
  std::transform(word.begin(), word.end(), word.begin(), [](unsigned char c) { return std::tolower(c); });
  if (word.size() < 2 || (word.back() != '+' && word.back() != '-')) {
    return std::nullopt;
  }
  static const std::map<std::string_view, int> kFrames{{"", 1}, {"base", 1}, {"tool", 2}, {"world", 5}};
  const auto frame = kFrames.find(hand.frame);
  Direction out{frame == kFrames.end() ? kWorkFrame : frame->second, 0, word.back() == '+' ? 1.0 : -1.0};
  word.pop_back();
  if (word.size() == 2 && word[0] == 'j' && word[1] >= '1' && word[1] <= '8') {
    out.frame = 0;
    out.index = word[1] - '1';
    return out;
  }
  const auto* const found = std::find(kTip.begin(), kTip.end(), word);
  out.index = static_cast<int>(found - kTip.begin());
  return found == kTip.end() ? std::nullopt : std::optional(out);
}

// Sends the heartbeat to the robot repeatedly. Returns the exit code.
int hold(Context& context, vars::Store& store, const Item& beat, const HeldJog& held) {
  constexpr std::int64_t kBeatNs = 100'000'000;
  constexpr std::int64_t kEachNs = 20'000'000;
  const std::int64_t end = held.for_ns > 0 ? rt::now_ns() + held.for_ns : INT64_MAX;
  std::int64_t next_beat = rt::now_ns() + kBeatNs;
  std::uint32_t number = 1;
  while (rt::now_ns() < end) {
    const std::int64_t next = held.each ? std::min(next_beat, rt::now_ns() + kEachNs) : next_beat;
    if (wait_until(std::min(end, next)) == Woken::Signal) {
      take_interrupt();
      return kOk;
    }
    if (const int code = held.each ? held.each() : kOk; code != kOk) {
      return code;
    }
    if (rt::now_ns() < next_beat) {
      continue;
    }
    next_beat = rt::now_ns() + kBeatNs;
    ++number;
    number += number == 0 ? 1 : 0;
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(&number);
    const auto done = context.values->set(store, beat.name, *beat.entry, beat.place, {bytes, sizeof number});
    if (const std::string absence = context.values->absence(&store); !done || !absence.empty()) {
      return done ? report(context.out, {kUnreachable, context.values->gone(absence)})
                  : report(context.out, done.error());
    }
  }
  return kOk;
}

// A lost client may have left the switch pressed: the robot requires it to be released before it accepts it again.
// Returns the exit code.
int release_before(Context& context, vars::Store& store, const Item& enable, const std::vector<Assignment>& rest) {
  constexpr std::int64_t kPeriodsNs = 100'000'000;  // longer than the period of any robot
  const auto now = operate::read(store, enable);
  if (!now || std::all_of(now->begin(), now->end(), [](std::uint8_t byte) { return byte == 0; })) {
    return kOk;
  }
  if (const int code = set_values(context, store, rest); code != kOk) {
    return code;
  }
  return wait_until(rt::now_ns() + kPeriodsNs) == Woken::Signal ? interrupt_code() : kOk;
}

// Returns whether the robot's files define the work frame; true if they cannot be read, such as those of another host.
bool knows_frame(Context& context, const RobotChoice& choice, const std::string& frame) {
  const auto files = files_of_node(context.node, choice, false);
  const robot::ListedPoints listed = files ? robot::list_points(files->names) : robot::ListedPoints{};
  if (!files || !listed.errors.empty() ||
      std::find(listed.frames.begin(), listed.frames.end(), frame) != listed.frames.end()) {
    return true;
  }
  context.out.error(fmt::format("there is no work frame '{}': base, tool, world{}{}", frame,
                                listed.frames.empty() ? "" : ", ", fmt::join(listed.frames, ", ")));
  return false;
}

}  // namespace

int hold_jog(Context& context, vars::Store& store, const RobotChoice& choice, const HeldJog& held) {
  const std::string name = choice.space + "::ROBOT_JOG";
  std::vector<Item> parts;
  if (const int code = select_items(context, store, {name + ".nBeat", name + ".bEnable"}, parts); code != kOk) {
    return code;
  }
  const auto go = read_assignments(context, store, held.verb.c_str(),
                                   {fmt::format("{}={{bEnable: 1, nBeat: 1, {}}}", name, held.fields)});
  const auto rest = read_assignments(context, store, held.verb.c_str(), {name + ".bEnable=0"});
  if (!go || !rest || any_forced(context, store, *go)) {
    return kFailed;
  }
  if (const int code = release_before(context, store, parts[1], *rest); code != kOk) {
    return code;
  }
  if (const int code = set_values(context, store, *go); code != kOk) {
    return code;
  }
  context.out.note(held.note);
  const int code = hold(context, store, parts[0], held);
  const int ended = set_values(context, store, *rest);
  return code != kOk ? code : ended;
}

int jog(Context& context, const RobotChoice& choice, const Hand& hand) {
  const auto direction = read_direction(hand);
  if (!direction) {
    context.out.error(fmt::format("'{}' is no direction: J1+ to J8-, x+ y+ z+ rx+ ry+ rz+, or with -", hand.direction));
    return kUsage;
  }
  const bool work = direction->frame == kWorkFrame;
  if (work && !knows_frame(context, choice, hand.frame)) {
    return kUsage;
  }
  const std::string name = choice.space + "::ROBOT_JOG";
  auto store = open_store(context, vars::Mode::ReadWrite, {name});
  if (!store) {
    return report(context.out, store.error());
  }
  std::vector<Item> parts;
  if (const int code = select_items(context, *store, {name + ".dSpeed"}, parts); code != kOk) {
    return code;
  }
  const auto count = static_cast<int>(parts[0].place.type.size() / sizeof(double));
  if (direction->index >= count) {
    context.out.error(fmt::format("'{}': {} has {} axes", hand.direction, choice.space, count));
    return kUsage;
  }
  std::string speeds;
  for (int i = 0; i < count; ++i) {
    speeds += fmt::format("{}{}", i == 0 ? "" : ", ", i == direction->index ? direction->sign * hand.percent : 0);
  }
  const std::string frame = work ? fmt::format(", frame: \"{}\"", hand.frame) : "";
  return hold_jog(
      context, *store, choice,
      {"robot jog", fmt::format("eFrame: {}, dSpeed: [{}]{}", direction->frame, speeds, frame),
       fmt::format("{} at {} % while this command runs; Ctrl-C stops", hand.direction, hand.percent), hand.for_ns});
}

}  // namespace indurop::tools
