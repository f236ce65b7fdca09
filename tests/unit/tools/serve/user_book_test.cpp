// SPDX-License-Identifier: Apache-2.0
// Users who sign in: their sessions, how these end, and that a change of the file counts from the next request on.

#include "tools/serve/users/user_book.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>

#include "config/users_reader.h"
#include "core/keys/password.h"

namespace indurop::serve {
namespace {

namespace fs = std::filesystem;

std::int64_t clock_ns = 1;
std::int64_t now_ns() {
  return clock_ns;
}

class UserBookTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "users-XXXXXX").string();
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    folder_ = name;
    clock_ns = 1;
    anna_.password = hash();
  }
  void TearDown() override { fs::remove_all(folder_); }

  static const std::string& hash() {
    static const std::string kHash = keys::hash_of_password("correct horse");
    return kHash;
  }
  [[nodiscard]] fs::path file() const { return folder_ / "users.xml"; }
  // As indurop users does it: another file takes its place.
  void write(const std::vector<config::PlantUser>& users) const {
    std::ofstream(folder_ / "new") << config::users_text(users);
    fs::rename(folder_ / "new", file());
  }
  std::string sign_in(UserBook& sut, const std::string& password = "correct horse") {
    return sut.sign_in("anna", password, "127.0.0.1").value_or("");
  }

  fs::path folder_;
  config::PlantUser anna_{"anna", config::UserRole::Tune, {"press*"}, {"cell::*"}, {}, {}};
};

TEST_F(UserBookTest, Signs_in_with_the_password_only) {
  write({anna_, {"logger", config::UserRole::Look, {}, {}, {}, keys::hash_of_token("logger-token")}});
  UserBook sut(file(), &now_ns);
  EXPECT_EQ(sut.problem(), "");
  EXPECT_EQ(sign_in(sut, "wrong"), "");
  EXPECT_FALSE(sut.sign_in("eve", "correct horse", "127.0.0.1"));
  EXPECT_FALSE(sut.sign_in("logger", "", "127.0.0.1"));
  const std::string token = sign_in(sut);
  ASSERT_GE(token.size(), 20U);
  const auto client = sut.client_of_token(token);
  ASSERT_TRUE(client);
  EXPECT_EQ(client->name, "anna");
  EXPECT_EQ(client->role, Role::Tune);
  EXPECT_EQ(client->boards, std::vector<std::string>{"press*"});
  EXPECT_EQ(client->variables, std::vector<std::string>{"cell::*"});
  EXPECT_EQ(sut.client_of_token("logger-token")->role, Role::Look);
  EXPECT_FALSE(sut.client_of_token("logger-toke"));
  EXPECT_FALSE(sut.client_of_token(""));
  EXPECT_FALSE(sut.client_of_token(hash()));
}

TEST_F(UserBookTest, Notices_a_list_whose_times_and_size_are_those_of_the_one_before_and_who_may_change_it) {
  write({{"anna", config::UserRole::Tune, {}, {}, {}, keys::hash_of_token("the-token")}});
  UserBook sut(file(), &now_ns);
  ASSERT_EQ(sut.client_of_token("the-token")->role, Role::Tune);
  struct stat before {};
  ASSERT_EQ(::stat(file().c_str(), &before), 0);
  const std::string lower =
      config::users_text({{"anna", config::UserRole::Look, {}, {}, {}, keys::hash_of_token("the-token")}});
  std::fstream(file(), std::ios::in | std::ios::out) << lower;
  // The clock of the file system is coarse: the time of the last change may be the same, too.
  const std::array<timespec, 2> times{before.st_atim, before.st_mtim};
  struct stat after {};
  ASSERT_EQ(::utimensat(AT_FDCWD, file().c_str(), times.data(), 0), 0);
  ASSERT_EQ(::stat(file().c_str(), &after), 0);
  ASSERT_EQ(after.st_size, before.st_size);
  ASSERT_EQ(after.st_ino, before.st_ino);
  EXPECT_EQ(sut.client_of_token("the-token")->role, Role::Look);
  ::chmod(file().c_str(), 0666);
  EXPECT_FALSE(sut.client_of_token("the-token"));
  EXPECT_NE(sut.problem(), "");
}

TEST_F(UserBookTest, A_certificate_does_not_count_while_the_list_that_may_limit_it_cannot_be_used) {
  config::PlantUser dora = anna_;
  dora.name = "dora";
  dora.role = config::UserRole::Look;
  write({dora});
  UserBook sut(file(), &now_ns);
  const Client deployer{"dora", Role::Program, {}, {}, {}};
  EXPECT_EQ(sut.client_certified(deployer, Role::Program).role, Role::Look);
  EXPECT_EQ(sut.client_certified({"another", Role::Program, {}, {}, {}}, Role::Program).role, Role::Program);
  EXPECT_EQ(sut.client_certified({"another", Role::Program, {}, {}, {}}, Role::Look).role, Role::Look) << "not listed";
  std::ofstream(folder_ / "new") << "<users><user name='dora' role='boss'/></users>";
  fs::rename(folder_ / "new", file());
  EXPECT_EQ(sut.client_certified(deployer, Role::Program).role, Role::Unknown);
  EXPECT_NE(sut.client_certified(deployer, Role::Program).refusal, "");
  fs::remove(file());
  EXPECT_NE(sut.client_certified(deployer, Role::Program).refusal, "");
  write({dora});
  ::chmod(file().c_str(), 0666);
  EXPECT_NE(sut.client_certified(deployer, Role::Program).refusal, "") << "others can change it";
  ::chmod(file().c_str(), 0600);
  EXPECT_EQ(sut.client_certified(deployer, Role::Program).role, Role::Look);
  UserBook none;
  EXPECT_EQ(none.client_certified(deployer, Role::Program).role, Role::Program);
}

