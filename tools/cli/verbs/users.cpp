// SPDX-License-Identifier: Apache-2.0
// indurop users: the people and programs that a plant's servers let in, and the role of each.
#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <memory>
#include <optional>

#include "config/users_reader.h"
#include "core/base/descriptor.h"
#include "core/base/file_problem.h"
#include "core/base/replace_file.h"
#include "core/keys/password.h"
#include "core/rt/file_lock.h"
#include "tools/cli/command/password_prompt.h"
#include "tools/cli/command/pattern_option.h"
#include "tools/cli/verbs/users_send.h"
#include "tools/cli/verbs/verbs.h"
#include "tools/client/process/random_word.h"
#include "tools/client/text/suggest.h"
#include "tools/client/text/units.h"
#include "tools/console/diagnostics.h"

namespace indurop::tools {
namespace {

namespace fs = std::filesystem;

struct UsersRequest {
  fs::path file = "users.xml";
  std::string name;
  std::string role;
  std::vector<std::string> boards;
  std::vector<std::string> variables;
  bool no_password = false;
  bool no_limits = false;
  std::string plant;
  deploy::LinkSettings link;
};

std::vector<std::string> role_words() {
  return {config::kUserRoleNames.begin(), config::kUserRoleNames.end()};
}

config::UserRole role_of(const std::string& word) {
  const std::vector<std::string> words = role_words();
  return static_cast<config::UserRole>(std::find(words.begin(), words.end(), word) - words.begin());
}

// Returns the users of the file; of one that is not there yet none. Nothing after errors, with the exit code in `code`.
std::optional<std::vector<config::PlantUser>> open_users(Context& context, const UsersRequest& request, int& code) {
  std::error_code ignored;
  if (!fs::exists(request.file, ignored)) {
    return std::vector<config::PlantUser>();
  }
  config::ReadUsers read = config::read_users(request.file);
  if (!read.ok()) {
    print_diagnostics(context, read.diagnostics, false);
    code = kCheckFailed;
    return std::nullopt;
  }
  return std::move(read.users.users);
}

int save(Context& context, const UsersRequest& request, const std::vector<config::PlantUser>& users) {
  constexpr mode_t kOwnerAndGroup = 0640;
  const auto done = base::replace_file(request.file, config::users_text(users), base::Durable::Yes, kOwnerAndGroup);
  if (!done) {
    context.out.error(base::cannot_write(request.file.string(), done.error()));
    return kFailed;
  }
  return kOk;
}

// Returns the user who was named, or the end after an error.
std::vector<config::PlantUser>::iterator find_user(Context& context, const UsersRequest& request,
                                                   std::vector<config::PlantUser>& users) {
  const auto at = std::find_if(users.begin(), users.end(), [&](const auto& one) { return one.name == request.name; });
  if (at == users.end()) {
    std::vector<std::string> names;
    std::transform(users.begin(), users.end(), std::back_inserter(names), [](const auto& one) { return one.name; });
    context.out.error(fmt::format("there is no user '{}' in {}.{}", request.name, request.file.string(),
                                  did_you_mean(request.name, names)));
  }
  return at;
}

// Held from reading the list until it is saved, so that no change of another process is lost. The list itself is
// replaced by each change, so its folder is locked.
base::Descriptor lock_list(const UsersRequest& request) {
  const fs::path folder = request.file.parent_path();
  base::Descriptor lock(::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (lock.is_open()) {
    (void)rt::lock_file_when_free(lock.get(), rt::FileLock::Exclusive);  // not every file system has locks
  }
  return lock;
}

// Changes the user who was named, and saves the list. `change` returns what to say when it is saved; nothing after an
// error.
template <class Change>
int change_user(Context& context, const UsersRequest& request, const Change& change) {
  const base::Descriptor lock = lock_list(request);
  int code = kOk;
  auto users = open_users(context, request, code);
  if (!users) {
    return code;
  }
  const auto at = find_user(context, request, *users);
  if (at == users->end()) {
    return kFailed;
  }
  const std::optional<std::string> said = change(*users, at);
  code = said ? save(context, request, *users) : kFailed;
  if (code == kOk) {
    context.out.line(*said);
  }
  return code;
}

// Asks for a password. Returns its hash, or nothing after an error.
std::optional<std::string> ask_password(Context& context, const std::string& name) {
  const auto password = read_new_password(fmt::format("password of {}", name));
  if (!password) {
    context.out.error(password.error().text);
    return std::nullopt;
  }
  if (password->size() < keys::kShortestPassword || password->size() > keys::kLongestPassword) {
    context.out.error(
        fmt::format("a password has {} to {} characters", keys::kShortestPassword, keys::kLongestPassword));
    return std::nullopt;
  }
  return keys::hash_of_password(*password);
}

int list(Context& context, const UsersRequest& request) {
  std::error_code ignored;
  if (!fs::exists(request.file, ignored)) {
    context.out.error(
        fmt::format("there is no file {}; indurop users add NAME --role ROLE makes it", request.file.string()));
    return kFailed;
  }
  int code = kOk;
  const auto users = open_users(context, request, code);
  if (!users) {
    return code;
  }
  Table table({{"USER", "user"},
               {"ROLE", "role"},
               {"BOARDS", "boards"},
               {"VARIABLES", "variables"},
               {"SIGNS IN WITH", "signs_in_with"}});
  for (const config::PlantUser& user : *users) {
    std::vector<std::string> ways;
    if (!user.password.empty()) {
      ways.emplace_back("password");
    }
    if (!user.token.empty()) {
      ways.emplace_back("token");
    }
    const auto patterns = [](const std::vector<std::string>& all) {
      return Cell(all.empty() ? "all" : fmt::format("{}", fmt::join(all, " ")), all);
    };
    table.add({Cell(user.name), Cell(config::name_of(user.role)), patterns(user.boards), patterns(user.variables),
               Cell(ways.empty() ? "certificate" : fmt::format("{}", fmt::join(ways, ", ")), ways)});
  }
  print_table(context, table, {{"file", request.file.string()}}, "users");
  return kOk;
}

// Returns the list that the user can be added to; nothing after an error, with the exit code in `code`.
std::optional<std::vector<config::PlantUser>> users_without(Context& context, const UsersRequest& request, int& code) {
  auto users = open_users(context, request, code);
  if (users && std::any_of(users->begin(), users->end(), [&](const auto& one) { return one.name == request.name; })) {
    context.out.error(fmt::format("there is a user '{}' already; indurop users role {} ROLE changes the role",
                                  request.name, request.name));
    code = kFailed;
    return std::nullopt;
  }
  return users;
}

int add(Context& context, const UsersRequest& request) {
  if (!config::is_user_name(request.name)) {
    context.out.error(
        fmt::format("'{}' is not a valid user name; use up to 40 letters, digits, '.', '_' and '-'", request.name));
    return kUsage;
  }
  int code = kOk;
  if (!users_without(context, request, code)) {
    return code;
  }
  config::PlantUser user{request.name, role_of(request.role), request.boards, request.variables, {}, {}};
  if (!request.no_password) {
    auto hash = ask_password(context, request.name);
    if (!hash) {
      return kFailed;
    }
    user.password = std::move(*hash);
  }
  const base::Descriptor lock = lock_list(request);
  auto users = users_without(context, request, code);  // again: it may have changed while the password was asked for
  if (!users) {
    return code;
  }
  users->push_back(std::move(user));
  code = save(context, request, *users);
  if (code == kOk) {
    context.out.line(fmt::format("{} has the role {} now", request.name, request.role));
  }
  return code;
}

// A limit that is not named stays.
void set_limit(std::vector<std::string>& limit, const std::vector<std::string>& wanted, bool removed) {
  if (removed || !wanted.empty()) {
    limit = wanted;
  }
}

std::string limit_text(const char* of, const std::vector<std::string>& limit) {
  return limit.empty() ? "" : fmt::format(", limited to the {} {}", of, fmt::join(limit, ", "));
}

int set_role(Context& context, const UsersRequest& request) {
  if (request.no_limits && !(request.boards.empty() && request.variables.empty())) {
    context.out.error("--no-limits and a limit contradict each other");
    return kUsage;
  }
  return change_user(context, request, [&](auto& /*users*/, auto at) {
    at->role = role_of(request.role);
    set_limit(at->boards, request.boards, request.no_limits);
    set_limit(at->variables, request.variables, request.no_limits);
    return std::optional(fmt::format("{} has the role {} now{}{}", request.name, request.role,
                                     limit_text("boards", at->boards), limit_text("variables", at->variables)));
  });
}

int set_password(Context& context, const UsersRequest& request) {
  int code = kOk;
  auto users = open_users(context, request, code);
  if (!users) {
    return code;
  }
  if (find_user(context, request, *users) == users->end()) {
    return kFailed;
  }
  const auto hash = ask_password(context, request.name);
  if (!hash) {
    return kFailed;
  }
  return change_user(context, request, [&](auto& /*users*/, auto at) {
    at->password = *hash;
    return std::optional(fmt::format("{} has a new password; sessions with the former one end", request.name));
  });
}

int make_token(Context& context, const UsersRequest& request) {
  const int code = change_user(context, request, [&](auto& /*users*/, auto at) -> std::optional<std::string> {
    std::string token = random_word();
    if (token.empty()) {
      context.out.error("the system has no random numbers");
      return std::nullopt;
    }
    at->token = keys::hash_of_token(token);
    return token;
  });
  if (code == kOk) {
    context.out.note(
        "this token is shown once; a former one counts no more. Programs send it as "
        "'Authorization: Bearer TOKEN'");
  }
  return code;
}

int remove(Context& context, const UsersRequest& request) {
  return change_user(context, request, [&](auto& users, auto at) {
    users.erase(at);
    return std::optional(fmt::format("{} is removed; open sessions end", request.name));
  });
}

int send(Context& context, const UsersRequest& request) {
  int code = kOk;
  const auto users = open_users(context, request, code);
  return users ? send_users(context, *users, {request.plant, request.link}) : code;
}

Action declare_users(base::Options& app, Context& context) {
  auto request = std::make_shared<UsersRequest>();
  auto chosen = std::make_shared<Action>();
  const auto verb = [&](const char* name, const char* help, int (*action)(Context&, const UsersRequest&),
                        bool named) -> base::Options& {
    base::Options& made = app.command(name, help, [request, chosen, action] {
      *chosen = [request, action](Context& c) { return action(c, *request); };
    });
    if (named) {
      made.add("user", "USER", request->name, "Name of the user").required();
    }
    made.add("--file", "FILE", request->file, "The list of users (default: ./users.xml)")
        .completes(base::Completion::File);
    return made;
  };
  const auto add_limits = [&request](base::Options& made) {
    add_pattern_option(
        made, "--boards", request->boards,
        "Boards that the user may change: names and patterns, separated by commas (default for a new user: all)");
    add_pattern_option(made, "--variables", request->variables,
                       "Variables that the user may change; a user with this limit cannot change modules or locks "
                       "(default for a new user: all)");
  };
  add_format_option(verb("list", "Show the users and their roles", &list, false), context,
                    {Format::Table, Format::Json, Format::Csv});
  base::Options& adding = verb("add", "Add a user; the password is asked for, or read from standard input", &add, true);
  adding.add("--role", "ROLE", request->role, "What the user may do").choices(role_words()).required();
  add_limits(adding);
  adding.flag("--no-password", request->no_password, "For a user who has a certificate or gets a token");
  base::Options& changing = verb("role", "Change the role and limits of a user", &set_role, true);
  changing.add("role", "ROLE", request->role, "What the user may do").choices(role_words()).required();
  add_limits(changing);
  changing.flag("--no-limits", request->no_limits, "Remove the limits that the user has; without it they stay");
  verb("password", "Change the password of a user", &set_password, true);
  verb("token", "Create a token for a user, such as a program, and show it once", &make_token, true);
  verb("remove", "Remove a user", &remove, true);
  base::Options& sending =
      verb("send", "Send the list to the boards of a plant, for commands from other machines", &send, false);
  sending.add("--plant", "NAME", request->plant, "Name of the plant (default: the only one)");
  deploy::add_link_options(sending, request->link);
  return [chosen](Context& c) { return (*chosen)(c); };
}

}  // namespace

const Verb kUsersVerb{
    "users", "Before it runs", "Manage who may do what on the page and over HTTP",
    "With indurop serve --users FILE, the users in this file can sign in. Each role includes those before it:\n"
    "look: read. operate: set, load recipes, acknowledge alarms, jog. tune: force, save recipes, shelve alarms.\n"
    "program: start and stop modules, lock, roll back. administer: end other users' sessions.\n"
    "Boards with keys check users with a certificate (indurop keys add --user) against the list that indurop\n"
    "users send distributes. The file holds hashes of passwords and tokens. A change takes effect with the next\n"
    "request.\n"
    "Examples:\n"
    "  indurop users add anna --role administer\n"
    "  indurop users add ben --role operate --boards 'press*' --variables 'press::*'\n"
    "  indurop users add logger --role look --no-password\n"
    "  indurop users token logger\n"
    "  indurop users send --keys keys\n",
    &declare_users};

}  // namespace indurop::tools
