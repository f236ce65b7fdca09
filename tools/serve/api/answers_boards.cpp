// SPDX-License-Identifier: Apache-2.0
// Answers about boards and their modules.
#include "history/alarms/alarm_list.h"
#include "tools/client/node/external_view.h"
#include "tools/client/node/mirror_view.h"
#include "tools/client/node/module_table.h"
#include "tools/client/node/run_report.h"
#include "tools/serve/api/answers.h"
#include "tools/serve/boards/boards.h"
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
  const auto reported = board.reported_alarms();
  return reported ? *reported : api.facts().alarms(board.name());
}

// What the list of boards and the answer about one have in common.
void add_status(base::Json& out, const Api& api, const Board& board, const std::optional<tools::RunView>& run) {
  const alarms::AlarmCounts alarms = alarms_of(api, board);
  out["alive"] = board.alive();
  out["state"] = board.state();
  out["layout"] = board.layout();
  out["alarms"] = json_of(alarms);
  out["trouble"] = texts_of(troubles_of(board, run, alarms));
  out.update(board.reported());
}

base::Json summary_of(const Api& api, const Board& board) {
  const auto run = board.run();
  const tools::NodeReport report = run ? tools::report_of(board.name(), *run) : tools::NodeReport{};
  base::Json out = about(board);
  out["here"] = true;
  out["deployment"] = report.deployment;
  out["config_file"] = report.config_file;
  out["modules"] = report.modules;
  out["overruns"] = report.overruns;
  out["faults"] = report.faults;
  out["forces"] = board.store() != nullptr ? board.store()->forces().size() : 0;
  add_status(out, api, board, run);
  return out;
}

base::Json module_of(base::Json row, const scheduler::ModuleRecord& record) {
  row["core"] = record.core;
  row["offset_ns"] = record.offset_ns.load();
  row["deadline_ns"] = record.deadline_ns.load();
  row["budget_ns"] = record.budget_ns.load();
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
  const auto mirror = tools::view_mirror(one.name());
  const auto external = tools::view_external(one.name());
  body["node"] = one.name();
  add_status(body, api, one, run);
  body["forces"] = one.forces();
  body["lock"] = one.lock();
  body["mirror"] = mirror ? tools::json_of(*mirror) : base::Json();
  body["external"] = external ? tools::json_of(*external) : base::Json();
  return json_reply(body);
}

Reply modules(Api& /*api*/, const Call& call) {
  const auto found = board_of(call);
  if (!found) {
    return found.error();
  }
  const auto run = (*found)->current_run();
  if (!run && (*found)->remote() != nullptr) {
    return refusal(run.error().code, run.error().reasons.front());
  }
  base::Json list = base::Json::array();
  if (run) {  // a node that has not run has no modules
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
  body["forces"] = (*found)->forces();
  body["lock"] = (*found)->lock();
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
