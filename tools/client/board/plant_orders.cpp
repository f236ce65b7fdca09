// SPDX-License-Identifier: Apache-2.0
// The requests and commands of PlantWatch to one board.
#include <fmt/format.h>

#include <algorithm>

#include "deploy/transaction/write_words.h"
#include "tools/client/board/board_texts.h"
#include "tools/client/board/plant_watch.h"
#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

constexpr std::int64_t kReportedNs = 1'200'000'000;  // boards report twice a second
constexpr std::int64_t kPatienceNs = 5'000'000'000;

deploy::Action action_of(PlantWatch::RemoteOrder::What what) {
  using What = PlantWatch::RemoteOrder::What;
  switch (what) {
    case What::Set:
      return deploy::Action::Set;
    case What::Force:
      return deploy::Action::Force;
    case What::Unforce:
      return deploy::Action::Unforce;
    case What::Lock:
      return deploy::Action::SetLock;
    case What::StopModule:
      return deploy::Action::StopModule;
    case What::StartModule:
      return deploy::Action::StartModule;
    case What::AckAlarms:
      return deploy::Action::AckAlarms;
    case What::ShelveAlarms:
      return deploy::Action::ShelveAlarms;
    case What::UnshelveAlarms:
      return deploy::Action::UnshelveAlarms;
    case What::RestartModule:
      break;
  }
  return deploy::Action::RestartModule;
}

std::string target_of(const PlantWatch::RemoteOrder& order, const std::string& release) {
  using What = PlantWatch::RemoteOrder::What;
  const bool module =
      order.what == What::StopModule || order.what == What::StartModule || order.what == What::RestartModule;
  deploy::WriteOrder words;
  words.for_ns = order.for_ns;
  words.who = order.who;
  words.reason = order.reason;
  words.lines = order.lines;
  return module ? module_target(words, release) : text_of(words);
}

}  // namespace

std::map<std::string, std::string> PlantWatch::texts(const char* name, const std::vector<std::string>& boards) {
  std::map<std::string, std::string> all;
  if (!open() || boards.empty()) {
    return all;
  }
  std::vector<std::uint64_t> agents;
  for (const std::string& board : boards) {
    if (const BoardRoster::Entry* const entry = roster_.find(board)) {
      agents.push_back(entry->report.agent);
    }
  }
  auto answers = fetch_texts(*link_, settings_.self, name, agents);
  for (const std::string& board : boards) {
    const BoardRoster::Entry* const entry = roster_.find(board);
    const auto answer = entry != nullptr ? answers.find(entry->report.agent) : answers.end();
    if (answer != answers.end()) {
      all.emplace(board, std::move(answer->second));
    }
  }
  return all;
}

Result<deploy::BoardReport, Failure> PlantWatch::report(const std::string& board) {
  if (!open()) {
    return Failure{kUnreachable, problem_};
  }
  update();
  const BoardRoster::Entry* entry = roster_.find(board);
  if (entry != nullptr && entry->report.plant.empty()) {
    // A command names the plant, and a recent deployment may not have been reported yet.
    roster_.gather(*link_, kReportedNs, [&] {
      const BoardRoster::Entry* const now = roster_.find(board);
      return now == nullptr || !now->report.plant.empty();
    });
    entry = roster_.find(board);
  }
  if (entry == nullptr) {
    return Failure{kUnreachable, fmt::format("board {} is not heard", board)};
  }
  return entry->report;
}

Result<std::string, Failure> PlantWatch::order(const std::string& board, const RemoteOrder& order) {
  const auto there = report(board);
  if (!there) {
    return there.error();
  }
  KeptMessages messages;
  if (commander_ == nullptr) {
    auto made = BoardCommander::make(messages, settings_.keys);
    if (!made) {
      return Failure{kFailed, messages.texts.empty() ? made.error().text : messages.texts.front()};
    }
    commander_ = std::make_unique<BoardCommander>(std::move(made).value());
  }
  const auto answered = commander_->send(*link_, settings_.self, *there, action_of(order.what),
                                         target_of(order, there->release), kPatienceNs);
  if (!answered) {
    return Failure{answered.error().code, fmt::format("board {}: {}", board, answered.error().text)};
  }
  const deploy::CommandReply& reply = answered->reply;
  if (reply.outcome != deploy::Outcome::Done && reply.outcome != deploy::Outcome::Unchanged) {
    return Failure{kFailed, fmt::format("board {}: {}", board, printable(reply.text))};
  }
  return printable(reply.text);
}

}  // namespace indurop::tools
