// SPDX-License-Identifier: Apache-2.0
#include "explain/orders.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "base/descriptor.h"
#include "base/read_file.h"
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

std::filesystem::path before(const std::filesystem::path& file) {
  return file.string() + ".1";
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

void read_lines(const std::filesystem::path& file, std::int64_t since_ns, std::vector<OrderFact>& to) {
  const auto text = base::read_file(file);
  std::string_view rest = text ? std::string_view(*text) : std::string_view();
  while (!rest.empty()) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(line.size() + 1, rest.size()));
    OrderFact order;
    const auto json = base::Json::parse(line);
    if (json && read_order(*json, order) && order.wall_ns >= since_ns) {
      to.push_back(std::move(order));
    }
  }
}

}  // namespace

void note_order(const std::string& node, OrderFact order) {
  order.wall_ns = rt::wall_ns();
  if (order.who.empty()) {
    order.who = base::user_name();
    order.from = origin();
  }
  const std::filesystem::path file = file_of(node);
  std::error_code error;
  std::filesystem::create_directories(file.parent_path(), error);
  if (const auto size = std::filesystem::file_size(file, error); !error && size > kMostBytes) {
    std::filesystem::rename(file, before(file), error);
  }
  const base::Descriptor descriptor(
      ::open(file.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, S_IRUSR | S_IWUSR | S_IRGRP | S_IWGRP | S_IROTH));
  const std::string line = json_of(order).dump() + "\n";
  if (descriptor.get() >= 0) {
    (void)!::write(descriptor.get(), line.data(), line.size());
  }
}

std::vector<OrderFact> read_orders(const std::string& node, std::int64_t since_wall_ns) {
  std::vector<OrderFact> all;
  read_lines(before(file_of(node)), since_wall_ns, all);
  read_lines(file_of(node), since_wall_ns, all);
  return all;
}

}  // namespace indurop::explain