TEST_F(UserBookTest, A_session_ends_by_sign_out_idling_and_age) {
  write({anna_});
  UserBook sut(file(), &now_ns);
  const std::string first = sign_in(sut);
  const std::string second = sign_in(sut);
  EXPECT_NE(first, second);
  EXPECT_TRUE(sut.sign_out(first));
  EXPECT_FALSE(sut.client_of_token(first));
  EXPECT_TRUE(sut.client_of_token(second));
  for (std::int64_t age = 0; age < UserBook::kLongestNs; age += UserBook::kIdleNs) {
    EXPECT_TRUE(sut.client_of_token(second));
    clock_ns += UserBook::kIdleNs;
  }
  clock_ns += 1;
  EXPECT_FALSE(sut.client_of_token(second));
  const std::string third = sign_in(sut);
  clock_ns += UserBook::kIdleNs + 1;
  EXPECT_FALSE(sut.client_of_token(third));
}

TEST_F(UserBookTest, Notices_changes_that_follow_each_other_faster_than_the_clock_of_the_file_system) {
  constexpr int kChanges = 300;
  UserBook sut(file(), &now_ns);
  for (int i = 0; i < kChanges; ++i) {
    const auto role = i % 2 == 0 ? config::UserRole::Tune : config::UserRole::Look;
    const std::string text = config::users_text({{"anna", role, {}, {}, {}, keys::hash_of_token("the-token")}});
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> same(std::fopen(file().c_str(), i == 0 ? "w" : "r+"),
                                                               &std::fclose);
    ASSERT_EQ(std::fwrite(text.data(), 1, text.size(), same.get()), text.size());
    ASSERT_EQ(std::fflush(same.get()), 0);
    ASSERT_EQ(sut.client_of_token("the-token")->role, i % 2 == 0 ? Role::Tune : Role::Look) << i;
  }
}

TEST_F(UserBookTest, What_no_user_caused_does_not_prolong_a_session) {
  write({anna_});
  UserBook sut(file(), &now_ns);
  const std::string token = sign_in(sut);
  clock_ns += UserBook::kIdleNs;
  EXPECT_TRUE(sut.client_of_token(token, false));
  clock_ns += 1;
  EXPECT_FALSE(sut.client_of_token(token, false));
}

TEST_F(UserBookTest, What_the_file_says_counts_from_the_next_request_on) {
  write({anna_});
  UserBook sut(file(), &now_ns);
  const std::string token = sign_in(sut);
  anna_.role = config::UserRole::Look;
  anna_.boards.clear();
  write({anna_});
  EXPECT_EQ(sut.client_of_token(token)->role, Role::Look);
  EXPECT_TRUE(sut.client_of_token(token)->boards.empty());
  anna_.password = keys::hash_of_password("another one");
  write({anna_});
  EXPECT_FALSE(sut.client_of_token(token)) << "its password was changed";
  const std::string again = sign_in(sut, "another one");
  EXPECT_NE(again, "");
  write({});
  EXPECT_FALSE(sut.client_of_token(again)) << "she was removed";
}

TEST_F(UserBookTest, A_file_that_is_wrong_or_gone_names_no_one) {
  write({anna_});
  UserBook sut(file(), &now_ns);
  const std::string token = sign_in(sut);
  std::ofstream(file()) << "<users><user name='anna' role='boss'/></users>";
  EXPECT_NE(sut.problem().find("users.xml:1:"), std::string::npos);
  EXPECT_FALSE(sut.client_of_token(token));
  fs::remove(file());
  EXPECT_NE(sut.problem(), "");
  EXPECT_EQ(sign_in(sut), "");
  write({anna_});
  EXPECT_NE(sign_in(sut), "");
}

TEST_F(UserBookTest, A_file_that_others_can_change_names_no_one) {
  write({anna_});
  ::chmod(file().c_str(), 0666);
  UserBook sut(file(), &now_ns);
  EXPECT_NE(sut.problem().find("chmod go-w"), std::string::npos);
  EXPECT_EQ(sign_in(sut), "");
}

TEST_F(UserBookTest, All_sessions_of_a_user_can_be_ended) {
  write({anna_});
  UserBook sut(file(), &now_ns);
  std::vector<std::string> tokens;
  for (std::size_t i = 0; i < 4; ++i) {
    tokens.push_back(sign_in(sut));
    ++clock_ns;
  }
  EXPECT_EQ(sut.sessions().size(), 4U);
  EXPECT_EQ(sut.end_sessions("anna"), 4U);
  EXPECT_FALSE(sut.client_of_token(tokens.back()));
  EXPECT_EQ(sut.end_sessions("anna"), 0U);
}

TEST_F(UserBookTest, Without_a_file_there_are_no_users) {
  UserBook sut;
  EXPECT_FALSE(sut.used());
  EXPECT_FALSE(sut.client_of_token("x"));
  EXPECT_FALSE(sut.client_named("anna"));
}

}  // namespace
}  // namespace indurop::serve
