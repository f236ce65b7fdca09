// SPDX-License-Identifier: Apache-2.0
#include "serve/server.h"

#include <fmt/format.h>

#include <cstdio>

#include "base/exit_code.h"
#include "rt/clock.h"
#include "serve/api/router.h"
#include "tools/command/interrupt.h"

namespace indurop::serve {
namespace {

std::int64_t wall_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch())
      .count();
}

ServerFacts facts_of(const tools::ServeOptions& options, std::string version) {
  ServerFacts facts;
  facts.version = std::move(version);
  facts.most_clients = options.clients;
  facts.started_wall_ns = wall_ns();
  facts.started_ns = rt::now_ns();
  facts.clients = [] { return std::vector<ClientFigures>(); };
  return facts;
}

}  // namespace

Server::Server(tools::ServeOptions options, GateSettings gate, std::string version)
    : options_(std::move(options)), gate_(std::move(gate)), api_(gate_, facts_of(options_, std::move(version))) {}

std::optional<Reply> Server::answer(const Request& request, Ticket /*ticket*/) {
  Match match = match_route(all_routes(), request);
  if (match.route == nullptr) {
    return match.other_method ? refusal(status::kMethodNotAllowed, "this path is for another method")
                              : refusal(status::kNotFound, "there is nothing at this path");
  }
  match.call.who = gate_.who(request);
  return match.route->answer(api_, match.call);
}

std::unique_ptr<Visitor> Server::receive(const Request& /*request*/, Line& /*line*/) {
  return nullptr;
}

int Server::run() {
  DoorSettings settings;
  settings.bind = options_.bind;
  settings.port = static_cast<int>(options_.port);
  settings.cert = options_.cert;
  settings.key = options_.key;
  settings.client_ca = options_.client_ca;
  settings.most_streams = options_.clients;
  auto opened = Door::open(settings, *this);
  if (!opened) {
    fmt::print(stderr, "indurop-serve: error: {}\n", opened.error().text);
    return kFailed;
  }
  door_ = std::move(opened).value();
  const std::string token = gate_.settings().tokens.empty() || !options_.token_file.empty()
                                ? ""
                                : "#token=" + gate_.settings().tokens[0].value;
  fmt::print("{}://{}:{}/{}\n", gate_.settings().tls ? "https" : "http", options_.bind, door_->port(), token);
  (void)std::fflush(stdout);
  Door::Alarm housekeeping(*door_, [] {});
  constexpr std::int64_t kHousekeepingNs = 500'000'000;
  door_->serve([&] {
    housekeeping.set(kHousekeepingNs);
    return tools::interrupted();
  });
  return tools::interrupt_code();
}

}  // namespace indurop::serve
