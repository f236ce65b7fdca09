// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/plant/run_deployment.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/base/read_file.h"
#include "core/keys/credentials.h"
#include "core/keys/plant_keys.h"
#include "core/rt/clock.h"
#include "deploy/transaction/plant_transaction.h"
#include "tools/cli/plant/deployment_plan.h"
#include "tools/client/board/board_table.h"
#include "tools/client/process/interrupt.h"
#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

using deploy::PlantTransaction;
using Verdict = PlantTransaction::Verdict;

constexpr std::chrono::milliseconds kSay{500};  // the boards consider a deployer that is silent for long as dead
constexpr std::int64_t kDeployPollNs = 20'000'000;
constexpr std::chrono::seconds kProgress{1};

const char* word_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::Open:
      return "open";
    case Verdict::Committed:
      return "committed";
    case Verdict::Refused:
      return "refused";
    case Verdict::CheckFailed:
      return "check failed";
    case Verdict::Busy:
      return "busy";
    case Verdict::RolledBack:
      return "rolled back";
    case Verdict::Interrupted:
      return "interrupted";
    case Verdict::Compared:
      return "compared";
  }
  return "?";
}

class Run {
 public:
  Run(Context& context, deploy::DeployLink& link, BoardRoster& roster, Deployment deployment)
      : context_(context),
        link_(link),
        roster_(roster),
        deployment_(std::move(deployment)),
        server_(deployment_.order.deployer, deployment_.files),
        transaction_(deployment_.order, std::chrono::nanoseconds(deployment_.patience_ns), rt::MonoClock::now(),
                     deployment_.lost) {}

  int run() {
    for (const std::string& board : deployment_.order.boards) {
      if (const auto* entry = roster_.find(board)) {
        transaction_.receive(entry->report, rt::MonoClock::now());
      }
    }
    print_progress(true);
    while (!transaction_.finished()) {
      if (!busy_) {
        link_.wait(rt::mono_time(rt::now_ns() + kDeployPollNs));
      }
      const rt::MonoTime now = rt::MonoClock::now();
      if (interrupted()) {
        transaction_.give_up(now);
      }
      listen(now);
      busy_ = server_.serve(link_, now);
      print_progress(transaction_.time(now, rt::WallClock::now()));
      show(now);
    }
    return finish();
  }

 private:
  void listen(rt::MonoTime now) {
    std::vector<BoardRoster::Gone> gone;
    roster_.listen(link_, rt::to_ns(now), &gone);
    for (const auto& one : gone) {
      transaction_.board_lost(one.board, one.agent, now);
    }
    for (const auto& [key, entry] : roster_.all()) {
      if (entry.heard_ns == rt::to_ns(now)) {
        transaction_.receive(entry.report, now);
        if (entry.report.deployer == deployment_.order.deployer) {
          plan_.receive(entry.report);
        }
      }
    }
    for (const auto& news : link_.take_orders()) {
      if (!news.gone) {
        transaction_.rival(news.order, now);
      }
    }
  }

  void print_progress(bool changed) {
    const rt::MonoTime now = rt::MonoClock::now();
    if (changed || now - said_ >= kSay) {
      said_ = now;
      (void)transaction_.time(now, rt::WallClock::now());
      deploy::Order order = transaction_.order();
      if (!deployment_.key.empty()) {
        order.grant =
            keys::signature_of(deploy::grant_text(order.plant, order.deployment, order.generation), deployment_.key);
        order.signature = keys::signature_of(deploy::order_text(order), deployment_.key);
      }
      link_.publish(order);
      if (order.step != deploy::Step::Prepare) {
        plan_.print(context_);  // what the boards have reported before the switch
      }
    }
  }

  // Prints a line per board whenever its phase changes, and once a second while it fetches files.
  void show(rt::MonoTime now) {
    for (const auto& [board, report] : transaction_.reports()) {
      if (report.deployer != deployment_.order.deployer) {
        continue;
      }
      Shown& shown = shown_[board];
      shown.fetched = std::max(shown.fetched, report.bytes_done);  // the agent of a new release begins at 0
      const bool fetching = report.phase == deploy::Phase::Fetching && report.bytes > 0;
      if (report.phase == shown.phase && (!fetching || now - shown.at < kProgress)) {
        continue;
      }
      std::string line = fmt::format("  {:<16} {}", board, word_for(report));
      if (fetching) {
        line += fmt::format("  {}/{} files, {} of {}", report.files_done, report.files, human_bytes(report.bytes_done),
                            human_bytes(report.bytes));
      } else if (report.phase == deploy::Phase::Prepared && report.files > 0) {
        line += fmt::format("  {} files fetched", report.files);
      }
      if (!report.message.empty()) {
        line += "  " + printable(report.message);
      }
      shown.phase = report.phase;
      shown.at = now;
      if (!context_.out.quiet()) {
        context_.out.message_line(line);
      }
    }
  }

  [[nodiscard]] const char* word_for(const deploy::BoardReport& report) const {
    if (report.phase != deploy::Phase::Steady) {
      return deploy::to_text(report.phase);
    }
    return report.current == deployment_.order.deployment ? "committed" : "as before";
  }

