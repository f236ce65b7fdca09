// SPDX-License-Identifier: Apache-2.0
// A board without modules: a store with some variables, and its mirror. Runs until SIGTERM.
//   mirror_board NODE BOARD DOMAIN one-host|network LEASE_MS VARIANT OTHER,OTHER... OUT,OUT... VARIABLE@OWNER,...
//   [KEYS]
// A "-" stands for an empty list. VARIANT: which of two schemas (see make_schema). KEYS: folder of the board's keys.

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "board_schema.h"
#include "mirror/mirror.h"

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
  indurop::mirror::Settings settings;
  settings.plant = "testplant";
  settings.board = argv[2];
  settings.domain = std::atoi(argv[3]);
  settings.one_host = std::string(argv[4]) == "one-host";
  settings.lease_ns = std::atoll(argv[5]) * 1'000'000;
  settings.boards = split(argv[7]);
  for (const std::string& name : split(argv[8])) {
    settings.outgoing.push_back({name, 0, name.ends_with("loose")});
  }
  for (const std::string& name : split(argv[9])) {
    const std::size_t at = name.find('@');
    settings.incoming.push_back({name.substr(0, at), name.substr(at + 1)});
  }
  if (argc == 11) {
    const std::string keys = argv[10];
    settings.security = {keys + "/ca.pem",         keys + "/identity.pem",    keys + "/identity.key",
                         keys + "/governance.p7s", keys + "/permissions.p7s", keys + "/revoked.pem"};
  }
  const std::atomic<std::uint64_t> tick{7};
  auto mirror = indurop::mirror::Mirror::start(settings, argv[1], store.value(), tick);
  if (!mirror) {
    std::fprintf(stderr, "mirror: %s\n", mirror.error().where);
    return 1;
  }
  int got = 0;
  sigwait(&stop, &got);
  return 0;
}
