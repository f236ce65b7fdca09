// SPDX-License-Identifier: Apache-2.0
// indurop keys: manages who may take part in a plant.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>

#include "core/keys/plant_keys.h"
#include "tools/cli/command/pattern_option.h"
#include "tools/cli/verbs/keys_request.h"
#include "tools/cli/verbs/verbs.h"
#include "tools/client/text/suggest.h"

namespace indurop::tools {
namespace {

const char* to_text(keys::Role role) {
  switch (role) {
    case keys::Role::Board:
      return "board";
    case keys::Role::Viewer:
      return "viewer";
    case keys::Role::Deployer:
      return "deployer";
    case keys::Role::Tool:
      return "tool";
    case keys::Role::User:
      return "user";
  }
  return "";
}

int list(Context& context, const KeysRequest& request) {
  const keys::PlantKeys keys = keys_of(request);
  if (!usable(context, keys)) {
    return kFailed;
  }
  const keys::Instant now = keys::instant_now();
  Table table({{"ROLE", "role"},
               {"NAME", "name"},
               {"VALID UNTIL", "valid_until"},
               {"DAYS", "days_left", Align::Right},
               {"PROBLEM", "problem", Align::Left, 1},
               {"FOLDER", "folder", Align::Left, 2},
               {"READS", "reads", Align::Left, 3},
               {"SETS", "sets", Align::Left, 3}});
  bool ok = true;
  std::vector<std::string> exposed;
  for (const keys::KeyListing& each : keys.list(now)) {
    const auto days = std::chrono::floor<std::chrono::days>(each.validity.until - now).count();
    const bool is_known = each.validity.until != keys::Instant{};  // its certificate was read
    table.add({Cell(to_text(each.role)), Cell(each.name),
               is_known ? Cell(keys::utc_text(each.validity.until)) : Cell("-", JsonValue()),
               is_known ? Cell(std::to_string(days), JsonValue(days)) : Cell("-", JsonValue()), Cell(each.problem),
               Cell(each.folder.string()),
               Cell(fmt::format("{}", fmt::join(each.variables.read, " ")), each.variables.read),
               Cell(fmt::format("{}", fmt::join(each.variables.write, " ")), each.variables.write)});
    ok = ok && (each.problem.empty() || each.revoked);
    if (!each.exposed.empty()) {
      exposed.push_back(each.exposed);
    }
  }
  print_table(context, table, {{"plant", keys.plant()}, {"folder", keys.folder().string()}}, "keys");
  for (const std::string& key : exposed) {
    context.out.note("warning: " + key);
  }
  return ok ? kOk : kFailed;
}

// Returns the named keys, a board before others of the same name; empty after an error.
std::vector<keys::KeyListing> chosen(Context& context, const keys::PlantKeys& keys,
                                     const std::vector<std::string>& names) {
  const std::vector<keys::KeyListing> all = keys.list(keys::instant_now());
  std::vector<std::string> known;
  std::transform(all.begin(), all.end(), std::back_inserter(known), [](const auto& each) { return each.name; });
  std::vector<keys::KeyListing> found;
  for (const std::string& name : names) {
    const auto at = std::find(known.begin(), known.end(), name);
    if (at == known.end()) {
      context.out.error(
          fmt::format("there are no keys of '{}' in {}.{}", name, keys.folder().string(), did_you_mean(name, known)));
      return {};
    }
    found.push_back(all[static_cast<std::size_t>(at - known.begin())]);
  }
  return found;
}

int renew(Context& context, const KeysRequest& request) {
  const keys::PlantKeys keys = keys_of(request);
  if (!usable(context, keys)) {
    return kFailed;
  }
  std::vector<keys::KeyListing> whose;
  if (request.boards.empty()) {
    whose = keys.list(keys::instant_now());
    std::erase_if(whose, [](const keys::KeyListing& each) { return each.revoked; });
  } else {
    whose = chosen(context, keys, request.boards);
  }
  for (const keys::KeyListing& each : whose) {
    if (each.revoked) {
      context.out.error(fmt::format("{} was revoked; move {} away and give it new keys: {}", each.name,
                                    each.folder.string(), keys::how_to_add(each.role, each.name)));
      return kFailed;
    }
    if (const auto done = keys.renew(each, until(request)); !done) {
      context.out.error(done.error().text);
      return kFailed;
    }
    context.out.line(fmt::format("{} is valid until {}: copy identity.pem and permissions.p7s of {} to it", each.name,
                                 keys::utc_text(until(request)).substr(0, 10), each.folder.string()));
  }
  return whose.empty() ? kFailed : kOk;
}

void note_next(Context& context, const keys::PlantKeys& keys) {
  context.out.note(fmt::format("next: indurop keys send --dir {}, so that the boards know it", keys.folder().string()));
}

int revoke(Context& context, const KeysRequest& request) {
  const keys::PlantKeys keys = keys_of(request);
  if (!usable(context, keys)) {
    return kFailed;
  }
  const auto whose = chosen(context, keys, request.boards);
  for (const keys::KeyListing& each : whose) {
    if (const auto done = keys.revoke(each); !done) {
      context.out.error(done.error().text);
      return kFailed;
    }
    context.out.line(fmt::format("{} is revoked", each.name));
  }
  if (!whose.empty()) {
    note_next(context, keys);
  }
  return whose.empty() ? kFailed : kOk;
}

int finish_rotation(Context& context, const keys::PlantKeys& keys) {
  const auto ended = keys.finish_rotation();
  if (!ended) {
    context.out.error(ended.error().text);
    return kFailed;
  }
  if (*ended == 0) {
    context.out.note("there is no former key: nothing was changed");
    return kOk;
  }
  context.out.line(
      fmt::format("{} invalid now", *ended == 1 ? "1 former key is" : fmt::format("{} former keys are", *ended)));
  note_next(context, keys);
  return kOk;
}

int rotate(Context& context, const KeysRequest& request) {
  const keys::PlantKeys keys = keys_of(request);
  if (!usable(context, keys)) {
    return kFailed;
  }
  if (request.finish) {
    if (!request.boards.empty()) {
      context.out.error("--finish is for all deployers: name none");
      return kUsage;
    }
    return finish_rotation(context, keys);
  }
  const auto whose =
      chosen(context, keys, request.boards.empty() ? std::vector<std::string>{"deployer"} : request.boards);
  for (const keys::KeyListing& each : whose) {
    if (each.role != keys::Role::Deployer || each.revoked) {
      context.out.error(fmt::format("{} is {}", each.name, each.revoked ? "revoked" : "no deployer"));
      return kFailed;
    }
  }
  for (const keys::KeyListing& each : whose) {
    if (const auto done = keys.rotate(each); !done) {
      context.out.error(done.error().text);
      return kFailed;
    }
    context.out.line(fmt::format("{} has a new key for deployments; its former one is valid, too", each.name));
    context.out.note(fmt::format(
        "next: indurop keys send --dir {0}; then copy {1}/deploy.key to where {2} deploys, and deploy once with it; "
        "then indurop keys rotate --finish",
        keys.folder().string(), each.folder.string(), each.name));
  }
  return whose.empty() ? kFailed : kOk;
}

void add_common(base::Options& verb, KeysRequest& request) {
  verb.add("--dir", "DIR", request.folder, "Folder of the keys (default: <security> of ./plant.xml, else ./keys)");
}

void add_days(base::Options& verb, KeysRequest& request) {
  verb.add("--days", "N", request.days, fmt::format("How long they are valid (default: {})", kDefaultDays))
      .range(1, kMostDays);
}

Action declare_keys(base::Options& app, Context& context) {
  auto request = std::make_shared<KeysRequest>();
  auto chosen_action = std::make_shared<Action>();
  const auto verb = [&](const char* name, const char* help, int (*action)(Context&, const KeysRequest&)) {
    base::Options& made = app.command(name, help, [request, chosen_action, action] {
      *chosen_action = [request, action](Context& c) { return action(c, *request); };
    });
    add_common(made, *request);
    return &made;
  };
  base::Options* made =
      verb("init", "Create an authority, and keys for the boards of a plant, a viewer and a deployer", &init_keys);
  made->add("plant", "PLANT", request->plant, "Manifest of the plant (default: plant.xml)");
  add_days(*made, *request);
  made = verb("add", "Create the keys of another board, viewer, user, deployer or tool", &add_keys);
  made->add("boards", "BOARD", request->boards, "Names of the boards");
  made->add("--tool", "NAME", request->tool,
            "A program that takes part in <external secure=\"on\">, instead of boards");
  made->add("--viewer", "NAME", request->viewer, "A user who may read, instead of boards");
  made->add("--user", "NAME", request->user, "A user of the plant's list (indurop users), instead of boards");
  made->add("--deployer", "NAME", request->deployer, "A user who may deploy, instead of boards");
  add_pattern_option(*made, "--read", request->read, "Variables it may read: names and patterns, separated by commas");
  add_pattern_option(*made, "--write", request->write, "Variables it may set, and read");
  add_days(*made, *request);
  add_format_option(*verb("list", "Show who has keys, and until when they are valid", &list), context,
                    {Format::Table, Format::Json, Format::Csv});
  made = verb("renew", "Issue new certificates for the same private keys", &renew);
  made->add("names", "NAME", request->boards, "Names of their owners (default: all)");
  add_days(*made, *request);
  made = verb("revoke", "Revoke certificates", &revoke);
  made->add("names", "NAME", request->boards, "Names of their owners").required();
  made =
      verb("rotate", "Create a new key with which deployers sign deployments; the previous one is valid until --finish",
           &rotate);
  made->add("names", "NAME", request->boards, "Names of the deployers (default: deployer)");
  made->flag("--finish", request->finish,
             "Invalidate the previous keys; all boards must already know the new ones (indurop keys send)");
  made =
      verb("send", "Tell the boards of the plant which of its keys are valid, after add --deployer, revoke and rotate",
           &send_keys);
  deploy::add_link_options(*made, request->link);
  made = verb("server", "Create or renew the TLS certificate of an indurop serve, so that browsers trust it",
              &make_server);
  made->add("name", "NAME", request->boards, "Name of the server; its files go to servers/NAME").required();
  made->add("--host", "HOST", request->hosts, "Addresses and names under which clients reach it").required();
  made->flag("--opcua", request->opcua, "Create it for indurop-opcua instead; the first --host is the name in its URI");
  made->add("--days", "N", request->server_days, fmt::format("How long it is valid (default: {})", kServerDays))
      .range(1, kMostDays);
  return [chosen_action](Context& c) { return (*chosen_action)(c); };
}

}  // namespace

const Verb kKeysVerb{
    "keys", "Before it runs", "Create and list the keys of a plant",
    "Once the manifest contains <security>keys</security>, only holders of keys of the plant can read or write\n"
    "its variables. docs/security.md describes which file belongs where. Private keys are readable only by their\n"
    "owner and are never replaced.\n"
    "Examples:\n"
    "  indurop keys init plant.xml --dir keys\n"
    "  indurop keys list --dir keys\n"
    "  indurop keys add --tool panel --read 'cell::*' --write cell::target\n"
    "  indurop keys add --deployer anna\n"
    "  indurop keys send\n"
    "  indurop keys server desk --host 192.168.1.5 cell.local\n",
    &declare_keys};

}  // namespace indurop::tools
