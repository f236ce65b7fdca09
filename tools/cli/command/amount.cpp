// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/command/amount.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cstddef>
#include <string_view>
#include <utility>

#include "core/base/duration.h"

namespace indurop::tools {
namespace {

constexpr std::uint64_t kThousand = 1000;
constexpr std::array<std::pair<std::string_view, std::uint64_t>, 5> kUnits{{{"kB", kThousand},
                                                                            {"MB", kThousand* kThousand},
                                                                            {"GB", kThousand* kThousand* kThousand},
                                                                            {"MiB", std::uint64_t{1} << 20U},
                                                                            {"GiB", std::uint64_t{1} << 30U}}};
constexpr std::uint64_t kLeastBytes = 100 * kThousand;  // the data in front of the first run has to fit
constexpr double kMostBytes = 1e18;

}  // namespace

std::string read_amount(const std::string& text, std::int64_t& time_ns, std::uint64_t& bytes) {
  for (const auto& [unit, factor] : kUnits) {
    if (!text.ends_with(unit)) {
      continue;
    }
    std::string number = text.substr(0, text.size() - unit.size());
    number.erase(number.find_last_not_of(' ') + 1);
    double value = 0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
    const double amount = value * static_cast<double>(factor);
    if (error != std::errc() || end != number.data() + number.size() || !(amount >= static_cast<double>(kLeastBytes)) ||
        amount > kMostBytes) {
      return fmt::format("'{}' is no size: use 100kB or more, as 100MB or 2GB", text);
    }
    bytes = static_cast<std::uint64_t>(amount);
    time_ns = 0;
    return "";
  }
  const base::DurationText time = base::read_duration(text, false, base::PlainNumber::Seconds);
  if (!time.value) {
    return fmt::format("'{}' is neither a time nor a size: use 10min or 100MB", text);
  }
  time_ns = time.value->count();
  bytes = 0;
  return "";
}

base::Option add_amount_option(base::Options& app, const std::string& names, std::int64_t& time_ns,
                               std::uint64_t& bytes, const std::string& help) {
  const auto take = [&time_ns, &bytes](const std::string& text) { return read_amount(text, time_ns, bytes); };
  return app.add(names, "TIME|SIZE", take, help);
}

}  // namespace indurop::tools
