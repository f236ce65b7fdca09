// SPDX-License-Identifier: Apache-2.0
// indurop rollback: returns the boards of a plant to an earlier deployment, as one deployment.
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "core/keys/digest.h"
#include "tools/cli/plant/run_deployment.h"
#include "tools/cli/verbs/verbs.h"
#include "tools/client/board/board_history.h"
#include "tools/client/board/board_texts.h"
#include "tools/client/board/deploy_key.h"

namespace indurop::tools {
namespace {

struct RollbackOptions {
  std::string id;
  std::string plant;
  deploy::LinkSettings link;
  std::int64_t timeout_ns = 5'000'000'000;
  std::int64_t health_ns = 3'000'000'000;
  bool allow_missing = false;
};

constexpr std::int64_t kRollbackDiscoverNs = 3'000'000'000;  // less if all are discovered
constexpr std::size_t kShortestId = 4;

// Returns the ids that were committed on the board and begin with `begin`.
std::set<std::string> ids_like(const std::vector<PastDeployment>& history, const std::string& begin) {
  std::set<std::string> ids;
  for (const PastDeployment& past : history) {
    if (past.outcome == "committed" && past.deployment.starts_with(begin)) {
      ids.insert(past.deployment);
    }
  }
  return ids;
}

// Returns the deployment to return to; empty after an error.
std::string choose_target(Context& context, deploy::DeployLink& link, const BoardRoster& roster,
                          const std::vector<std::string>& boards, const RollbackOptions& options) {
  const deploy::BoardReport& first = roster.find(boards.front())->report;
  if (!options.id.empty()) {
    const auto ids = ids_like(fetch_histories(link, options.link.self, {first.agent})[first.agent], options.id);
    if (ids.size() == 1) {
      return *ids.begin();
    }
    context.out.error(ids.empty() ? fmt::format("board {} never committed a deployment {}", first.board, options.id)
                                  : fmt::format("{} is the beginning of several deployments", options.id));
    return {};
  }
  for (const std::string& board : boards) {
    const deploy::BoardReport& other = roster.find(board)->report;
    if (other.previous != first.previous || other.previous.empty()) {
      context.out.error(other.previous.empty()
                            ? fmt::format("board {} ran nothing before", board)
                            : fmt::format("boards {} and {} ran different deployments before; say which with its id "
                                          "(indurop history)",
                                          first.board, board));
      return {};
    }
  }
  return first.previous;
}

// Fetches the list of the deployment's files, for boards whose own list is damaged; empty if no board has a valid one.
std::string fetch_package(deploy::DeployLink& link, const BoardRoster& roster, std::uint64_t self,
                          const std::string& id) {
  for (auto& [agent, text] : fetch_texts(link, self, id, roster.agents())) {
    if (keys::digest_of(text) == id) {
      return std::move(text);
    }
  }
  return {};
}

int roll_back(Context& context, RollbackOptions& options) {
  auto link = open_link(context.out, options.link);
  if (link == nullptr) {
    return kUnreachable;
  }
  BoardRoster roster;
  roster.gather(*link, kRollbackDiscoverNs, [&] { return roster.complete(); });
  const auto meant = choose_plant(roster, options.plant);
  if (!meant) {
    return report(context.out, with_keys_hint(meant.error(), options.link));
  }
  const std::string& plant = *meant;
  // The members according to the newest deployment.
  const deploy::BoardReport* newest = nullptr;
  for (const auto& [key, entry] : roster.all()) {
    if (entry.report.plant == plant && (newest == nullptr || entry.report.generation > newest->generation)) {
      newest = &entry.report;
    }
  }
  const std::vector<std::string> members = newest->members;
  Deployment deployment;
  auto key = read_deploy_key(context.out, options.link.keys);
  if (!key) {
    context.out.error(key.error().text);
    return kFailed;
  }
  auto present = present_boards(context, *link, roster, members, options.allow_missing, options.timeout_ns);
  if (!present) {
    return report(context.out, with_keys_hint(present.error(), options.link));
  }
  deployment.key = std::move(key).value();
  deployment.order.boards = std::move(present).value();
  const std::string target = choose_target(context, *link, roster, deployment.order.boards, options);
  if (target.empty()) {
    return kFailed;
  }
  deployment.order.deployer = options.link.self;
  deployment.order.host = deploy::host_name();
  deployment.order.plant = plant;
  deployment.order.deployment = target;
  const std::string package = fetch_package(*link, roster, options.link.self, target);
  deployment.order.size = package.size();
  deployment.order.generation = next_generation(roster);
  deployment.order.health_ns = options.health_ns;
  deployment.patience_ns = options.timeout_ns;
  deployment.title = fmt::format("plant {}, deployment {} again", plant, deploy::shown_id(target));
  deployment.head = {{"plant", plant}, {"deployment", target}, {"generation", deployment.order.generation}};
  deployment.files = [&](const std::string& name) {
    return name == target && !package.empty() ? std::optional(deploy::BlobServer::Blob{{}, package}) : std::nullopt;
  };
  return run_deployment(context, *link, roster, std::move(deployment));
}

Action declare_rollback(base::Options& app, Context& context) {
  auto options = std::make_shared<RollbackOptions>();
  app.add("id", "ID", options->id, "Deployment to go back to (default: the one before the present one)")
      .check([](const std::string& text) {
        const bool hex = text.find_first_not_of("0123456789abcdef") == std::string::npos;
        return hex && text.size() >= kShortestId ? std::string{} : "an id is 4 to 64 of the digits 0-9 and a-f";
      });
  app.add("--plant", "NAME", options->plant, "Name of the plant (default: the only one)");
  deploy::add_link_options(app, options->link);
  add_time_option(app, "--timeout", options->timeout_ns,
                  "How long to wait for boards to be heard or to answer (default: 5s)");
  add_time_option(app, "--health", options->health_ns,
                  "How long to monitor the deployment before it is committed (default: 3s)");
  app.flag("--allow-missing", options->allow_missing,
           "Roll back the boards that are heard; the others follow when they appear");
  add_format_option(app, context, {Format::Table, Format::Json, Format::Csv});
  return [options](Context& c) { return roll_back(c, *options); };
}

}  // namespace

const Verb kRollbackVerb{
    "rollback", "Plants", "Roll all boards of a plant back to their previous deployment",
    "This is a deployment like any other, of files the boards still have: it is monitored, and if a board is not\n"
    "healthy, all boards go back to what they run now. A second rollback goes forward again.\n"
    "The exit codes are those of indurop deploy.\n"
    "Examples:\n"
    "  indurop rollback\n"
    "  indurop rollback 3f2a91\n",
    &declare_rollback};

}  // namespace indurop::tools