  [[nodiscard]] Table table() const {
    Table table({{"BOARD", "board"},
                 {"HOST", "host"},
                 {"DEPLOYMENT", "deployment"},
                 {"STATE", "state"},
                 {"FETCHED", "fetched_bytes", Align::Right},
                 {"REASON", "reason"}});
    for (const std::string& board : deployment_.order.boards) {
      const auto found = transaction_.reports().find(board);
      const deploy::BoardReport report = found == transaction_.reports().end() ? deploy::BoardReport{} : found->second;
      const auto shown = shown_.find(board);
      const std::uint64_t fetched = shown == shown_.end() ? 0 : shown->second.fetched;
      const auto reason = transaction_.reasons().find(board);
      const std::string why = reason == transaction_.reasons().end() ? "" : printable(reason->second);
      table.add({Cell(board, Style::Bold),
                 Cell(report.host),
                 {report.current.empty() ? "-" : deploy::shown_id(report.current), report.current},
                 Cell(deploy::to_text(report.node)),
                 {human_bytes(fetched), fetched},
                 Cell(why, why.empty() ? Style::None : Style::Bad)});
    }
    return table;
  }

  int finish() {
    const Verdict verdict = transaction_.verdict();
    JsonValue head = deployment_.head;
    head["signed"] = !deployment_.key.empty();
    head["result"] = word_of(verdict);
    head["unconfirmed"] = transaction_.unconfirmed();
    if (!plan_.empty()) {
      head["plan"] = plan_.json();
    }
    plan_.print(context_);
    if (verdict == Verdict::Committed) {
      plan_.print_ticks(context_);
    }
    print_table(context_, table(), head, "boards");
    for (const auto& [board, reason] : transaction_.reasons()) {
      context_.out.error(fmt::format("{}: {}", board, printable(reason)));
    }
    if (!transaction_.unconfirmed().empty()) {
      context_.out.error(fmt::format("not confirmed by {}; they take over what the others run when they are back",
                                     fmt::join(transaction_.unconfirmed(), ", ")));
    }
    return conclude(verdict);
  }

  int conclude(Verdict verdict) {
    const std::string& title = deployment_.title;
    switch (verdict) {
      case Verdict::Committed:
        if (context_.format == Format::Table) {
          context_.out.line(fmt::format("{}  {} is committed", context_.out.paint(Style::Good, "OK"), title));
        }
        return kOk;
      case Verdict::RolledBack:
        context_.out.error(title + " was rolled back: every board runs what it ran before");
        return kRolledBack;
      case Verdict::Compared:
        context_.out.note(title + " would be deployed so; nothing was changed");
        return kOk;
      case Verdict::CheckFailed:
        context_.out.error(title + " was refused: nothing was changed");
        return kCheckFailed;
      case Verdict::Interrupted:
        context_.out.error(title + " was interrupted: every board runs what it ran before");
        return interrupt_code();
      case Verdict::Busy:
      case Verdict::Refused:
      case Verdict::Open:
        break;
    }
    context_.out.error(title + " was not deployed: nothing was changed");
    return kFailed;
  }

  struct Shown {
    deploy::Phase phase = deploy::Phase::Steady;
    rt::MonoTime at;
    std::uint64_t fetched = 0;  // bytes
  };

  Context& context_;
  deploy::DeployLink& link_;
  BoardRoster& roster_;
  Deployment deployment_;
  deploy::BlobServer server_;
  PlantTransaction transaction_;
  DeploymentPlan plan_;
  bool busy_ = false;
  rt::MonoTime said_;
  std::map<std::string, Shown> shown_;
};

}  // namespace

int run_deployment(Context& context, deploy::DeployLink& link, BoardRoster& roster, Deployment deployment) {
  return Run(context, link, roster, std::move(deployment)).run();
}

std::uint64_t next_generation(const BoardRoster& roster) {
  std::uint64_t last = 0;
  for (const auto& [key, entry] : roster.all()) {
    last = std::max(last, entry.report.generation);
  }
  // Not below the clock: a board that was absent for long must not return with a higher number than all others.
  return std::max(last + 1, static_cast<std::uint64_t>(rt::wall_ns() / rt::kNanosPerSecond));
}

Result<std::vector<std::string>, Failure> present_boards(Context& context, deploy::DeployLink& link,
                                                         BoardRoster& roster, const std::vector<std::string>& wanted,
                                                         bool allow_missing, std::int64_t timeout_ns) {
  std::vector<std::string> missing;
  roster.gather(link, timeout_ns, [&] {
    return std::all_of(wanted.begin(), wanted.end(), [&](const auto& board) { return roster.find(board) != nullptr; });
  });
  std::vector<std::string> present;
  bool unique = true;
  for (const std::string& board : wanted) {
    (roster.find(board) != nullptr ? present : missing).push_back(board);
    if (const std::string hosts = roster.twins(board, rt::now_ns()); !hosts.empty()) {
      context.out.error(fmt::format("two agents are named {}, on {}; stop one of them", board, hosts));
      unique = false;
    }
  }
  if (interrupted() || !unique) {
    return Failure{interrupted() ? interrupt_code() : kFailed, {}};
  }
  const std::string seen =
      fmt::format("{} of {} boards heard within {}", present.size(), wanted.size(), human_age(timeout_ns));
  if (!missing.empty() || !roster.impostors().empty()) {
    note_others(context.out, roster);
  }
  if (!missing.empty() && !allow_missing) {
    return Failure{kUnreachable,
                   fmt::format("missing: {} ({}); nothing was deployed. Start their agents (indurop-agent "
                               "--board NAME), or deploy without them: --allow-missing",
                               fmt::join(missing, ", "), seen)};
  }
  if (present.empty()) {
    return Failure{kUnreachable, fmt::format("no board was heard within {}", human_age(timeout_ns))};
  }
  if (!missing.empty()) {
    context.out.note(
        fmt::format("missing: {}; they take the deployment over when they appear", fmt::join(missing, ", ")));
  }
  return present;
}

}  // namespace indurop::tools
