// SPDX-License-Identifier: Apache-2.0
// users.xml: what it says, what is refused, and that what is written is read again.

#include "config/users_reader.h"

#include <random>

#include "configuration.h"
#include "core/keys/password.h"

namespace indurop::config {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string kHash =
    "scrypt:15:8:1:000102030405060708090a0b0c0d0e0f:5c662628ac4eb1068a287e2aa2a202ae248e98db04d61d3327e7342db6ec7097";

std::vector<std::string> user_problems(const std::string& xml) {
  return lines(read_users_text(xml, "users.xml").diagnostics);
}

TEST(UsersReader, Reads_roles_limits_and_hashes) {
  const ReadUsers sut = read_users_text(
      "<users>\n"
      "  <user name=\"anna\" role=\"administer\" password=\"" +
          kHash +
          "\"/>\n"
          "  <user name=\"b.en-2\" role=\"operate\" boards=\"press*, table\"\n"
          "        variables=\"press::*\" token=\"" +
          keys::hash_of_token("x") +
          "\"/>\n"
          "</users>\n",
      "users.xml");
  ASSERT_THAT(lines(sut.diagnostics), IsEmpty());
  ASSERT_EQ(sut.users.users.size(), 2U);
  const PlantUser* const anna = sut.users.find("anna");
  ASSERT_NE(anna, nullptr);
  EXPECT_EQ(anna->role, UserRole::Administer);
  EXPECT_EQ(anna->password, kHash);
  EXPECT_THAT(anna->boards, IsEmpty());
  const PlantUser* const ben = sut.users.find("b.en-2");
  ASSERT_NE(ben, nullptr);
  EXPECT_EQ(ben->role, UserRole::Operate);
  EXPECT_THAT(ben->boards, ElementsAre("press*", "table"));
  EXPECT_THAT(ben->variables, ElementsAre("press::*"));
  EXPECT_EQ(sut.users.find("ann"), nullptr);
}

TEST(UsersReader, Refuses_all_mistakes_at_once_and_repeats_no_secret) {
  EXPECT_THAT(user_problems("<users>\n"
                            "  <user name=\"an na\" role=\"boss\"/>\n"
                            "  <user role=\"look\"/>\n"
                            "  <user name=\"eve\" role=\"look\" pasword=\"x\"/>\n"
                            "  <user name=\"tom\" role=\"look\" password=\"secret\" token=\"open\" boards=\"a b\"/>\n"
                            "  <user name=\"eve\" role=\"look\"/>\n"
                            "  <group/>\n"
                            "</users>\n"),
              ElementsAre(HasSubstr("users.xml:2:15: error: name: 'an na' is not a valid user name"),
                          HasSubstr("users.xml:2:28: error: role: 'boss' is none of look, operate, tune, program"),
                          HasSubstr("users.xml:3:3: error: <user> has no name; write name=\"anna\""),
                          HasSubstr("users.xml:4:32: error: unknown attribute 'pasword'"),
                          HasSubstr("users.xml:5:42: error: password: this is no hash"),
                          HasSubstr("users.xml:5:57: error: token: this is no hash"),
                          HasSubstr("users.xml:5:71: error: boards: 'a b' is no pattern"),
                          HasSubstr("users.xml:6:3: error: a second user 'eve', the first is in line 4"),
                          HasSubstr("users.xml:7:3: error: unknown element '<group>'")));
  for (const std::string& line :
       user_problems("<users><user name=\"t\" role=\"look\" password=\"hunter2\"/></users>")) {
    EXPECT_EQ(line.find("hunter2"), std::string::npos);
  }
  EXPECT_THAT(user_problems("<users><user name=\"t\" role=\"operate\" boards=\"\" variables=\",\"/></users>"),
              ElementsAre(HasSubstr("boards is empty"), HasSubstr("variables: '' is no pattern")))
      << "else the user would have no limits";
  EXPECT_THAT(user_problems("<plant name=\"x\"/>"), ElementsAre(HasSubstr("the root element is <plant>")));
}

TEST(UsersReader, Reads_what_it_has_written) {
  std::mt19937 random(7);
  const auto pick = [&random](std::size_t count) { return random() % count; };
  constexpr std::string_view kNames = "abcXYZ019._-";
  constexpr std::string_view kPattern = "abc:*?[]._!-";
  const auto word = [&](std::string_view from) {
    std::string text;
    for (std::size_t i = 0; i <= pick(20); ++i) {
      text += from[pick(from.size())];
    }
    return text;
  };
  for (int round = 0; round < 200; ++round) {
    std::vector<PlantUser> users;
    for (std::size_t i = pick(6); i > 0; --i) {
      PlantUser user{
          word(kNames) + std::to_string(i), static_cast<UserRole>(pick(kUserRoleNames.size())), {}, {}, {}, {}};
      for (std::size_t count = pick(3); count > 0; --count) {
        user.boards.push_back(word(kPattern));
        user.variables.push_back(word(kPattern));
      }
      user.password = pick(2) == 0 ? kHash : std::string();
      user.token = pick(2) == 0 ? keys::hash_of_token(user.name) : std::string();
      users.push_back(user);
    }
    const std::string text = users_text(users);
    const ReadUsers read = read_users_text(text, "users.xml");
    ASSERT_THAT(lines(read.diagnostics), IsEmpty()) << text;
    ASSERT_EQ(users_text(read.users.users), text);
  }
}

}  // namespace
}  // namespace indurop::config
