// SPDX-License-Identifier: Apache-2.0
// Users of a plant, and what each may do (users.xml).

#pragma once

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace indurop::config {

// Each role includes the rights of those before it.
enum class UserRole {
  Look,        // read everything
  Operate,     // set variables, load recipes, acknowledge alarms, jog
  Tune,        // force variables, save and remove recipes, shelve alarms
  Program,     // start and stop modules, lock, deploy, roll back
  Administer,  // end sessions of others
};
inline constexpr std::array<const char*, 5> kUserRoleNames{"look", "operate", "tune", "program", "administer"};
constexpr const char* name_of(UserRole role) noexcept {
  return kUserRoleNames.at(static_cast<std::size_t>(role));
}

// One of `password` and `token` may be empty.
struct PlantUser {
  std::string name;
  UserRole role = UserRole::Look;
  std::vector<std::string> boards;     // patterns over names of boards he may change; none: all
  std::vector<std::string> variables;  // patterns over full names of variables he may change; none: all
  std::string password;                // keys::hash_of_password()
  std::string token;                   // keys::hash_of_token()
};

struct PlantUsers {
  std::filesystem::path file;
  std::vector<PlantUser> users;

  [[nodiscard]] const PlantUser* find(std::string_view name) const noexcept {
    const auto at = std::find_if(users.begin(), users.end(), [&](const PlantUser& one) { return one.name == name; });
    return at != users.end() ? &*at : nullptr;
  }
};

}  // namespace indurop::config
