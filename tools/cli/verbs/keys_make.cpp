// SPDX-License-Identifier: Apache-2.0
// indurop keys init and add: creates keys for the boards of a plant and for others.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <optional>

#include "config/xml/plant_reader.h"
#include "config/xml/plant_rules.h"
#include "core/keys/plant_keys.h"
#include "core/keys/server_keys.h"
#include "tools/cli/verbs/keys_request.h"
#include "tools/console/diagnostics.h"

namespace indurop::tools {

namespace fs = std::filesystem;

keys::Instant until(const KeysRequest& request) {
  return keys::instant_now() + std::chrono::days(request.days);
}

keys::PlantKeys keys_of(const KeysRequest& request) {
  if (!request.folder.empty()) {
    return keys::PlantKeys(request.folder);
  }
  std::error_code ignored;
  if (fs::exists(request.plant, ignored)) {
    const config::ReadPlant read = config::read_plant(request.plant);
    return keys::PlantKeys(read.plant.security.empty() ? fs::path(request.plant).parent_path() / "keys"
                                                       : read.plant.security.lexically_proximate(fs::current_path()));
  }
  return keys::PlantKeys("keys");
}

bool usable(Context& context, const keys::PlantKeys& keys) {
  if (const std::string problem = keys.unreadable(); !problem.empty()) {
    context.out.error(problem + "; nothing was changed. The keys have to belong to the user who runs this (ls -l)");
    return false;
  }
  if (keys.plant().empty()) {
    context.out.error(
        fmt::format("there are no keys in {}; make them with indurop keys init PLANT, or say with --dir "
                    "where they are",
                    keys.folder().string()));
    return false;
  }
  if (const std::string exposed = keys::exposed_key(keys.authority_key()); !exposed.empty()) {
    context.out.note("warning: " + exposed);
  }
  return true;
}

namespace {

void report_existing(Context& context, const keys::PlantKeys& keys) {
  std::string names;
  for (const keys::KeyListing& each : keys.list(keys::instant_now())) {
    names += (names.empty() ? "" : ", ") + each.name;
  }
  context.out.error(
      fmt::format("{} holds the keys of plant {} already, for {}; private keys are never replaced. A board that has "
                  "come: indurop keys add BOARD; an end that is near: indurop keys renew; all: indurop keys list",
                  keys.folder().string(), keys.plant(), names));
}

}  // namespace

int init_keys(Context& context, const KeysRequest& request) {
  std::error_code ignored;
  if (!fs::exists(request.plant, ignored)) {
    context.out.error(fmt::format("there is no file '{}'; name the manifest of the plant", request.plant));
    return kFailed;
  }
  const config::ReadPlant read = config::read_plant(request.plant);
  if (!read.ok()) {
    print_diagnostics(context, read.diagnostics, false);
    return kCheckFailed;
  }
  const keys::PlantKeys keys = keys_of(request);
  if (keys.exist()) {
    report_existing(context, keys);
    return kFailed;
  }
  std::vector<std::string> boards;
  for (const config::Board& board : read.plant.boards) {
    boards.push_back(board.name);
  }
  if (const auto done = keys.make(read.plant.name, boards, until(request)); !done) {
    context.out.error(done.error().text);
    return kFailed;
  }
  context.out.line(fmt::format("made the keys of plant {} in {}: for {}, a viewer and a deployer, valid until {}",
                               read.plant.name, keys.folder().string(), counted(boards.size(), "board"),
                               keys::utc_text(until(request)).substr(0, 10)));
  if (read.plant.security.empty()) {
    const fs::path here = fs::absolute(request.plant, ignored).lexically_normal().parent_path();
    const fs::path there = fs::absolute(keys.folder(), ignored).lexically_normal();
    context.out.note(fmt::format("next: write <security>{}</security> into {}",
                                 there.lexically_proximate(here).string(), request.plant));
  }
  context.out.note(
      fmt::format("copy {}/boards/BOARD to /etc/indurop/keys/{}/BOARD of each board, for its node's user "
                  "alone; keep {}/ca.key away from the plant",
                  keys.folder().string(), read.plant.name, keys.folder().string()));
  return kOk;
}

namespace {

bool is_name(Context& context, const char* what, const std::string& name) {
  if (!config::is_node_name(name)) {
    context.out.error(
        fmt::format("'{}' is not a valid {} name: use up to 40 letters, digits, '_' and '-'", name, what));
    return false;
  }
  return true;
}

int add_tool(Context& context, const KeysRequest& request, const keys::PlantKeys& keys) {
  if (!request.boards.empty() || (request.read.empty() && request.write.empty())) {
    context.out.error(
        "say what the tool may do, and no board: indurop keys add --tool NAME --read 'cell::*' --write cell::target");
    return kUsage;
  }
  if (!is_name(context, "tool", request.tool)) {
    return kUsage;
  }
  if (const auto done = keys.add_tool(request.tool, {request.read, request.write}, until(request)); !done) {
    context.out.error(done.error().text);
    return kFailed;
  }
  context.out.line(fmt::format("made {}", keys.tool(request.tool).string()));
  context.out.note(
      fmt::format("copy it to where the tool runs, for its user alone. Other lists: change variables.txt in it, then "
                  "indurop keys renew {}, and copy permissions.p7s and identity.pem",
                  request.tool));
  return kOk;
}

int add_viewer(Context& context, const KeysRequest& request, const keys::PlantKeys& keys) {
  if (!is_name(context, "viewer", request.viewer)) {
    return kUsage;
  }
  if (const auto done = keys.add_viewer(request.viewer, until(request)); !done) {
    context.out.error(done.error().text);
    return kFailed;
  }
  context.out.line(fmt::format("made {}", keys.viewer(request.viewer).string()));
  context.out.note("copy it to the machine that looks, for its user alone");
  return kOk;
}

int add_user(Context& context, const KeysRequest& request, const keys::PlantKeys& keys) {
  if (!is_name(context, "user", request.user)) {
    return kUsage;
  }
  if (const auto done = keys.add_user(request.user, until(request)); !done) {
    context.out.error(done.error().text);
    return kFailed;
  }
  context.out.line(fmt::format("made {}", keys.user(request.user).string()));
  context.out.note(fmt::format(
      "copy it to the machine of {0}, for {0} alone. What {0} may do is in the list of users: indurop users add {0} "
      "--role ROLE --no-password, then indurop users send",
      request.user));
  return kOk;
}

int add_deployer(Context& context, const KeysRequest& request, const keys::PlantKeys& keys) {
  if (!is_name(context, "deployer", request.deployer)) {
    return kUsage;
  }
  if (const auto done = keys.add_deployer(request.deployer, until(request)); !done) {
    context.out.error(done.error().text);
    return kFailed;
  }
  context.out.line(fmt::format("made {}", keys.deployer(request.deployer).string()));
  context.out.note(fmt::format(
      "next: indurop keys send --dir {}, so that the boards know it; then copy the new folder to the machine "
      "that deploys, for its user alone",
      keys.folder().string()));
  return kOk;
}

// Participants other than boards are named by an option, one at a time.
std::optional<int> add_other(Context& context, const KeysRequest& request, const keys::PlantKeys& keys) {
  const int kinds = (request.tool.empty() ? 0 : 1) + (request.viewer.empty() ? 0 : 1) + (request.user.empty() ? 0 : 1) +
                    (request.deployer.empty() ? 0 : 1);
  if (kinds == 0) {
    return std::nullopt;
  }
  if (kinds > 1 ||
      (request.tool.empty() && (!request.boards.empty() || !request.read.empty() || !request.write.empty()))) {
    context.out.error("name one viewer, user, deployer or tool, and nothing else; --read and --write are for tools");
    return kUsage;
  }
  if (!request.tool.empty()) {
    return add_tool(context, request, keys);
  }
  if (!request.viewer.empty()) {
    return add_viewer(context, request, keys);
  }
  return !request.user.empty() ? add_user(context, request, keys) : add_deployer(context, request, keys);
}

}  // namespace

int add_keys(Context& context, const KeysRequest& request) {
  const keys::PlantKeys keys = keys_of(request);
  if (!usable(context, keys)) {
    return kFailed;
  }
  if (const auto done = add_other(context, request, keys)) {
    return *done;
  }
  if (request.boards.empty() || !request.read.empty() || !request.write.empty()) {
    context.out.error(
        request.boards.empty()
            ? "name a board: indurop keys add BOARD, or a --viewer NAME, --user NAME, --deployer NAME or --tool NAME"
            : "--read and --write are for tools: --tool NAME");
    return kUsage;
  }
  for (const std::string& board : request.boards) {
    if (!is_name(context, "board", board)) {
      return kUsage;
    }
  }
  for (const std::string& board : request.boards) {
    if (const auto done = keys.add(board, until(request)); !done) {
      context.out.error(done.error().text);
      return kFailed;
    }
    context.out.line(fmt::format("made {}", keys.board(board).string()));
  }
  return kOk;
}

int make_server(Context& context, const KeysRequest& request) {
  const keys::PlantKeys keys = keys_of(request);
  if (!usable(context, keys) || !is_name(context, "server", request.boards.front())) {
    return kFailed;
  }
  for (const std::string& host : request.hosts) {
    if (!keys::is_host(host)) {
      context.out.error(
          fmt::format("'{}' is neither an address nor a name of a host; write 192.168.1.5 or cell.local", host));
      return kUsage;
    }
  }
  const keys::Instant end = keys::instant_now() + std::chrono::days(request.server_days);
  const auto made = keys::make_server_keys(keys.folder(), request.boards.front(), request.hosts, end,
                                           request.opcua ? keys::ServerKind::OpcUa : keys::ServerKind::Tls);
  if (!made) {
    context.out.error(made.error().text);
    return kFailed;
  }
  context.out.line(fmt::format("made {} for {}, valid until {}", made->folder.string(), fmt::join(request.hosts, ", "),
                               keys::utc_text(end).substr(0, 10)));
  if (request.opcua) {
    context.out.note(
        fmt::format("next: copy the folder to that host and start indurop-opcua --bind ADDRESS --host {} "
                    "--cert {} --key {} there; clients trust it once they have {}/ca.pem as an authority",
                    request.hosts.front(), made->certificate.string(), made->key.string(), keys.folder().string()));
    return kOk;
  }
  context.out.note(fmt::format(
      "next: copy the folder to that host and start indurop serve --bind ADDRESS --cert {} --key {} --users "
      "FILE there; browsers trust it once they have {}/ca.pem as an authority",
      made->certificate.string(), made->key.string(), keys.folder().string()));
  return kOk;
}

}  // namespace indurop::tools
