// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/plant/plant_status.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <optional>

#include "core/rt/clock.h"
#include "history/alarms/alarm_state.h"
#include "tools/client/board/board_table.h"
#include "tools/client/board/board_texts.h"
#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

constexpr std::int64_t kStatusHearNs = 1'500'000'000;  // agents report twice a second

// Parses an agent's answer; returns nothing if it is not in the format of this version.
std::optional<std::vector<mirror::MirroredVariable>> variables_in(const std::string& text) {
  const JsonValue whole = JsonValue::parse(text).value_or(JsonValue());
  const JsonValue* list = whole.find("variables");
  if (list == nullptr) {
    return std::nullopt;
  }
  std::vector<mirror::MirroredVariable> variables;
  for (const JsonValue& one : list->values()) {
    mirror::MirroredVariable& variable = variables.emplace_back();
    variable.age_ns = -1;
    if (!read(one, "name", variable.name) || !read(one, "owner", variable.owner) ||
        !read(one, "valid", variable.valid) || (!one["age_ns"].is_null() && !read(one, "age_ns", variable.age_ns))) {
      return std::nullopt;
    }
  }
  return variables;
}

// Returns nodes and indurop-pools that do not run although they should, and alarms: "board control: module Robot is
// stopped".
std::vector<std::string> trouble_of(deploy::DeployLink& link, std::uint64_t self, const BoardRoster& roster,
                                    const PoolPrograms& pools) {
  const auto texts = fetch_texts(link, self, deploy::kAlarmsBlob, roster.agents());
  std::vector<std::string> all;
  for (const auto& [key, entry] : roster.all()) {
    const deploy::BoardReport& board = entry.report;
    if (!board.current.empty() && board.node != deploy::NodeCondition::Running) {
      all.push_back(fmt::format("board {}: its node is {}", board.board, deploy::to_text(board.node)));
    }
    if (const auto program = pools.find(key.second); program != pools.end() && !program->second.problem.empty()) {
      all.push_back(fmt::format("board {}: {}", board.board, program->second.problem));
    }
    const auto text = texts.find(key.second);
    const JsonValue reported = text != texts.end() ? JsonValue::parse(text->second).value_or(JsonValue()) : JsonValue();
    for (const JsonValue& one : reported["alarms"].values()) {
      const auto state = alarms::alarm_state_of(one["state"].text().value_or(""));
      if (state && (alarms::is_active(*state) || alarms::wants_attention(*state))) {
        all.push_back(fmt::format("board {}: {} ({})", board.board, one["text"].text().value_or(""), word_of(*state)));
      }
    }
  }
  return all;
}

BoardAnswers ask(deploy::DeployLink& link, std::uint64_t self, const BoardRoster& roster) {
  BoardAnswers answers;
  for (const auto& [agent, text] : fetch_texts(link, self, deploy::kMirrorBlob, roster.agents())) {
    if (auto variables = variables_in(text)) {
      answers.read.emplace(agent, std::move(*variables));
    }
  }
  for (const auto& [agent, text] : fetch_texts(link, self, deploy::kPoolsBlob, roster.agents())) {
    if (auto program = read_pool_program(text)) {
      answers.pools.emplace(agent, std::move(*program));
    }
  }
  return answers;
}

}  // namespace

int PlantStatus::show(Context& context) {
  if (open_ == nullptr) {
    open_ = open_link(context.out, link);
    if (open_ == nullptr) {
      return kUnreachable;
    }
    roster_.gather(*open_, kStatusHearNs, [&] { return roster_.complete(); });
  }
  const BoardAnswers answers = ask(*open_, link.self, roster_);
  const std::vector<std::string> trouble = trouble_of(*open_, link.self, roster_, answers.pools);
  const std::int64_t now = rt::now_ns();
  roster_.listen(*open_, now);
  const Table table = board_table(roster_, now, &answers);
  const std::vector<std::string> missing = missing_boards(roster_);
  if (table.empty()) {
    context.out.error(
        fmt::format("no board was heard on domain {} within {}; agents are started with indurop-agent "
                    "--board NAME{}",
                    link.network.domain, human_age(kStatusHearNs), keys_hint(link)));
  } else if (!missing.empty()) {
    context.out.error(fmt::format("not heard: {}", fmt::join(missing, ", ")));
  }
  for (const std::string& text : trouble) {
    context.out.error(printable(text));
  }
  note_others(context.out, roster_);
  print_table(context, table,
              {{"domain", link.network.domain},
               {"not_heard", missing},
               {"trouble", trouble},
               {"other_releases", json_of_others(roster_)},
               {"impostors", json_of_impostors(roster_)}},
              "boards");
  if (table.empty() || !missing.empty()) {
    return kUnreachable;
  }
  return check && !trouble.empty() ? kCheckFailed : kOk;
}

}  // namespace indurop::tools
