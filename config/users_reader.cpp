// SPDX-License-Identifier: Apache-2.0
#include "config/users_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>
#include <optional>

#include "config/xml/attributes.h"
#include "config/xml/document.h"
#include "config/xml/element_rules.h"
#include "core/base/text.h"
#include "core/base/xml_text.h"
#include "core/keys/password.h"
#include "core/keys/variable_rights.h"

namespace indurop::config {
namespace {

constexpr DocumentKind kUsersXml{"users.xml", "<users> with one <user> per person or program"};

std::vector<std::string> read_patterns(Attributes& attributes, const char* name) {
  base::SourcePlace place;
  const auto text = attributes.text(name, &place);
  if (!text) {
    return {};
  }
  std::vector<std::string> patterns = keys::pattern_list(*text);
  for (const std::string& pattern : patterns) {
    if (const std::string wrong = keys::pattern_problem(pattern); !wrong.empty()) {
      attributes.report().error(place, fmt::format("{}: {}", name, wrong));
    }
  }
  return patterns;
}

// A hash is a secret: a wrong one is not repeated in the message.
std::string read_hash(Attributes& attributes, const char* name, bool (*sound)(std::string_view), const char* remedy) {
  base::SourcePlace place;
  const auto text = attributes.text(name, &place);
  if (text && !sound(*text)) {
    attributes.report().error(place, fmt::format("{}: this is no hash that this release knows; {}", name, remedy));
  }
  return text.value_or("");
}

PlantUser read_user(const base::Element& element, base::Diagnostics& report) {
  Attributes attributes(element, report);
  PlantUser user;
  base::SourcePlace place;
  if (const auto name = attributes.need("name", "name=\"anna\"", &place)) {
    user.name = *name;
    if (!is_user_name(user.name)) {
      report.error(place, fmt::format("name: {} is not a valid user name; use up to 40 letters, digits, '.', '_' and "
                                      "'-'",
                                      base::in_quotes(user.name)));
    }
  }
  if (attributes.need("role", "role=\"operate\"")) {
    const std::vector<std::string> words(kUserRoleNames.begin(), kUserRoleNames.end());
    user.role = static_cast<UserRole>(attributes.choose("role", words).value_or(0));
  }
  user.boards = read_patterns(attributes, "boards");
  user.variables = read_patterns(attributes, "variables");
  user.password = read_hash(attributes, "password", &keys::is_password_hash, "indurop users password NAME sets one");
  user.token = read_hash(attributes, "token", &keys::is_token_hash, "indurop users token NAME makes one");
  attributes.finish();
  check_no_text(element, report);
  return user;
}

void interpret_users(const base::Element& root, PlantUsers& users, base::Diagnostics& report) {
  if (root.name != "users") {
    report.error(root.place, fmt::format("the root element is <{}>, not the one of a {}: that is {}", root.name,
                                         kUsersXml.name, kUsersXml.form));
    return;
  }
  check_root_attributes(root, {}, report);
  check_no_text(root, report);
  std::map<std::string, int> lines;
  for (const base::Element& child : root.children) {
    if (!is_known(child, root, {"user"}, report)) {
      continue;
    }
    PlantUser user = read_user(child, report);
    const auto [first, is_new] = lines.try_emplace(user.name, child.place.line);
    if (!is_new && !user.name.empty()) {
      report.error(child.place, fmt::format("a second user {}, the first is in line {}; remove one of them",
                                            base::in_quotes(user.name), first->second));
    }
    users.users.push_back(std::move(user));
  }
}

std::string attribute(const char* name, const std::string& value) {
  return value.empty() ? std::string() : fmt::format(" {}=\"{}\"", name, base::xml_text(value));
}

}  // namespace

ReadUsers read_users(const std::filesystem::path& file) {
  const auto bytes = read_bytes(file, kUsersXml);
  if (bytes) {
    return read_users_text(*bytes, file);
  }
  ReadUsers result;
  result.users.file = file;
  result.diagnostics.push_back(bytes.error());
  return result;
}

ReadUsers read_users_text(std::string_view xml, const std::filesystem::path& pretend_file) {
  ReadUsers result;
  result.users.file = pretend_file;
  if (const auto root = read_document(xml, pretend_file, kUsersXml, result.diagnostics)) {
    base::Diagnostics report(pretend_file.string(), result.diagnostics);
    interpret_users(*root, result.users, report);
    report.add_summary(result.diagnostics);
    base::sort_by_place(result.diagnostics);
  }
  return result;
}

std::string users_text(const std::vector<PlantUser>& users) {
  std::string text = "<!-- Users of a plant: indurop users changes this file. -->\n<users>\n";
  for (const PlantUser& user : users) {
    text += fmt::format("  <user name=\"{}\" role=\"{}\"{}{}{}{}/>\n", base::xml_text(user.name), name_of(user.role),
                        attribute("boards", fmt::format("{}", fmt::join(user.boards, ","))),
                        attribute("variables", fmt::format("{}", fmt::join(user.variables, ","))),
                        attribute("password", user.password), attribute("token", user.token));
  }
  return text + "</users>\n";
}

bool is_user_name(std::string_view name) noexcept {
  constexpr std::size_t kLongest = 40;
  return !name.empty() && name.size() <= kLongest && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '.' || c == '_' ||
           c == '-';
  });
}

}  // namespace indurop::config
