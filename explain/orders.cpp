// SPDX-License-Identifier: Apache-2.0
#include "explain/orders.h"

#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <string_view>

#include "base/line_journal.h"
#include "base/user_name.h"
#include "explain/facts_json.h"
#include "rt/clock.h"
#include "vars/retain.h"

namespace indurop::explain {
namespace {

constexpr std::uintmax_t kMostBytes = std::uintmax_t{1} << 20U;

std::filesystem::path file_of(const std::string& node) {
  return vars::state_directory(node) / "orders.jsonl";
}

// The address somebody came from, else this machine.
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

void note_order(const std::string& node, OrderFact order) {
  order.wall_ns = rt::wall_ns();
  if (order.who.empty()) {
    order.who = base::user_name();
    order.from = origin();
  }
  constexpr mode_t kMode = S_IRUSR | S_IWUSR | S_IRGRP | S_IWGRP | S_IROTH;
  (void)base::append_line({file_of(node), kMostBytes, kMode, base::Durable::No}, json_of(order).dump());
}

std::vector<OrderFact> read_orders(const std::string& node, std::int64_t since_wall_ns) {
  std::vector<OrderFact> all;
  base::each_line(file_of(node), [&](std::string_view line) {
    OrderFact order;
    const auto json = base::Json::parse(line);
    if (json && read_order(*json, order) && order.wall_ns >= since_wall_ns) {
      all.push_back(std::move(order));
    }
  });
  return all;
}

}  // namespace indurop::explain
