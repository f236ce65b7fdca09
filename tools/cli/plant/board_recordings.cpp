// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/plant/board_recordings.h"

#include <fmt/format.h>

#include <algorithm>
#include <condition_variable>
#include <mutex>

#include "core/base/json.h"
#include "core/base/text.h"
#include "core/rt/clock.h"
#include "deploy/words/deployment_words.h"
#include "tools/cli/plant/board_file.h"
#include "tools/client/board/board_texts.h"
#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

using deploy::Outcome;

constexpr std::chrono::seconds kHear{3};    // agents report twice a second
constexpr std::chrono::seconds kRepeat{4};  // boards wait for 15 s
constexpr std::chrono::seconds kPatience{5};
constexpr std::chrono::seconds kLastWords{20};  // a recorder has to write the rest of its data

std::uint64_t bytes_of(const std::string& list, const std::string& name) {
  const base::Json whole = base::Json::parse(list).value_or(base::Json());
  for (const base::Json& entry : whole["recordings"].values()) {
    std::string called;
    std::uint64_t bytes = 0;
    if (read(entry, "name", called) && read(entry, "bytes", bytes) && called == name) {
      return bytes;
    }
  }
  return 0;
}

}  // namespace

BoardRecordings::BoardRecordings(std::unique_ptr<deploy::DeployLink> link, std::uint64_t self, BoardCommander commander)
    : link_(std::move(link)), self_(self), name_(fmt::format("{:016x}", self)), commander_(std::move(commander)) {}

void BoardRecordings::discover(const std::vector<std::string>& boards) {
  roster_.gather(*link_, std::chrono::nanoseconds(kHear).count(), [&] {
    return std::all_of(boards.begin(), boards.end(),
                       [&](const std::string& board) { return roster_.find(board) != nullptr; });
  });
}

Result<Answered, Failure> BoardRecordings::send(const One& one, deploy::Action action,
                                                std::chrono::nanoseconds timeout) {
  return commander_.send(*link_, self_, one.board, action, action == deploy::Action::Record ? one.target : name_,
                         timeout.count());
}

Result<std::vector<std::string>, Failure> BoardRecordings::begin(const std::string& board, const std::string& plant,
                                                                 const std::vector<std::string>& names, bool past) {
  const BoardRoster::Entry* const entry = roster_.find(board);
  if (entry == nullptr) {
    return Failure{kUnreachable, "its agent was not heard"};
  }
  if (entry->report.plant != plant) {
    return Failure{kFailed, entry->report.plant.empty() ? "nothing is deployed to it"
                                                        : "it runs plant " + printable(entry->report.plant)};
  }
  One one{entry->report, fmt::format("{}\n{}", name_, past ? "past" : "now")};
  for (const std::string& name : names) {
    one.target += "\n" + name;
  }
  const auto answered = send(one, deploy::Action::Record, kLastWords);
  if (!answered) {
    return answered.error();
  }
  if (answered->reply.outcome != Outcome::Done) {
    return Failure{kFailed, printable(answered->reply.text)};
  }
  const auto unknown = base::lines_of(answered->reply.text);
  if (names.empty() || unknown.size() < names.size()) {
    all_.push_back(std::move(one));
  }
  return unknown;
}

void BoardRecordings::go_on() {
  thread_ = std::jthread([this](const std::stop_token& stop) { repeat(stop); });
}

// A board that does not answer now may do so later; one that has ended is reported at the end.
void BoardRecordings::repeat(const std::stop_token& stop) {
  std::mutex mutex;
  std::condition_variable_any wake;
  std::unique_lock lock(mutex);
  while (!wake.wait_for(lock, stop, kRepeat, [&] { return stop.stop_requested(); })) {
    for (const One& one : all_) {
      if (!stop.stop_requested()) {
        (void)send(one, deploy::Action::Record, kPatience);
      }
    }
  }
}

std::vector<std::string> BoardRecordings::end() {
  if (thread_.joinable()) {
    thread_.request_stop();
    thread_.join();
  }
  refresh();
  std::vector<std::string> problems;
  for (const One& one : all_) {
    for (const std::string& problem : base::lines_of(end(one))) {
      problems.push_back(fmt::format("board {}: {}", one.board.board, printable(problem)));
    }
  }
  return problems;
}

std::string BoardRecordings::end(const One& one) {
  if (agent_of(one.board.board) != one.board.agent) {
    return agent_of(one.board.board) == 0 ? "it no longer reports"
                                          : "its agent was restarted, and the recording ended with the previous agent";
  }
  const auto answered = send(one, deploy::Action::EndRecord, kLastWords);
  if (!answered) {
    return answered.error().text;
  }
  switch (answered->reply.outcome) {
    case Outcome::Done:
      return {};
    case Outcome::Unchanged:
      return "its recording had ended before: " + answered->reply.text;
    default:
      return answered->reply.text;
  }
}

// Updates which boards are present.
void BoardRecordings::refresh() {
  std::vector<std::string> boards;
  for (const One& one : all_) {
    boards.push_back(one.board.board);
  }
  roster_.listen(*link_, rt::now_ns());
  discover(boards);
}

std::uint64_t BoardRecordings::agent_of(const std::string& board) {
  const BoardRoster::Entry* const entry = roster_.find(board);
  return entry == nullptr ? 0 : entry->report.agent;
}

std::pair<std::vector<std::filesystem::path>, std::vector<std::string>> BoardRecordings::fetch(
    const std::filesystem::path& folder) {
  refresh();
  std::vector<std::uint64_t> agents;
  for (const One& one : all_) {
    if (const std::uint64_t agent = agent_of(one.board.board); agent != 0) {
      agents.push_back(agent);
    }
  }
  const auto lists = fetch_texts(*link_, self_, deploy::kRecordingsBlob, agents);
  std::pair<std::vector<std::filesystem::path>, std::vector<std::string>> out;
  for (const One& one : all_) {
    const std::string& board = one.board.board;
    const auto list = lists.find(agent_of(board));
    const std::uint64_t bytes = list == lists.end() ? 0 : bytes_of(list->second, name_);
    if (bytes == 0) {
      out.second.push_back(fmt::format(
          "board {} is not in the recording: {}", board,
          list == lists.end() ? fmt::format("it does not answer; its part stays there as recordings/{}.mcap in the "
                                            "folder of its node's state until the next recording begins",
                                            name_)
                              : "its part is not there any more"));
      continue;
    }
    const std::filesystem::path file = folder / (board + ".mcap");
    if (const auto fetched =
            fetch_file(*link_, self_, {board, list->first, std::string(deploy::kRecordingBlob) + name_, bytes}, file);
        !fetched) {
      out.second.push_back(fmt::format("board {} is not in the recording: {}", board, fetched.error().text));
      continue;
    }
    out.first.push_back(file);
  }
  return out;
}

void BoardRecordings::drop() {
  for (const One& one : all_) {
    (void)send(one, deploy::Action::DropRecord, kPatience);  // if it fails, the next recording there deletes it
  }
}

}  // namespace indurop::tools
