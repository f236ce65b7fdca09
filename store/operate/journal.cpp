// SPDX-License-Identifier: Apache-2.0
#include "store/operate/journal.h"

#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <utility>

#include "core/base/line_journal.h"
#include "core/base/user_name.h"
#include "core/rt/clock.h"
#include "store/vars/retain.h"

namespace indurop::operate {
namespace {

constexpr std::uintmax_t kMaxBytes = std::uintmax_t{1} << 20U;

std::filesystem::path file_of(const std::string& node) {
  return vars::state_directory(node) / "orders.jsonl";
}

// The address from which this user is logged in, else the name of this machine.
std::string origin() {
  const char* connection = std::getenv("SSH_CONNECTION");
  if (connection != nullptr && *connection != '\0') {
    const std::string_view words(connection);
    return std::string(words.substr(0, words.find(' ')));
  }
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

}  // namespace

void note(const std::string& node, Order order) {
  order.wall_ns = rt::wall_ns();
  if (order.who.empty()) {
    order.who = base::user_name();
    order.from = origin();
  }
  constexpr mode_t kMode = S_IRUSR | S_IWUSR | S_IRGRP | S_IWGRP | S_IROTH;
  (void)base::append_line({file_of(node), kMaxBytes, kMode, base::Durable::No}, json_of(order).dump());
}

std::vector<Order> read_orders(const std::string& node, std::int64_t since_wall_ns) {
  std::vector<Order> all;
  base::each_line(file_of(node), [&](std::string_view line) {
    Order order;
    const auto json = base::Json::parse(line);
    if (json && read_order(*json, order) && order.wall_ns >= since_wall_ns) {
      all.push_back(std::move(order));
    }
  });
  return all;
}

base::Json json_of(const Order& order) {
  return {{"node_ns", order.node_ns}, {"wall_ns", order.wall_ns},   {"who", order.who},
          {"from", order.from},       {"action", order.action},     {"what", order.what},
          {"value", order.value},     {"until_ns", order.until_ns}, {"reason", order.reason}};
}

bool read_order(const base::Json& json, Order& order) {
  base::read(json, "node_ns", order.node_ns);
  base::read(json, "wall_ns", order.wall_ns);
  base::read(json, "who", order.who);
  base::read(json, "from", order.from);
  base::read(json, "action", order.action);
  base::read(json, "what", order.what);
  base::read(json, "value", order.value);
  base::read(json, "until_ns", order.until_ns);
  base::read(json, "reason", order.reason);
  return !order.action.empty();
}

}  // namespace indurop::operate
