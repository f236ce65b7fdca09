// SPDX-License-Identifier: Apache-2.0
#include "deploy/agent/board_reload.h"

#include <fmt/format.h>

#include <utility>

namespace indurop::deploy {
namespace {

using operate::RemoteReloadReply;
using scheduler::CommandResult;
using scheduler::ModuleCommand;
using scheduler::VersionState;

constexpr std::uint64_t kLargestModule = 256U << 20U;
constexpr std::chrono::seconds kLongestHealth{60};
constexpr std::chrono::seconds kToExchange{60};  // for fetching, loading, start() and the exchange

}  // namespace

std::string BoardReload::begin(std::uint64_t commander, const std::string& order, scheduler::ModuleRecord& module) {
  auto parsed = operate::parse_remote_reload(order);
  if (!parsed) {
    return "it is no order to exchange a module";
  }
  if (parsed->request.health_ns < 0 || parsed->request.health_ns > std::chrono::nanoseconds(kLongestHealth).count()) {
    return fmt::format("--health of a board is {} s at most", kLongestHealth.count());
  }
  if (!parsed->back && (!keys::is_digest(parsed->digest) || parsed->size > kLargestModule)) {
    return "the file offered has no valid digest or size";
  }
  auto lock = operate::ReloadLock::acquire(board_);
  if (!lock) {
    return "a process on the board is exchanging a module";
  }
  lock_.emplace(std::move(lock).value());
  order_ = *std::move(parsed);
  module_ = &module;
  ticket_.reset();
  exchanged_ = false;
  if (!order_.back) {
    fetcher_.begin_file(commander, {order_.digest, order_.size, "the new version"});
  }
  return "";
}

std::chrono::nanoseconds BoardReload::patience() const noexcept {
  return kToExchange + std::chrono::nanoseconds(order_.request.health_ns);
}

void BoardReload::cancel() {
  fetcher_.cancel();
  lock_.reset();
  module_ = nullptr;
}

std::optional<BoardReload::Answer> BoardReload::poll(DeployLink& link, rt::MonoTime now) {
  std::optional<Answer> answer;
  if (fetcher_.active()) {
    if (fetcher_.step(link, now) == Fetcher::State::Failed) {
      answer = {Outcome::Failed, fetcher_.problem()};
    }
  } else if (!ticket_) {
    answer = place();
  } else if (exchanged_) {
    answer = settled();
  } else {
    answer = answer_of_node();
  }
  if (answer) {
    cancel();
  }
  return answer;
}

// The file is here: the node reads its path from the request.
std::optional<BoardReload::Answer> BoardReload::place() {
  operate::ReloadRequest request = order_.request;
  request.file = order_.back ? "" : state_.file(order_.digest).string();
  if (const Status written = order_.back ? Status() : operate::write_request(board_, request); !written) {
    return Answer{Outcome::Failed, describe_unwritten(written.error())};
  }
  ticket_ = scheduler::place_command(*module_, order_.back ? ModuleCommand::Back : ModuleCommand::Reload);
  return ticket_ ? std::nullopt
                 : std::optional(Answer{Outcome::Refused, "an earlier command about this module is not done yet"});
}

BoardReload::Answer BoardReload::report(RemoteReloadReply::Result result) {
  auto said = operate::read_report(board_);
  return {Outcome::Done,
          operate::text_of(RemoteReloadReply{result, said ? *std::move(said) : operate::ReloadReport()})};
}

std::optional<BoardReload::Answer> BoardReload::answer_of_node() {
  switch (scheduler::result_of(*module_, *ticket_)) {
    case CommandResult::None:
      return std::nullopt;
    case CommandResult::Done:
      exchanged_ = !order_.back && !order_.request.dry_run;
      return exchanged_ ? std::nullopt : std::optional(report(RemoteReloadReply::Result::Done));
    case CommandResult::Unchanged:
      return report(RemoteReloadReply::Result::Unchanged);
    case CommandResult::Refused:
      return report(RemoteReloadReply::Result::Refused);
    case CommandResult::OldCode:
    case CommandResult::Failed:
    case CommandResult::Ending:
      break;
  }
  return report(RemoteReloadReply::Result::Failed);
}

std::optional<BoardReload::Answer> BoardReload::settled() {
  switch (module_->version_state.load()) {
    case VersionState::Watched:
      return std::nullopt;
    case VersionState::Returned:
      return report(RemoteReloadReply::Result::Returned);
    case VersionState::Settled:
      break;
  }
  return report(RemoteReloadReply::Result::Done);
}

}  // namespace indurop::deploy
