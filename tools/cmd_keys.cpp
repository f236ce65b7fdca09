// SPDX-License-Identifier: Apache-2.0
// indurop keys: who may take part in a plant.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "deploy/plant.h"
#include "deploy/plant_keys.h"
#include "deploy/plant_rules.h"
#include "tools/config_file.h"
#include "tools/suggest.h"
#include "tools/verbs.h"

namespace indurop::tools {
namespace {

namespace fs = std::filesystem;

constexpr int kDefaultDays = 3650;
constexpr int kMostDays = 36500;

struct Request {
  std::string folder;               // --dir
  std::string plant = "plant.xml";  // of init
  std::vector<std::string> boards;  // of add, renew, revoke
  int days = kDefaultDays;
};

deploy::Instant until(const Request& request) {
  return deploy::instant_now() + std::chrono::days(request.days);
}

// --dir, else what the manifest here says, else "keys".
deploy::PlantKeys keys_of(const Request& request) {
  if (!request.folder.empty()) {
    return deploy::PlantKeys(request.folder);
  }
  std::error_code ignored;
  if (fs::exists(request.plant, ignored)) {
    const deploy::ReadPlant read = deploy::read_plant(request.plant);
    return deploy::PlantKeys(read.plant.security.empty() ? fs::path(request.plant).parent_path() / "keys"
                                                         : read.plant.security.lexically_proximate(fs::current_path()));
  }
  return deploy::PlantKeys("keys");
}

const char* to_text(deploy::Role role) {
  switch (role) {
    case deploy::Role::Board:
      return "board";
    case deploy::Role::Viewer:
      return "viewer";
    case deploy::Role::Deployer:
      return "deployer";
  }
  return "";
}

// Keys must be there, and for changes the authority's private one.
bool usable(Context& context, const deploy::PlantKeys& keys) {
  if (keys.plant().empty()) {
    context.out.error(
        fmt::format("there are no keys in {}; make them with indurop keys init PLANT, or say with --dir "
                    "where they are",
                    keys.folder().string()));
    return false;
  }
  return true;
}

int list(Context& context, const Request& request) {
  const deploy::PlantKeys keys = keys_of(request);
  if (!usable(context, keys)) {
    return kFailed;
  }
  const deploy::Instant now = deploy::instant_now();
  Table table({{"ROLE", "role"},
               {"NAME", "name"},
               {"VALID UNTIL", "valid_until"},
               {"DAYS", "days_left", Align::Right},
               {"PROBLEM", "problem", Align::Left, 1},
               {"FOLDER", "folder", Align::Left, 2}});
  bool ok = true;
  for (const deploy::KeyListing& each : keys.list(now)) {
    const auto days = std::chrono::floor<std::chrono::days>(each.validity.until - now).count();
    table.add({Cell(to_text(each.role)), Cell(each.name), Cell(deploy::utc_text(each.validity.until)),
               Cell(std::to_string(days), JsonValue(days)), Cell(each.problem), Cell(each.folder.string())});
    ok = ok && (each.problem.empty() || each.revoked);
  }
  print_table(context, table, {{"plant", keys.plant()}, {"folder", keys.folder().string()}}, "keys");
  return ok ? kOk : kFailed;
}

void say_what_is_there(Context& context, const deploy::PlantKeys& keys) {
  std::string names;
  for (const deploy::KeyListing& each : keys.list(deploy::instant_now())) {
    names += (names.empty() ? "" : ", ") + each.name;
  }
  context.out.error(
      fmt::format("{} holds the keys of plant {} already, for {}; private keys are never replaced. A board that has "
                  "come: indurop keys add BOARD; an end that is near: indurop keys renew; all: indurop keys list",
                  keys.folder().string(), keys.plant(), names));
}

int init(Context& context, const Request& request) {
  std::error_code ignored;
  if (!fs::exists(request.plant, ignored)) {
    context.out.error(fmt::format("there is no file '{}'; name the manifest of the plant", request.plant));
    return kFailed;
  }
  const deploy::ReadPlant read = deploy::read_plant(request.plant);
  if (!read.ok()) {
    print_diagnostics(context, read.diagnostics, false);
    return kCheckFailed;
  }
  const deploy::PlantKeys keys = keys_of(request);
  if (keys.exist()) {
    say_what_is_there(context, keys);
    return kFailed;
  }
  std::vector<std::string> boards;
  for (const deploy::Board& board : read.plant.boards) {
    boards.push_back(board.name);
  }
  if (const std::string problem = keys.make(read.plant.name, boards, until(request)); !problem.empty()) {
    context.out.error(problem);
    return kFailed;
  }
  context.out.line(fmt::format("made the keys of plant {} in {}: for {}, a viewer and a deployer, valid until {}",
                               read.plant.name, keys.folder().string(), counted(boards.size(), "board"),
                               deploy::utc_text(until(request)).substr(0, 10)));
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

int add(Context& context, const Request& request) {
  const deploy::PlantKeys keys = keys_of(request);
  if (!usable(context, keys)) {
    return kFailed;
  }
  for (const std::string& board : request.boards) {
    if (!deploy::is_node_name(board)) {
      context.out.error(fmt::format("'{}' is no name of a board: use up to 40 letters, digits, '_' and '-'", board));
      return kUsage;
    }
  }
  for (const std::string& board : request.boards) {
    if (const std::string problem = keys.add(board, until(request)); !problem.empty()) {
      context.out.error(problem);
      return kFailed;
    }
    context.out.line(fmt::format("made {}", keys.board(board).string()));
  }
  return kOk;
}

// Those that are named, boards before others of the same name; empty after an error.
std::vector<deploy::KeyListing> chosen(Context& context, const deploy::PlantKeys& keys,
                                       const std::vector<std::string>& names) {
  const std::vector<deploy::KeyListing> all = keys.list(deploy::instant_now());
  std::vector<std::string> known;
  std::transform(all.begin(), all.end(), std::back_inserter(known), [](const auto& each) { return each.name; });
  std::vector<deploy::KeyListing> found;
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

int renew(Context& context, const Request& request) {
  const deploy::PlantKeys keys = keys_of(request);
  if (!usable(context, keys)) {
    return kFailed;
  }
  std::vector<deploy::KeyListing> whose;
  if (request.boards.empty()) {
    whose = keys.list(deploy::instant_now());
    std::erase_if(whose, [](const deploy::KeyListing& each) { return each.revoked; });
  } else {
    whose = chosen(context, keys, request.boards);
  }
  for (const deploy::KeyListing& each : whose) {
    const std::string problem =
        each.revoked ? fmt::format("{} was revoked; move {} away and give it new keys: indurop keys add {}", each.name,
                                   each.folder.string(), each.name)
                     : keys.renew(each, until(request));
    if (!problem.empty()) {
      context.out.error(problem);
      return kFailed;
    }
    context.out.line(fmt::format("{} is valid until {}: copy identity.pem and permissions.p7s of {} to it", each.name,
                                 deploy::utc_text(until(request)).substr(0, 10), each.folder.string()));
  }
  return whose.empty() ? kFailed : kOk;
}

int revoke(Context& context, const Request& request) {
  const deploy::PlantKeys keys = keys_of(request);
  if (!usable(context, keys)) {
    return kFailed;
  }
  const auto whose = chosen(context, keys, request.boards);
  for (const deploy::KeyListing& each : whose) {
    if (const std::string problem = keys.revoke(each); !problem.empty()) {
      context.out.error(problem);
      return kFailed;
    }
    context.out.line(fmt::format("{} is revoked: copy revoked.pem to every board, and restart its node", each.name));
  }
  return whose.empty() ? kFailed : kOk;
}

void add_common(CLI::App* verb, Request& request) {
  verb->add_option("--dir", request.folder, "Folder of the keys (default: <security> of ./plant.xml, else ./keys)")
      ->type_name("DIR");
}

void add_days(CLI::App* verb, Request& request) {
  verb->add_option("--days", request.days, fmt::format("How long they are valid (default: {})", kDefaultDays))
      ->check(CLI::Range(1, kMostDays).description(""))
      ->type_name("N");
}

Action declare(CLI::App& app, Context& context) {
  auto request = std::make_shared<Request>();
  auto chosen_action = std::make_shared<Action>();
  app.require_subcommand(1);
  const auto verb = [&](const char* name, const char* help, int (*action)(Context&, const Request&)) {
    CLI::App* made = app.add_subcommand(name, help);
    made->callback([request, chosen_action, action] {
      *chosen_action = [request, action](Context& c) { return action(c, *request); };
    });
    made->fallthrough();
    add_common(made, *request);
    return made;
  };
  CLI::App* made = verb("init", "Make an authority, keys for the boards of a plant, a viewer and a deployer", &init);
  made->add_option("plant", request->plant, "Manifest of the plant (default: plant.xml)")->type_name("PLANT");
  add_days(made, *request);
  made = verb("add", "Make the keys of a further board", &add);
  made->add_option("boards", request->boards, "Names of the boards")->required()->type_name("BOARD");
  add_days(made, *request);
  add_format_option(*verb("list", "Show who has keys, and until when they are valid", &list), context,
                    {Format::Table, Format::Json, Format::Csv});
  made = verb("renew", "Issue new certificates for the same private keys", &renew);
  made->add_option("names", request->boards, "Whose (default: all)")->type_name("NAME");
  add_days(made, *request);
  made = verb("revoke", "Make certificates void", &revoke);
  made->add_option("names", request->boards, "Whose")->required()->type_name("NAME");
  return [chosen_action](Context& c) { return (*chosen_action)(c); };
}

}  // namespace

const Verb kKeysVerb{"keys", "Before it runs", "Make and list the keys of a plant",
                     "Only who has keys of the plant can read or write its variables once the manifest says\n"
                     "<security>keys</security>. docs/security.md tells which file goes where.\n"
                     "Private keys are readable by their owner alone and never replaced.\n",
                     &declare};

}  // namespace indurop::tools
