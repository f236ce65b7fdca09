// SPDX-License-Identifier: Apache-2.0
#include "tools/client/robot/guided_record.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "tools/client/robot/robot_desk.h"

namespace indurop::tools {
namespace {

constexpr double kLeastWay = 0.5;                       // mm
constexpr std::uint32_t kManual = 2;                    // ROBOT_ARM.eMode
constexpr std::uint32_t kDisabled = 0, kErrorStop = 5;  // ROBOT_MODULE_STATE.eState

std::string name_in(const std::string& space, const char* name) {
  return (space.empty() ? "" : space + "::") + name;
}

// Returns the integer in these bytes, of at most 4 of them.
std::uint32_t integer_of(const std::vector<std::uint8_t>& bytes) {
  std::uint32_t number = 0;
  std::memcpy(&number, bytes.data(), std::min(sizeof number, bytes.size()));
  return number;
}

Result<std::uint32_t, base::Problem> read_integer(const vars::Store& store, const operate::Item& item) {
  const auto bytes = operate::read(store, item);
  if (!bytes) {
    return bytes.error();
  }
  return integer_of(*bytes);
}

}  // namespace

Result<GuidedRecord, base::Problem> GuidedRecord::open(const vars::Store& store, const std::string& space) {
  GuidedRecord out;
  out.space_ = space;
  for (const auto& [item, name] : {std::pair(&out.guiding_, "ROBOT_ARM.bGuided"), {&out.mark_, "ROBOT_GUIDE.nMark"}}) {
    auto found = operate::find(store, name_in(space, name));
    if (!found) {
      return base::Problem{found.error().text + "; robots of earlier releases cannot be guided by hand"};
    }
    *item = std::move(found).value();
  }
  return out;
}

Result<GuidedRecord::News, base::Problem> GuidedRecord::take(const vars::Store& store, bool mark) {
  const auto guided = read_integer(store, guiding_);
  const auto number = read_integer(store, mark_);
  if (!guided || !number) {
    return (guided ? number : guided).error();
  }
  News news;
  news.began = *guided != 0 && !guided_;
  guided_ = *guided != 0;
  const bool marked = mark || (number_ && *number != *number_);
  number_ = *number;
  if (!guided_ || places_.size() >= kMostPlaces) {
    return news;
  }
  const auto place = read_place(store, space_);
  if (!place) {
    return place.error();
  }
  const std::array<double, 3>& tip = place->stand.position;
  const double way = std::hypot(tip[0] - last_[0], tip[1] - last_[1], tip[2] - last_[2]);
  if (places_.empty() || way > kLeastWay) {
    length_ += places_.empty() ? 0 : way;
    last_ = tip;
  }
  tool_ = place->tool;
  places_.push_back({place->stand.joints, marked});
  marks_ += marked ? 1 : 0;
  news.marked = marked;
  news.filled = places_.size() == kMostPlaces;
  return news;
}

std::optional<std::string> why_not_guided(const vars::Store& store, const std::string& space) {
  std::array<std::uint32_t, 3> now{};
  std::size_t number = 0;
  for (const char* const name : {"ROBOT_ARM.eMode", "ROBOT_ARM.bMayMove", "ROBOT_MODULE_STATE.eState"}) {
    const auto item = operate::find(store, name_in(space, name));
    const auto value = item ? read_integer(store, *item) : Result<std::uint32_t, base::Problem>(item.error());
    if (!value) {
      return value.error().text;
    }
    now[number++] = *value;
  }
  const auto [mode, may_move, state] = now;
  if (mode != kManual) {
    return "a hand may guide the robot in manual mode only: " + name_in(space, "ROBOT_MODE") +
           " has to be ROBOT_MODE_MANUAL";
  }
  if (may_move == 0) {
    return "hold the enabling device of manual mode (" + name_in(space, "ROBOT_MODE.bEnable") + ")";
  }
  if (state == kDisabled) {
    return "the drives are disabled: enable the group first (SVC_AD_GROUP_ENABLE)";
  }
  if (state == kErrorStop) {
    return "an error stopped the group: reset it first (SVC_AD_GROUP_RESET)";
  }
  return std::nullopt;
}

}  // namespace indurop::tools
