// SPDX-License-Identifier: Apache-2.0
// Answers about boards and their modules.
#include "history/alarms/alarm_list.h"
#include "tools/cli/values/external_view.h"
#include "tools/cli/values/force_view.h"
#include "tools/cli/values/mirror_view.h"
#include "tools/cli/values/module_table.h"
#include "tools/cli/values/run_report.h"
#include "tools/serve/api/answers.h"
#include "tools/serve/boards/board.h"
#include "tools/serve/boards/trouble.h"

namespace indurop::serve::answers {
namespace {

base::Json texts_of(const std::vector<Trouble>& troubles) {
  base::Json out = base::Json::array();
  for (const Trouble& trouble : troubles) {
    if (trouble.severity != Severity::Note) {
      out.push_back(trouble.text);
    }
  }
  return out;
}

alarms::AlarmCounts alarms_of(const Api& api, const Board& board) {
  return board.remote() != nullptr ? board.remote_alarms() : api.facts().alarms(board.name());
}

std::uint64_t number_of(const base::Json& row, const char* what) {
  return row[what].natural().value_or(0);
}

// Adds, for a board of another host, the report of its agent, and its location.
void add_far(base::Json& out, const Board& board) {
  if (board.remote() == nullptr) {
    return;
  }
  const auto said = board.remote()->said();
  out["here"] = false;
  out["host"] = said.row["host"].text().value_or("");
  out["deployment"] = said.row["deployment"].text().value_or("");
  out["overruns"] = number_of(said.row, "overruns");
  out["faults"] = number_of(said.row, "faults");
  out["lost_ticks"] = number_of(said.row, "lost_ticks");
}

base::Json summary_of(const Api& api, const Board& board) {
  const auto run = board.run();
  const tools::NodeReport report = run ? tools::report_of(board.name(), *run) : tools::NodeReport{};
  base::Json out = about(board);
  out["here"] = true;
  out["alive"] = board.alive();
  out["state"] = board.state();
  out["deployment"] = report.deployment;
  out["config_file"] = report.config_file;
  out["modules"] = report.modules;
  out["overruns"] = report.overruns;
  out["faults"] = report.faults;
  out["forces"] = board.store() != nullptr ? board.store()->forces().size() : 0;
  const alarms::AlarmCounts alarms = alarms_of(api, board);
  out["alarms"] = json_of(alarms);
  out["trouble"] = texts_of(troubles_of(board, run, alarms));
  out["layout"] = board.layout();
  add_far(out, board);
  return out;
}

void add_forces(base::Json& out, const Board& board) {
  if (board.remote() != nullptr) {
    auto said = board.remote()->said();
    out["forces"] = std::move(said.forces);
    out["lock"] = std::move(said.lock);
    return;
  }
  const auto* const store = board.store();
  out["forces"] = store != nullptr ? tools::json_of(tools::view_forces(board.name(), *store)) : base::Json::array();
  out["lock"] = tools::json_of(vars::lock_of(board.name()));
}

base::Json module_of(base::Json row, const scheduler::ModuleRecord& record) {
  row["core"] = record.core;
  row["offset_ns"] = record.offset_ns;
  row["deadline_ns"] = record.deadline_ns;
  row["budget_ns"] = record.budget_ns;
  row["file"] = tools::fixed_text(record.file);
  return row;
}

}  // namespace

Reply boards(Api& api, const Call& call) {
  base::Json list = base::Json::array();
  for (const std::string& name : call.boards->names()) {
    if (const Board* const one = call.boards->find(name)) {
      list.push_back(summary_of(api, *one));
    }
  }
  base::Json body = base::Json::object();
  body["boards"] = std::move(list);
  return json_reply(body);
}

Reply board(Api& api, const Call& call) {
  const auto found = board_of(call);
  if (!found) {
    return found.error();
  }
  const Board& one = **found;
  const auto run = one.run();
  base::Json body = run ? tools::json_of(tools::report_of(one.name(), *run)) : base::Json::object();
  add_far(body, one);
  const auto mirror = tools::view_mirror(one.name());
  const auto external = tools::view_external(one.name());
  body["node"] = one.name();
  body["alive"] = one.alive();
  body["state"] = one.state();
  body["layout"] = one.layout();
  const alarms::AlarmCounts alarms = alarms_of(api, one);
  body["alarms"] = json_of(alarms);
  body["trouble"] = texts_of(troubles_of(one, run, alarms));
  add_forces(body, one);
  body["mirror"] = mirror ? tools::json_of(*mirror) : base::Json();
  body["external"] = external ? tools::json_of(*external) : base::Json();
  return json_reply(body);
}

Reply modules(Api& /*api*/, const Call& call) {
  const auto found = board_of(call);
  if (!found) {
    return found.error();
  }
  const auto run = (*found)->run();
  base::Json list = base::Json::array();
  if (run) {
    const base::Json rows = tools::module_table(*run, run->node_alive()).json();
    std::uint32_t index = 0;
    for (const base::Json& row : rows.values()) {
      list.push_back(module_of(row, run->module(index++)));
    }
  }
  base::Json body = about(**found);
  body["alive"] = (*found)->alive();
  body["modules"] = std::move(list);
  return json_reply(body);
}

Reply faults(Api& api, const Call& call) {
  const auto found = board_of(call);
  if (!found) {
    return found.error();
  }
  base::Json list = base::Json::array();
  for (const Trouble& trouble : troubles_of(**found, (*found)->run(), alarms_of(api, **found))) {
    base::Json one = base::Json::object();
    one["severity"] = word_of(trouble.severity);
    one["module"] = trouble.module;
    one["text"] = trouble.text;
    if (trouble.tick) {
      one["tick"] = *trouble.tick;
    }
    list.push_back(std::move(one));
  }
  base::Json body = about(**found);
  body["faults"] = std::move(list);
  return json_reply(body);
}

Reply forces(Api& /*api*/, const Call& call) {
  const auto found = board_of(call);
  if (!found) {
    return found.error();
  }
  base::Json body = about(**found);
  (*found)->want();
  add_forces(body, **found);
  return json_reply(body);
}

Reply deployments(Api& /*api*/, const Call& call) {
  base::Json list = base::Json::array();
  for (const std::string& name : call.boards->names()) {
    const auto run = tools::RunView::open(name);
    const std::string id = run.ok() ? tools::fixed_text(run.value().block().deployment) : std::string();
    if (id.empty()) {
      continue;
    }
    base::Json one = base::Json::object();
    one["deployment"] = id;
    one["plant"] = "";
    one["generation"] = 0;
    one["host"] = "";
    one["wall_ns"] = run.value().block().started_wall_ns;
    one["outcome"] = "committed";
    one["boards"] = std::vector<std::string>{name};
    one["current"] = run.value().node_alive();
    list.push_back(std::move(one));
  }
  base::Json body = base::Json::object();
  body["deployments"] = std::move(list);
  return json_reply(body);
}

}  // namespace indurop::serve::answers
