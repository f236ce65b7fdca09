// SPDX-License-Identifier: Apache-2.0
#include "control/robot/group/axis_row.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "control/robot/path/rates.h"

namespace indurop::robot {

namespace {

AxisControl::Scale scale_of(const Settings& settings, const Axis& axis, std::size_t i) noexcept {
  const auto own = [i](const std::vector<double>& values) { return values.size() > 1 ? values[i] : values[0]; };
  const double counts = axis.slides() ? own(settings.counts_per_mm) * 1000 : own(settings.counts_per_turn) / (2 * kPi);
  return {counts, own(settings.gear), axis.slides(), own(settings.zero) * (axis.slides() ? 0.001 : kPi / 180)};
}

}  // namespace

AxisRow::AxisRow(const GroupParts& parts, CommandTable& table, const ToolTravel* travel) noexcept
    : limits_(travel != nullptr ? parts.single_limits : parts.joints),
      period_(std::chrono::duration<double>(parts.settings.period).count()),
      following_limit_(parts.settings.following_limit),
      count_(travel != nullptr ? static_cast<int>(parts.singles.size()) : parts.arm.count()) {
  const Settings& settings = parts.settings;
  const auto count = static_cast<std::size_t>(count_);
  const int first = travel != nullptr ? parts.arm.count() : 0;
  for (int i = 0; i < count_; ++i) {
    const LineLimits limits = limits_of_axis(limits_, i);
    const Axis& axis = travel != nullptr ? parts.singles[at(i)] : parts.arm.axis(i);
    axes_[at(i)].set_up(axis, limits, scale_of(settings, axis, at(first + i)), settings.absolute, &table,
                        {{axes_.data(), count}, {gates_.data(), count}, cams_, &profiles_, i, first, travel});
    gates_[at(i)] = SetPointGate({axis.lowest(), axis.highest()}, limits, period_);
  }
}

Joints AxisRow::commanded() const noexcept {
  Joints q = Joints::Zero();
  for (int i = 0; i < count_; ++i) {
    q[i] = axes_[at(i)].commanded().position;
  }
  return q;
}

Joints AxisRow::measured() const noexcept {
  Joints q = Joints::Zero();
  for (int i = 0; i < count_; ++i) {
    q[i] = axes_[at(i)].measured();
  }
  return q;
}

Joints AxisRow::passed() const noexcept {
  Joints q = Joints::Zero();
  for (int i = 0; i < count_; ++i) {
    q[i] = gates_[at(i)].state().position;
  }
  return q;
}

Joints AxisRow::from_users(const double* numbers) const noexcept {
  Joints q = Joints::Zero();
  for (int i = 0; i < count_; ++i) {
    q[i] = axes_[at(i)].units().from_users(numbers[i]);
  }
  return q;
}

bool AxisRow::any_busy() const noexcept {
  return std::any_of(begin(), end(), [](const AxisControl& a) { return a.busy(); });
}

bool AxisRow::any_enabled() const noexcept {
  return std::any_of(begin(), end(), [](const AxisControl& a) { return a.drive().enabled(); });
}

bool AxisRow::any_wants_power() const noexcept {
  return std::any_of(begin(), end(), [](const AxisControl& a) { return a.wants_power(); });
}

bool AxisRow::any_displaced() const noexcept {
  return std::any_of(begin(), end(), [](const AxisControl& a) { return a.displaced(); });
}

bool AxisRow::any_pushes() const noexcept {
  return std::any_of(begin(), end(), [](const AxisControl& a) { return a.pushes(); });
}

bool AxisRow::all_enabled() const noexcept {
  return std::all_of(begin(), end(), [](const AxisControl& a) { return a.drive().enabled(); });
}

bool AxisRow::all_homed() const noexcept {
  return std::all_of(begin(), end(), [](const AxisControl& a) { return a.homed(); });
}

bool AxisRow::all_failed() const noexcept {
  return std::all_of(begin(), end(), [](const AxisControl& a) { return a.state() == AxisState::ErrorStop; });
}

bool AxisRow::at_rest() const noexcept {
  return std::all_of(begin(), end(), [](const AxisControl& a) { return a.at_rest(); });
}

bool AxisRow::gates_at_rest() const noexcept {
  return std::all_of(gates_.begin(), gates_.end(), [](const SetPointGate& g) { return g.at_rest(); });
}

void AxisRow::move() noexcept {
  std::array<bool, kAxes> moved{};
  for (int left = count_; left > 0;) {
    for (int i = 0; i < count_; ++i) {
      AxisControl& a = axes_[at(i)];
      const auto waits = [&moved](const AxisControl::Leader& leader) { return !moved[at(leader.axis)]; };
      if (moved[at(i)] || std::any_of(a.leaders().begin(), a.leaders().end(), waits)) {
        continue;
      }
      moved[at(i)] = true;
      --left;
      if (!a.in_group()) {
        a.move(period_);
      }
    }
  }
}

bool AxisRow::is_behind(const AxisControl& a) const noexcept {
  const double behind = std::abs(a.commanded().position - a.measured());
  return a.state() != AxisState::Homing && !a.pushes() && behind > a.unit() * following_limit_;
}

int AxisRow::first_behind() const noexcept {
  const auto* const found = std::find_if(begin(), end(), [this](const AxisControl& a) { return is_behind(a); });
  return found == end() ? -1 : static_cast<int>(found - begin());
}

void AxisRow::fail_behind() noexcept {
  for (AxisControl& a : *this) {
    if (a.state() != AxisState::ErrorStop && is_behind(a)) {
      a.fail(ErrorCode::Following, 1);
    }
  }
}

void AxisRow::end_group_motion() noexcept {
  for (AxisControl& a : *this) {
    if (a.in_group()) {
      a.rest();
      a.reset();
    }
  }
}

void AxisRow::halt() noexcept {
  for (AxisControl& a : *this) {
    a.halt();
  }
}

void AxisRow::power(bool on) noexcept {
  for (AxisControl& a : *this) {
    a.power(on);
  }
}

void AxisRow::give_up_power() noexcept {
  for (AxisControl& a : *this) {
    a.give_up_power();
  }
}

double AxisRow::stops(std::array<Profile, kAxes>& stops) const noexcept {
  double longest = 0;
  for (int i = 0; i < count_; ++i) {
    const LineLimits limits = limits_of_axis(limits_, i);
    stops[at(i)] = Profile::to_velocity(axes_[at(i)].commanded(), 0, limits);
    longest = std::max(longest, stops[at(i)].duration());
  }
  return longest;
}

ErrorCode AxisRow::set_cam(int number, const CamTables& cams, bool periodic) noexcept {
  if (number < 0 || number >= static_cast<int>(kCams)) {
    return ErrorCode::Value;
  }
  return cams_[at(number)].set(cams[at(number)], periodic);
}

}  // namespace indurop::robot
