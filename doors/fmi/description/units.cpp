// SPDX-License-Identifier: Apache-2.0
#include "doors/fmi/description/units.h"

#include <algorithm>
#include <iterator>
#include <numbers>

namespace indurop::fmi {
namespace {

struct KnownUnit {
  std::string_view name;
  UnitInSi unit;
};

constexpr std::array<std::int8_t, 8> kMass{1};
constexpr std::array<std::int8_t, 8> kLength{0, 1};
constexpr std::array<std::int8_t, 8> kTime{0, 0, 1};
constexpr std::array<std::int8_t, 8> kCurrent{0, 0, 0, 1};
constexpr std::array<std::int8_t, 8> kTemperature{0, 0, 0, 0, 1};
constexpr std::array<std::int8_t, 8> kAngle{0, 0, 0, 0, 0, 0, 0, 1};
constexpr std::array<std::int8_t, 8> kNumber{};
constexpr std::array<std::int8_t, 8> kFrequency{0, 0, -1};
constexpr std::array<std::int8_t, 8> kSpeed{0, 1, -1};
constexpr std::array<std::int8_t, 8> kAcceleration{0, 1, -2};
constexpr std::array<std::int8_t, 8> kAngularSpeed{0, 0, -1, 0, 0, 0, 0, 1};
constexpr std::array<std::int8_t, 8> kAngularAcceleration{0, 0, -2, 0, 0, 0, 0, 1};
constexpr std::array<std::int8_t, 8> kForce{1, 1, -2};
constexpr std::array<std::int8_t, 8> kEnergy{1, 2, -2};
constexpr std::array<std::int8_t, 8> kPower{1, 2, -3};
constexpr std::array<std::int8_t, 8> kVoltage{1, 2, -3, -1};
constexpr std::array<std::int8_t, 8> kResistance{1, 2, -3, -2};
constexpr std::array<std::int8_t, 8> kPressure{1, -1, -2};
constexpr double kDegree = std::numbers::pi / 180;
constexpr double kZeroCelsius = 273.15;

constexpr KnownUnit kUnits[] = {
    {"%", {kNumber, 0.01}},
    {"1/min", {kFrequency, 1.0 / 60}},
    {"1/s", {kFrequency}},
    {"A", {kCurrent}},
    {"Hz", {kFrequency}},
    {"J", {kEnergy}},
    {"K", {kTemperature}},
    {"MPa", {kPressure, 1e6}},
    {"N", {kForce}},
    {"N*m", {kEnergy}},
    {"Nm", {kEnergy}},
    {"Ohm", {kResistance}},
    {"Pa", {kPressure}},
    {"V", {kVoltage}},
    {"W", {kPower}},
    {"bar", {kPressure, 1e5}},
    {"cm", {kLength, 0.01}},
    {"deg", {kAngle, kDegree}},
    {"deg/s", {kAngularSpeed, kDegree}},
    {"deg/s2", {kAngularAcceleration, kDegree}},
    {"degC", {kTemperature, 1, kZeroCelsius}},
    {"g", {kMass, 1e-3}},
    {"h", {kTime, 3600}},
    {"hPa", {kPressure, 100}},
    {"kHz", {kFrequency, 1e3}},
    {"kN", {kForce, 1e3}},
    {"kPa", {kPressure, 1e3}},
    {"kW", {kPower, 1e3}},
    {"kg", {kMass}},
    {"km", {kLength, 1e3}},
    {"kV", {kVoltage, 1e3}},
    {"m", {kLength}},
    {"m/s", {kSpeed}},
    {"m/s2", {kAcceleration}},
    {"m/s^2", {kAcceleration}},
    {"mA", {kCurrent, 1e-3}},
    {"mV", {kVoltage, 1e-3}},
    {"mW", {kPower, 1e-3}},
    {"mbar", {kPressure, 100}},
    {"min", {kTime, 60}},
    {"mm", {kLength, 1e-3}},
    {"mm/s", {kSpeed, 1e-3}},
    {"mm/s2", {kAcceleration, 1e-3}},
    {"mm/s^2", {kAcceleration, 1e-3}},
    {"ms", {kTime, 1e-3}},
    {"ns", {kTime, 1e-9}},
    {"rad", {kAngle}},
    {"rad/s", {kAngularSpeed}},
    {"rad/s2", {kAngularAcceleration}},
    {"rad/s^2", {kAngularAcceleration}},
    {"s", {kTime}},
    {"um", {kLength, 1e-6}},
    {"us", {kTime, 1e-6}},
    {"\u00b0", {kAngle, kDegree}},
    {"\u00b0C", {kTemperature, 1, kZeroCelsius}},
};

}  // namespace

std::optional<UnitInSi> unit_in_si(std::string_view unit) {
  const auto* const found =
      std::find_if(std::begin(kUnits), std::end(kUnits), [unit](const KnownUnit& one) { return one.name == unit; });
  return found == std::end(kUnits) ? std::nullopt : std::optional(found->unit);
}

}  // namespace indurop::fmi
