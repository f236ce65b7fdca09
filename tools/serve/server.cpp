// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/server.h"

#include <fmt/format.h>

#include <cstdio>
#include <utility>

#include "core/base/exit_code.h"
#include "core/base/print.h"
#include "core/rt/clock.h"
#include "tools/client/process/gentle.h"
#include "tools/client/process/interrupt.h"
#include "tools/serve/api/answers.h"

namespace indurop::serve {
namespace {

ServerFacts facts_of(const tools::ServeOptions& options, const std::string& version, const AlarmDesk& alarms,
                     std::function<std::vector<ClientFigures>()> clients,
                     std::function<std::optional<Reply>(Request&)> refuse) {
  ServerFacts facts;
  facts.alarms = [&alarms](const std::string& board) { return alarms.counts(board); };
  facts.version = version;
  facts.clients = std::move(clients);
  facts.refuse = std::move(refuse);
  facts.most_clients = options.clients;
  facts.started_wall_ns = rt::wall_ns();
  facts.started_ns = rt::now_ns();
  facts.web = Page(options.web).there();
  facts.plant = options.plant;
  facts.recordings = options.recordings;
  facts.plc = !options.plc.empty();
  facts.metrics = options.metrics;
  facts.calls = options.calls;
  return facts;
}

DoorSettings door_of(const tools::ServeOptions& options, const AccessGateSettings& gate) {
  DoorSettings settings;
  settings.bind = options.bind;
  settings.port = static_cast<int>(options.port);
  settings.cert = options.cert;
  settings.key = options.key;
  settings.client_ca = options.client_ca;
  settings.most_streams = options.clients;
  settings.reserve_streams =
      gate.loopback && (!gate.tokens.empty() || !options.client_ca.empty() || !options.users.empty());
  return settings;
}

}  // namespace

Server::Server(tools::ServeOptions options, Admission admission, const std::string& version)
    : options_(std::move(options)),
      users_(options_.users, &rt::now_ns),
      gate_(std::move(admission.gate), &users_),
      authority_(std::move(admission.authority)),
      audit_(options_.audit.empty() ? operate::usual_audit_file() : options_.audit),
      leases_(audit_, options_.link),
      jogs_(audit_),
      api_(gate_, users_, audit_, leases_, jogs_,
           facts_of(
               options_, version, alarms_, [this] { return hub_.clients(); },
               [this](Request& request) { return refuse_now(request); })),
      page_(options_.web),
      boards_(options_.node, &remote_boards_),
      hub_(boards_, version, {options_.foxglove, options_.foxglove_hz},
           [this](std::int64_t after_ns) { sampling_->set(after_ns); }),
      files_(options_.node, &remote_boards_, kFilesReader),
      orders_(options_.node),
      holds_(options_.node),
      history_(options_.node),
      calls_(options_.node),
      replays_(options_.node) {}

std::string Server::choose_subprotocol(const Request& request) {
  return serve::choose_subprotocol(all_routes(), request);
}

Client Server::identify(const std::string& certificate) {
  Client client = authority_.identify(certificate);
  const ClientCertificates::Holder holder = ClientCertificates::holder_of(certificate);
  if (!client.refusal.empty() || holder == ClientCertificates::Holder::Participant) {
    return client;
  }
  // Who is removed from the list must not get more rights by that: the list says what clients of an authority may that
  // knows nothing of the plant.
  const Role unlisted = holder == ClientCertificates::Holder::Stranger ? Role::Look : client.role;
  return users_.client_certified(std::move(client), unlisted);
}

std::optional<Reply> Server::refuse_now(Request& request) {
  request.certificate = request.certificate_pem.empty() ? Client{} : identify(request.certificate_pem);
  return refuse(request);
}

std::optional<Reply> Server::refuse(Request& request) {
  request.client = gate_.client_of(request);
  if (auto refused = gate_.refuse(request, needed_for(all_routes(), request))) {
    return refused;
  }
  if (!request.subprotocol.empty() && match_route(all_routes(), request).route == nullptr) {
    return refusal(status::kNotFound, "the WebSocket is at /api/v1/stream");
  }
  return std::nullopt;
}

void Server::note_refused(const Request& request, const std::string& why, std::uint64_t count) {
  AuditEntry entry;
  entry.who = request.client.name.empty() ? request.certificate.name : request.client.name;
  entry.from = request.from;
  entry.action = "refused";
  entry.what = request.path;
  entry.outcome = count > 1 ? fmt::format("{} ({} times)", why, count) : why;
  audit_.note_soon(std::move(entry));
}

std::optional<Reply> Server::answer(const Request& request, Ticket ticket) {
  Match match = match_route(all_routes(), request);
  if (match.route == nullptr) {
    return match.other_method ? refusal(status::kMethodNotAllowed, "this path is for another method")
                              : refusal(status::kNotFound, "there is nothing at this path; see /api/v1/openapi.json");
  }
  match.call.who = request.client.name;
  if (match.route->remote != Remote::Same && is_remote(match)) {
    return ask_remote(std::move(match), ticket);
  }
  switch (match.route->pace) {
    case Pace::Files:
      return hand_over(files_, std::move(match), ticket);
    case Pace::SignIn:
      return try_to_sign_in(std::move(match), ticket);
    case Pace::Orders:
      return hand_over(orders_, std::move(match), ticket);
    case Pace::Holds:
      return hand_over(holds_, std::move(match), ticket);
    case Pace::History:
      return hand_over(history_, std::move(match), ticket);
    case Pace::Calls:
      return hand_over(calls_, std::move(match), ticket);
    case Pace::Replays:
      return hand_over(replays_, std::move(match), ticket);
    case Pace::Wait:
      return let_wait(match, ticket);
    case Pace::Plant:
      return ask_plant(std::move(match), ticket);
    case Pace::PlantOrders:
      return order_plant(std::move(match), ticket);
    case Pace::Plc:
      return ask_plc(std::move(match), ticket);
    case Pace::Page:
      return page_.answer(request.path);
    case Pace::Stream:
    case Pace::Quick:
      break;
  }
  match.call.boards = &boards_;
  return answered(match);
}

Reply Server::answered(const Match& match) {
  return match.route->answer(api_, match.call);
}

std::function<void()> Server::job_of(Match match, Ticket ticket, Answer answer) {
  const auto request = std::make_shared<Request>(*match.call.request);
  match.call.request = request.get();
  return [this, request, match = std::move(match), ticket, answer = std::move(answer)] {
    door_->reply(ticket, answer ? answer(match) : answered(match));
  };
}

std::optional<Reply> Server::hand_over(Worker& worker, Match match, Ticket ticket, Answer answer) {
  if (!worker.add(job_of(std::move(match), ticket, std::move(answer)))) {
    return refusal(status::kUnavailable, "too many requests wait already; try again later");
  }
  return std::nullopt;
}

std::optional<Reply> Server::hand_over(Helper& helper, Match match, Ticket ticket) {
  match.call.boards = &helper.boards;
  return hand_over(helper.worker, std::move(match), ticket);
}

std::optional<Reply> Server::try_to_sign_in(Match match, Ticket ticket) {
  const Request& request = *match.call.request;
  std::string user = answers::user_who_signs_in(request).value_or("");
  if (!users_.client_named(user)) {
    user.clear();  // names that exist are limited one by one, all others together
  }
  const auto attempt = sign_in_.limit.begin(request.from, user, rt::now_ns());
  if (!attempt) {
    return refusal(status::kUnavailable, "too many attempts to sign in from this address; try again in a few seconds");
  }
  auto refused = hand_over(sign_in_.worker, std::move(match), ticket, [this, attempt = *attempt](const Match& own) {
    Reply reply = answered(own);
    sign_in_.limit.end(attempt, !reply.wrong_credentials.empty(), rt::now_ns());
    return reply;
  });
  if (refused) {
    sign_in_.limit.end(*attempt, false, rt::now_ns());
  }
  return refused;
}

std::optional<Reply> Server::ask_plant(Match match, Ticket ticket) {
  if (plant_ == nullptr) {
    return refusal(status::kNotFound, "this server shows its own host only; start it with --plant");
  }
  match.call.plant = &plant_->watch;
  return hand_over(plant_->worker, std::move(match), ticket);
}

bool Server::is_remote(const Match& match) const {
  const auto board = match.call.part.find("board");
  return plant_ != nullptr && board != match.call.part.end() &&
         (options_.node.empty() || board->second == options_.node) && remote_boards_.find(board->second) != nullptr;
}

std::optional<Reply> Server::ask_remote(Match match, Ticket ticket) {
  const Remote remote = match.route->remote;
  const std::string board = match.call.part.find("board")->second;
  if (remote == Remote::No) {
    return refusal(status::kConflict,
                   fmt::format("board {} is on another host, where this is seen: indurop serve there", board));
  }
  if (match.route->pace == Pace::Quick && remote == Remote::Reported) {
    match.call.boards = &boards_;
    return answered(match);
  }
  match.call.boards = &plant_->boards;
  return hand_over(plant_->worker, std::move(match), ticket, [this, remote, board](const Match& own) {
    if (remote == Remote::Reported) {
      remote_boards_.fetch(plant_->watch, board);
    }
    return answered(own);
  });
}

std::optional<Reply> Server::order_plant(Match match, Ticket ticket) {
  if (plant_ == nullptr) {
    return refusal(status::kNotFound, "this server shows its own host only; start it with --plant");
  }
  match.call.link = &options_.link;
  if (!plant_->orders.add_if_idle(job_of(std::move(match), ticket))) {
    return refusal(status::kConflict, "the plant is being changed already");
  }
  return std::nullopt;
}

std::optional<Reply> Server::ask_plc(Match match, Ticket ticket) {
  if (plc_ == nullptr) {
    return refusal(status::kNotFound, "this server knows no PLC program; start it with --plc FILE");
  }
  match.call.boards = &plc_->boards;
  match.call.plc = &plc_->pictures;
  return hand_over(plc_->worker, std::move(match), ticket);
}

std::optional<Reply> Server::let_wait(const Match& match, Ticket ticket) {
  constexpr std::size_t kMaxScopes = 4;
  for (std::size_t i = 0; i < kMaxScopes; ++i) {
    if (i == waiting_.size()) {
      waiting_.push_back(std::make_unique<Helper>(options_.node));
    }
    Match own = match;
    own.call.boards = &waiting_[i]->boards;
    if (waiting_[i]->worker.add_if_idle(job_of(std::move(own), ticket))) {
      return std::nullopt;
    }
  }
  return refusal(status::kUnavailable,
                 fmt::format("{} scopes wait for their triggers already; try again later", kMaxScopes));
}

std::unique_ptr<Visitor> Server::receive(const Request& request, Line& line) {
  return hub_.receive(request, line);
}

void Server::announce() const {
  const AccessGateSettings& gate = gate_.settings();
  // A token that is in no file can be obtained from this output only.
  const bool shown = !gate.tokens.empty() && options_.token_file.empty();
  base::print(stdout, "{}://{}:{}/{}\n", gate.tls ? "https" : "http", options_.bind, door_->port(),
              shown ? "#token=" + gate.tokens.front().value : "");
  (void)std::fflush(stdout);
}

int Server::run() {
  auto programs = tools::plc_programs(options_.plc);
  if (!programs) {
    base::print(stderr, "indurop-serve: error: {}\n", programs.error().text);
    return programs.error().code;
  }
  auto opened = Door::open(door_of(options_, gate_.settings()), *this);
  if (!opened) {
    base::print(stderr, "indurop-serve: error: {}\n", opened.error().text);
    return kFailed;
  }
  door_ = std::move(opened).value();
  if (!programs->empty()) {
    plc_ = std::make_unique<Plc>(*programs, options_.node);
  }
  announce();
  tools::be_gentle(options_.node);
  sampling_ = std::make_unique<Door::Alarm>(*door_, [this] { hub_.run(rt::now_ns()); });
  // Also ensures that a signal is noticed when nothing else happens.
  constexpr std::int64_t kUpdateNs = 500'000'000;
  std::unique_ptr<Door::Alarm> updating;
  if (options_.plant) {
    plant_ = std::make_unique<Plant>(options_.link, options_.node, remote_boards_);
  }
  updating = std::make_unique<Door::Alarm>(*door_, [this, &updating] {
    hub_.update_boards();
    (void)holds_.worker.add_if_idle([this] { leases_.end_overdue(); });
    updating->set(kUpdateNs);
  });
  constexpr std::int64_t kPollNs = 125'000'000;
  Door::Alarm polling(*door_, [this, &polling] {
    if (plant_ != nullptr) {
      (void)plant_->worker.add_if_idle([this] {
        plant_->watch.update();
        remote_boards_.poll(plant_->watch);
      });
      polling.set(kPollNs);
    }
  });
  polling.set(kPollNs);
  updating->set(kUpdateNs);
  constexpr std::int64_t kAlarmsNs = 100'000'000;
  Door::Alarm watching(*door_, [this, &watching] {
    alarms_.check(boards_.local());
    for (const std::string& word : alarms_.news()) {
      hub_.send_to_all(word);
    }
    if (jogs_.busy()) {
      (void)holds_.worker.add([this] { jogs_.end_overdue(); });
    }
    watching.set(kAlarmsNs);
  });
  watching.set(kAlarmsNs);
  door_->serve([] { return tools::interrupted(); });
  updating.reset();
  sampling_.reset();
  return tools::interrupt_code();
}

}  // namespace indurop::serve
