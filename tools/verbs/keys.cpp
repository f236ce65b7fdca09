// SPDX-License-Identifier: Apache-2.0
// indurop keys: who may take part in a plant.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "config/xml/plant_reader.h"
#include "config/xml/plant_rules.h"
#include "keys/plant_keys.h"
#include "tools/command/config_file.h"
#include "tools/command/suggest.h"
#include "tools/verbs/verbs.h"

namespace indurop::tools {
namespace {

namespace fs = std::filesystem;

constexpr int kDefaultDays = 3650;
constexpr int kMostDays = 36500;

struct Request {
  std::string folder;               // --dir
  std::string plant = "plant.xml";  // of init
  std::vector<std::string> boards;  // of add, renew, revoke
  std::string tool;                 // of add
  std::vector<std::string> read;    // patterns of variables
  std::vector<std::string> write;
  int days = kDefaultDays;
};

keys::Instant until(const Request& request) {
  return keys::instant_now() + std::chrono::days(request.days);
}

// --dir, else what the manifest here says, else "keys".
keys::PlantKeys keys_of(const Request& request) {
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
  }
  return "";
}

// Keys must be there, and for changes the authority's private one.
bool usable(Context& context, const keys::PlantKeys& keys) {
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
  for (const keys::KeyListing& each : keys.list(now)) {
    const auto days = std::chrono::floor<std::chrono::days>(each.validity.until - now).count();
    table.add({Cell(to_text(each.role)), Cell(each.name), Cell(keys::utc_text(each.validity.until)),
               Cell(std::to_string(days), JsonValue(days)), Cell(each.problem), Cell(each.folder.string()),
               Cell(fmt::format("{}", fmt::join(each.variables.read, " ")), each.variables.read),
               Cell(fmt::format("{}", fmt::join(each.variables.write, " ")), each.variables.write)});
    ok = ok && (each.problem.empty() || each.revoked);
  }
  print_table(context, table, {{"plant", keys.plant()}, {"folder", keys.folder().string()}}, "keys");
  return ok ? kOk : kFailed;
}

void say_what_is_there(Context& context, const keys::PlantKeys& keys) {
  std::string names;
  for (const keys::KeyListing& each : keys.list(keys::instant_now())) {
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
  const config::ReadPlant read = config::read_plant(request.plant);
  if (!read.ok()) {
    print_diagnostics(context, read.diagnostics, false);
    return kCheckFailed;
  }
  const keys::PlantKeys keys = keys_of(request);
  if (keys.exist()) {
    say_what_is_there(context, keys);
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

bool is_name(Context& context, const char* what, const std::string& name) {
  if (!config::is_node_name(name)) {
    context.out.error(
        fmt::format("'{}' is not a valid {} name: use up to 40 letters, digits, '_' and '-'", name, what));
    return false;
  }
  return true;
}

int add_tool(Context& context, const Request& request, const keys::PlantKeys& keys) {
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

int add(Context& context, const Request& request) {
  const keys::PlantKeys keys = keys_of(request);
  if (!usable(context, keys)) {
    return kFailed;
  }
  if (!request.tool.empty()) {
    return add_tool(context, request, keys);
  }
  if (request.boards.empty() || !request.read.empty() || !request.write.empty()) {
    context.out.error(request.boards.empty() ? "name a board: indurop keys add BOARD, or a tool: --tool NAME"
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

// Those that are named, boards before others of the same name; empty after an error.
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

int renew(Context& context, const Request& request) {
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
      context.out.error(fmt::format("{} was revoked; move {} away and give it new keys: indurop keys add {}", each.name,
                                    each.folder.string(), each.name));
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

int revoke(Context& context, const Request& request) {
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
    context.out.line(fmt::format("{} is revoked: copy revoked.pem to every board, and restart its node", each.name));
  }
  return whose.empty() ? kFailed : kOk;
}

void add_common(base::Options& verb, Request& request) {
  verb.add("--dir", "DIR", request.folder, "Folder of the keys (default: <security> of ./plant.xml, else ./keys)");
}

void add_days(base::Options& verb, Request& request) {
  verb.add("--days", "N", request.days, fmt::format("How long they are valid (default: {})", kDefaultDays))
      .range(1, kMostDays);
}

void add_patterns(base::Options& verb, const char* name, std::vector<std::string>& to, const char* help) {
  const auto take = [&to](const std::string& text) {
    std::string wrong;
    for (std::string& pattern : keys::pattern_list(text)) {
      wrong = wrong.empty() ? keys::pattern_problem(pattern) : wrong;
      to.push_back(std::move(pattern));
    }
    return wrong;
  };
  verb.add(name, "PATTERNS", take, help);
}

Action declare(base::Options& app, Context& context) {
  auto request = std::make_shared<Request>();
  auto chosen_action = std::make_shared<Action>();
  const auto verb = [&](const char* name, const char* help, int (*action)(Context&, const Request&)) {
    base::Options& made = app.command(name, help, [request, chosen_action, action] {
      *chosen_action = [request, action](Context& c) { return action(c, *request); };
    });
    add_common(made, *request);
    return &made;
  };
  base::Options* made =
      verb("init", "Make an authority, keys for the boards of a plant, a viewer and a deployer", &init);
  made->add("plant", "PLANT", request->plant, "Manifest of the plant (default: plant.xml)");
  add_days(*made, *request);
  made = verb("add", "Make the keys of a further board, or of a tool", &add);
  made->add("boards", "BOARD", request->boards, "Names of the boards");
  made->add("--tool", "NAME", request->tool,
            "A program that takes part in <external secure=\"on\">, instead of boards");
  add_patterns(*made, "--read", request->read, "Variables it may read: names and patterns, with commas between them");
  add_patterns(*made, "--write", request->write, "Variables it may set, and read");
  add_days(*made, *request);
  add_format_option(*verb("list", "Show who has keys, and until when they are valid", &list), context,
                    {Format::Table, Format::Json, Format::Csv});
  made = verb("renew", "Issue new certificates for the same private keys", &renew);
  made->add("names", "NAME", request->boards, "Whose (default: all)");
  add_days(*made, *request);
  made = verb("revoke", "Make certificates void", &revoke);
  made->add("names", "NAME", request->boards, "Whose").required();
  return [chosen_action](Context& c) { return (*chosen_action)(c); };
}

}  // namespace

const Verb kKeysVerb{"keys", "Before it runs", "Make and list the keys of a plant",
                     "Only holders of keys of the plant can read or write its variables once the manifest says\n"
                     "<security>keys</security>. docs/security.md tells which file belongs where.\n"
                     "Private keys are readable by their owner alone and never replaced.\n"
                     "Examples:\n"
                     "  indurop keys init plant.xml --dir keys\n"
                     "  indurop keys list --dir keys\n"
                     "  indurop keys add --tool panel --read 'cell::*' --write cell::target\n",
                     &declare};

}  // namespace indurop::tools
