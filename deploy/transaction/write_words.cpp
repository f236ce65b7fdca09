// SPDX-License-Identifier: Apache-2.0
#include "deploy/transaction/write_words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <utility>

#include "core/base/json.h"
#include "core/base/text.h"

namespace indurop::deploy {

using base::Json;

std::string text_of(const WriteOrder& order) {
  const Json about{
      {"lease", order.lease}, {"renew", order.renew}, {"end", order.end}, {"who", order.who}, {"reason", order.reason}};
  return fmt::format("{} {}\n{}", order.for_ns, about.dump(), fmt::join(order.lines, "\n"));
}

std::string user_of(const WriteOrder& order) {
  return order.who.empty() ? "unknown user" : order.who;
}

std::optional<WriteOrder> parse_write_order(std::string_view text) {
  const auto lines = base::lines_of(std::string(text));
  if (lines.empty()) {
    return std::nullopt;
  }
  WriteOrder order;
  const std::string& head = lines[0];
  const auto [end, error] = std::from_chars(head.data(), head.data() + head.size(), order.for_ns);
  if (error != std::errc() || order.for_ns < 0) {
    return std::nullopt;
  }
  if (const auto about =
          Json::parse(std::string_view(end, static_cast<std::size_t>(head.data() + head.size() - end)))) {
    base::read(*about, "lease", order.lease);
    base::read(*about, "renew", order.renew);
    base::read(*about, "end", order.end);
    base::read(*about, "who", order.who);
    base::read(*about, "reason", order.reason);
  }
  order.lines.assign(lines.begin() + 1, lines.end());
  return order;
}

std::string module_target(const WriteOrder& order, std::string_view release) {
  if (!release.starts_with("0.1.")) {
    return text_of(order);
  }
  return order.lines.empty() ? std::string() : order.lines.front();
}

WriteOrder parse_module_target(std::string_view target) {
  const bool bare = target.find('{') == std::string_view::npos;  // no name of a module has one
  if (auto order = bare ? std::nullopt : parse_write_order(target)) {
    return std::move(*order);
  }
  WriteOrder order;
  if (!target.empty()) {
    order.lines.emplace_back(target);
  }
  return order;
}

}  // namespace indurop::deploy
