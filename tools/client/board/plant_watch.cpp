// SPDX-License-Identifier: Apache-2.0
#include "tools/client/board/plant_watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <vector>

#include "core/rt/clock.h"
#include "tools/client/board/board_history.h"
#include "tools/client/board/board_table.h"
#include "tools/client/board/deployment_difference.h"
#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

constexpr std::int64_t kDiscoverNs = 1'500'000'000;  // agents report twice a second
constexpr std::int64_t kLateNs = 3'000'000'000;

}  // namespace

bool PlantWatch::open() {
  if (link_ != nullptr) {
    return true;
  }
  settings_.self = deploy::new_session();
  auto opened = deploy::DeployLink::open(settings_);
  problem_ = opened ? opened->note : opened.error().text;
  if (!opened) {
    return false;
  }
  link_ = std::move(opened->link);
  roster_.gather(*link_, kDiscoverNs, [this] { return roster_.complete(); });
  return true;
}

void PlantWatch::update() {
  if (!open()) {
    return;
  }
  const std::int64_t now = rt::now_ns();
  roster_.listen(*link_, now);
  const base::Json rows = board_table(roster_, now).json();
  std::size_t at = 0;
  for (const auto& [key, entry] : roster_.all()) {
    seen_[key.first] = {rows.values()[at++], entry.heard_ns};
  }
}

std::vector<base::Json> PlantWatch::rows() const {
  const std::int64_t now = rt::now_ns();
  std::vector<base::Json> all;
  for (const auto& [name, seen] : seen_) {
    base::Json row = seen.row;
    row["heard"] = roster_.find(name) != nullptr && now - seen.heard_ns < kLateNs;
    row["age_ns"] = now - seen.heard_ns;
    all.push_back(std::move(row));
  }
  return all;
}

base::Json PlantWatch::json() const {
  base::Json boards = base::Json::array();
  for (base::Json& row : rows()) {
    boards.push_back(std::move(row));
  }
  base::Json out = base::Json::object();
  out["domain"] = settings_.network.domain;
  out["problem"] = problem_;
  out["trouble"] = troubles(boards);
  out["boards"] = std::move(boards);
  out["not_heard"] = base::Json(missing_boards(roster_));
  out["other_releases"] = json_of_others(roster_);
  return out;
}

base::Json PlantWatch::troubles(const base::Json& boards) const {
  std::vector<std::string> worst;
  std::vector<std::string> rest;
  std::set<std::string> silent;
  for (const base::Json& row : boards.values()) {
    const std::string name = row["board"].text().value_or("");
    const auto number = [&row](const char* what) { return row[what].natural().value_or(0); };
    if (!row["heard"].boolean().value_or(false)) {
      silent.insert(name);
      worst.push_back(
          fmt::format("board {} no longer reports, last {} ago", name, human_age(row["age_ns"].integer().value_or(0))));
      continue;
    }
    const std::string state = row["state"].text().value_or("");
    if (state == "failed") {
      worst.push_back(
          fmt::format("board {}: its node has failed{}", name,
                      row["message"].text().value_or("").empty() ? "" : ": " + row["message"].text().value_or("")));
    }
    if (number("faults") > 0) {
      rest.push_back(fmt::format("board {}: {} faults of modules", name, number("faults")));
    }
    if (number("lost_ticks") > 0) {
      rest.push_back(fmt::format("board {}: {} ticks were lost", name, number("lost_ticks")));
    }
  }
  for (const std::string& name : missing_boards(roster_)) {
    if (!silent.contains(name)) {
      worst.push_back(fmt::format("board {} belongs to the plant and is not heard", name));
    }
  }
  for (const deploy::Impostor& impostor : roster_.impostors()) {
    worst.push_back(describe(impostor));
  }
  worst.insert(worst.end(), rest.begin(), rest.end());
  base::Json list(worst);
  return list;
}

base::Json PlantWatch::history() {
  base::Json all = base::Json::array();
  if (!open()) {
    return all;
  }
  struct Row {
    PastDeployment past;
    std::vector<std::string> boards;
    bool current = false;
  };
  std::vector<Row> rows;
  auto histories = fetch_histories(*link_, settings_.self, roster_.agents());
  roster_.listen(*link_, rt::now_ns());
  for (const auto& [key, entry] : roster_.all()) {
    for (PastDeployment& past : histories[key.second]) {
      const bool current = past.outcome == "committed" && past.deployment == entry.report.current &&
                           past.generation == entry.report.generation;
      const auto same = std::find_if(rows.begin(), rows.end(), [&past](const Row& row) {
        return row.past.deployment == past.deployment && row.past.generation == past.generation &&
               row.past.outcome == past.outcome && row.past.host == past.host;
      });
      Row& row = same != rows.end() ? *same : rows.emplace_back(Row{std::move(past), {}, false});
      if (row.boards.empty() || row.boards.back() != key.first) {
        row.boards.push_back(key.first);
      }
      row.current = row.current || current;
    }
  }
  std::stable_sort(rows.begin(), rows.end(),
                   [](const Row& a, const Row& b) { return a.past.generation > b.past.generation; });
  for (const Row& row : rows) {
    base::Json one = base::Json::object();
    one["generation"] = row.past.generation;
    one["current"] = row.current;
    one["deployment"] = row.past.deployment;
    one["plant"] = row.past.plant;
    one["wall_ns"] = row.past.wall_ns;
    one["host"] = row.past.host;
    one["boards"] = base::Json(row.boards);
    one["outcome"] = row.past.outcome;
    one["comment"] = row.past.comment;
    all.push_back(std::move(one));
  }
  return all;
}

Result<base::Json, base::Problem> PlantWatch::difference(const std::string& before, const std::string& after) {
  if (!open()) {
    return base::Problem{problem_};
  }
  roster_.listen(*link_, rt::now_ns());
  std::vector<std::uint64_t> agents;
  for (const auto& [key, entry] : roster_.all()) {
    agents.push_back(key.second);
  }
  return difference_of(*link_, settings_.self, agents, before, after);
}

}  // namespace indurop::tools
