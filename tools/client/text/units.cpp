// SPDX-License-Identifier: Apache-2.0
#include "tools/client/text/units.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <ctime>

#include "core/base/printable.h"
#include "core/base/text.h"
#include "core/rt/clock.h"

namespace indurop::tools {
namespace {

constexpr double kNsPerSecond = 1e9;

struct Unit {
  double scale;
  const char* name;
};

std::string three_digits(double value) {
  if (value >= 99.95) {
    return fmt::format("{:.0f}", value);
  }
  return value >= 9.995 ? fmt::format("{:.1f}", value) : fmt::format("{:.2f}", value);
}

}  // namespace

std::string human_ns(std::int64_t ns) {
  const double magnitude = std::abs(static_cast<double>(ns));
  const char* sign = ns < 0 ? "-" : "";
  if (magnitude < 999.5) {
    return fmt::format("{} ns", ns);
  }
  static constexpr std::array<Unit, 3> kUnits{{{1e3, "us"}, {1e6, "ms"}, {kNsPerSecond, "s"}}};
  for (const auto& unit : kUnits) {
    if (magnitude < unit.scale * 999.5 || unit.scale == kNsPerSecond) {
      return fmt::format("{}{} {}", sign, three_digits(magnitude / unit.scale), unit.name);
    }
  }
  return fmt::format("{} ns", ns);
}

std::string human_age(std::int64_t ns) {
  const double seconds = static_cast<double>(ns) / kNsPerSecond;
  if (seconds < 59.95) {
    return fmt::format("{:.1f} s", seconds);
  }
  const auto whole = static_cast<std::int64_t>(seconds);
  const std::int64_t minutes = whole / 60;
  if (minutes < 60) {
    return fmt::format("{} min {:02} s", minutes, whole % 60);
  }
  const std::int64_t hours = minutes / 60;
  if (hours < 48) {
    return fmt::format("{} h {:02} min", hours, minutes % 60);
  }
  return fmt::format("{} d {} h", hours / 24, hours % 24);
}

std::string human_bytes(std::uint64_t bytes) {
  static constexpr std::array<Unit, 4> kUnits{
      {{1024.0, "KiB"}, {1048576.0, "MiB"}, {1073741824.0, "GiB"}, {1099511627776.0, "TiB"}}};
  if (bytes < 1024) {
    return fmt::format("{} B", bytes);
  }
  const auto value = static_cast<double>(bytes);
  for (const auto& unit : kUnits) {
    if (value < unit.scale * 1023.5 || unit.scale == kUnits.back().scale) {
      return fmt::format("{} {}", three_digits(value / unit.scale), unit.name);
    }
  }
  return fmt::format("{} B", bytes);
}

std::string local_time(std::int64_t wall_ns) {
  const std::time_t seconds = wall_ns / rt::kNanosPerSecond;
  std::tm parts{};
  ::localtime_r(&seconds, &parts);
  char text[32] = "";
  (void)std::strftime(text, sizeof text, "%Y-%m-%d %H:%M:%S", &parts);
  return text;
}

std::string printable(std::string_view text) {
  return base::printable(text);
}

std::size_t display_width(std::string_view text) {
  return base::characters(text);
}

}  // namespace indurop::tools
