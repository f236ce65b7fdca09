// SPDX-License-Identifier: Apache-2.0
// A board without modules: a store with some variables, and its mirror. Runs until SIGTERM.
//   mirror_board NODE BOARD DOMAIN one-host|network LEASE_MS VARIANT OTHER,OTHER... OUT,OUT... VARIABLE@OWNER,...
//   [KEYS]
// A "-" stands for an empty list. VARIANT: which schema (see make_schema); "ticking": all outgoing variables are
// written in every millisecond, as a module does, with the number of the tick. KEYS: folder of the board's keys.

#include <array>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "board_schema.h"
#include "core/rt/clock.h"
#include "network/mirror/frames/mirror.h"

namespace {

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts;
  if (text == "-") {
    return parts;
  }
  std::size_t from = 0;
  for (std::size_t to = 0; to != std::string::npos; from = to + 1) {
    to = text.find(',', from);
    parts.push_back(text.substr(from, to == std::string::npos ? to : to - from));
  }
  return parts;
}

// What a band with one module looks like to the mirror.
class Ticking {
 public:
  Ticking(indurop::vars::Store& store, const std::vector<indurop::mirror::Outgoing>& variables) : store_(store) {
    for (const auto& out : variables) {
      entries_.push_back(store.find(indurop::abi::fnv1a64(out.variable.data(), out.variable.size())));
    }
  }
  [[nodiscard]] std::uint64_t runs() const { return runs_.load(std::memory_order_acquire); }
  void run(std::uint64_t tick) {
    runs_.fetch_add(1);
    const std::array<std::uint64_t, 2> value{tick, tick};
    std::array<std::uint8_t, sizeof value> bytes{};
    std::memcpy(bytes.data(), value.data(), sizeof value);
    for (const auto* entry : entries_) {
      (void)store_.write(*entry, 0, bytes);
    }
    runs_.fetch_add(1);
  }

 private:
  indurop::vars::Store& store_;
  std::vector<const indurop::vars::DirectoryEntry*> entries_;
  std::atomic<std::uint64_t> runs_{0};
};

indurop::mirror::Settings read_settings(int argc, char** argv) {
  indurop::mirror::Settings settings;
  settings.plant = "testplant";
  settings.network.board = argv[2];
  settings.network.domain = std::atoi(argv[3]);
  settings.network.one_host = std::string(argv[4]) == "one-host";
  settings.network.lease_ns = std::atoll(argv[5]) * 1'000'000;
  settings.boards = split(argv[7]);
  for (const std::string& name : split(argv[8])) {
    settings.routes.outgoing.push_back({name, 0, name.ends_with("loose")});
  }
  for (const std::string& name : split(argv[9])) {
    const std::size_t at = name.find('@');
    settings.routes.incoming.push_back({name.substr(0, at), name.substr(at + 1)});
  }
  if (argc == 11) {
    const std::string keys = argv[10];
    settings.network.security = {keys + "/ca.pem",         keys + "/identity.pem",    keys + "/identity.key",
                                 keys + "/governance.p7s", keys + "/permissions.p7s", keys + "/revoked.pem"};
  }
  return settings;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 10 && argc != 11) {
    return 2;
  }
  sigset_t stop;
  sigemptyset(&stop);
  sigaddset(&stop, SIGTERM);
  sigaddset(&stop, SIGINT);
  sigprocmask(SIG_BLOCK, &stop, nullptr);

  auto store = indurop::vars::Store::create(argv[1], indurop::test::make_schema(argv[6]));
  if (!store) {
    std::fprintf(stderr, "store: %s\n", store.error().where);
    return 1;
  }
  indurop::mirror::Settings settings = read_settings(argc, argv);
  std::atomic<std::uint64_t> tick{7};
  Ticking module(store.value(), settings.routes.outgoing);
  const bool ticking = std::string(argv[6]) == "ticking" && !settings.routes.outgoing.empty();
  if (ticking) {
    settings.routes.writers.push_back({[&] { return module.runs(); }, true});
    for (auto& out : settings.routes.outgoing) {
      out.writers = 0;
    }
    module.run(tick);
  }
  auto mirror = indurop::mirror::Mirror::start(settings, argv[1], store.value(), tick);
  if (!mirror) {
    std::fprintf(stderr, "mirror: %s\n", mirror.error().where);
    return 1;
  }
  constexpr std::int64_t kPeriodNs = 1'000'000;
  for (std::int64_t next = indurop::rt::now_ns();; next += kPeriodNs) {
    const timespec wait{0, ticking ? 0 : 100 * kPeriodNs};
    if (sigtimedwait(&stop, nullptr, &wait) > 0) {
      return 0;
    }
    if (ticking) {
      indurop::rt::sleep_until(next);
      module.run(++tick);
      mirror.value().notify();
    }
  }
}
