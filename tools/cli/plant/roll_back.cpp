// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/plant/roll_back.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "core/keys/digest.h"
#include "tools/cli/plant/run_deployment.h"
#include "tools/client/board/board_history.h"
#include "tools/client/board/board_texts.h"
#include "tools/client/board/deploy_key.h"

namespace indurop::tools {
namespace {

constexpr std::int64_t kRollbackDiscoverNs = 3'000'000'000;  // less if all are discovered

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

}  // namespace

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
  deployment.order.way = options.restart ? deploy::Way::Restart : deploy::Way::Exchange;
  deployment.patience_ns = options.timeout_ns;
  deployment.title = fmt::format("plant {}, deployment {} again", plant, deploy::shown_id(target));
  deployment.head = {{"plant", plant}, {"deployment", target}, {"generation", deployment.order.generation}};
  deployment.files = [&](const std::string& name) {
    return name == target && !package.empty() ? std::optional(deploy::BlobServer::Blob{{}, package}) : std::nullopt;
  };
  return run_deployment(context, *link, roster, std::move(deployment));
}

}  // namespace indurop::tools
