// SPDX-License-Identifier: Apache-2.0
// Lists of users as boards keep them: text and back, damaged texts, and which list is newer.

#include "deploy/transaction/user_list.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "deploy/agent/board_users.h"
#include "deploy/agent/deploy_keys.h"
#include "tests/support/damaged_text.h"

namespace indurop::deploy {
namespace {

UserList sample() {
  return {"cell", 7, "<users>\n  <user name=\"anna\" role=\"operate\"/>\n</users>\n", "user\n0a1b\nline 1\nline 2\n"};
}

TEST(UserList, Text_and_back) {
  for (const char* signature : {"", "0a1b", "user\n0a1b\nline 1\nline 2\n"}) {
    UserList list = sample();
    list.signature = signature;
    const auto sut = read_user_list(text_of(list));
    ASSERT_TRUE(sut) << signature;
    EXPECT_EQ(sut->plant, "cell");
    EXPECT_EQ(sut->serial, 7U);
    EXPECT_EQ(sut->users, list.users);
    EXPECT_EQ(sut->signature, signature);
  }
}

// Whatever is read from a damaged text is either nothing, or its signed text is another one, or it is undamaged but for
// the signature.
TEST(UserList, Damage_is_no_list_or_another_signed_text_or_signature) {
  const std::string whole = text_of(sample());
  std::mt19937 random(1);
  for (int i = 0; i < 20'000; ++i) {
    const std::string damaged = test::damaged(whole, random);
    if (const auto sut = read_user_list(damaged)) {
      EXPECT_TRUE(signed_text(*sut) != signed_text(sample()) || sut->signature != sample().signature ||
                  text_of(*sut) == whole)
          << damaged;
    }
  }
}

TEST(UserList, What_is_not_one_is_rejected) {
  for (const char* text :
       {"", "<users/>", "indurop users\n", "indurop users\ncell\n7\n", "indurop users\ncell\n7\n9\nshort",
        "indurop users\ncell\n-1\n0\n", "indurop users\ncell\n7x\n0\n",
        "indurop users\ncell\n99999999999999999999\n0\n", "indurop users\ncell\n7\n18446744073709551615\nx"}) {
    EXPECT_FALSE(read_user_list(text)) << text;
  }
}

TEST(UserList, Is_newer_by_its_serial_and_else_by_its_digest) {
  UserList older = sample();
  older.serial = 6;
  EXPECT_LT(id_of(older), id_of(sample()));
  UserList other = sample();
  other.users = "<users/>";
  EXPECT_NE(id_of(other) < id_of(sample()), id_of(sample()) < id_of(other)) << "all boards agree on one of them";
  UserList resigned = sample();
  resigned.signature = "";
  EXPECT_EQ(id_of(resigned), id_of(sample()));
  EXPECT_EQ(read_user_list_id(text_of(id_of(other))), id_of(other));
  for (const char* text : {"", "7", "7-", "-", "7-abc", "x-0"}) {
    EXPECT_FALSE(read_user_list_id(text)) << text;
  }
}

// Boards of a plant without keys, as folders of one state folder.
class UserLists : public testing::Test {
 protected:
  UserLists() {
    std::string name = (std::filesystem::temp_directory_path() / "indurop-lists-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
    ::setenv("INDUROP_STATE_DIR", folder_.c_str(), 1);
    ::setenv("INDUROP_KEYS_DIR", folder_.c_str(), 1);
    for (std::size_t i = 0; i < kBoards; ++i) {
      keys_.push_back(std::make_unique<DeployKeys>("b" + std::to_string(i)));
      boards_.emplace_back("b" + std::to_string(i), *keys_.back());
    }
  }
  ~UserLists() override {
    ::unsetenv("INDUROP_STATE_DIR");
    ::unsetenv("INDUROP_KEYS_DIR");
    std::filesystem::remove_all(folder_);
  }
  // What a board takes from another one when it asks for its list.
  void ask(std::size_t board, std::size_t other) {
    const std::string text = boards_[board].newer_than("cell", boards_[other].id("cell"));
    if (!text.empty()) {
      const auto taken = boards_[other].take("cell", text);
      EXPECT_TRUE(taken) << taken.error().text;
    }
  }

  void all_ask_all() {
    for (std::size_t i = 0; i < kBoards; ++i) {
      for (std::size_t j = 0; j < kBoards; ++j) {
        ask(j, i);
      }
    }
  }
  // The highest serial of the boards whose bits are set.
  [[nodiscard]] std::uint64_t highest_of(std::uint64_t reached) const {
    std::uint64_t highest = 0;
    for (std::size_t i = 0; i < kBoards; ++i) {
      const auto known = read_user_list(boards_[i].newer_than("cell", ""));
      highest = (reached >> i) % 2 == 1 && known ? std::max(highest, known->serial) : highest;
    }
    return highest;
  }

  static constexpr std::size_t kBoards = 5;
  std::filesystem::path folder_;
  std::vector<std::unique_ptr<DeployKeys>> keys_;
  std::vector<BoardUsers> boards_;
};

// The oracle is the highest id of all lists that any board has accepted.
TEST_F(UserLists, Of_all_boards_are_the_newest_one_after_each_has_asked_all_others) {
  std::mt19937 random(1);
  UserListId newest;
  for (int round = 0; round < 40; ++round) {
    // A desk reaches some of the boards; another one may do so at the same time.
    for (auto desks = 1 + random() % 2; desks > 0; --desks) {
      UserList list{"cell", 0,
                    "<users>\n  <user name=\"u" + std::to_string(random()) + "\" role=\"look\"/>\n</users>\n", ""};
      const auto reached = random() % (1U << kBoards);
      // One desk may have found the boards before the other had sent its list.
      list.serial = highest_of(reached) + 1 - random() % 2 * (desks - 1);
      for (std::size_t i = 0; i < kBoards; ++i) {
        if ((reached >> i) % 2 == 1 && boards_[i].replace("cell", text_of(list))) {
          newest = std::max(newest, id_of(list));
        }
      }
    }
    for (auto some = random() % 6; some > 0; --some) {
      ask(random() % kBoards, random() % kBoards);
    }
    if (round % 4 == 3) {
      all_ask_all();
    }
    for (std::size_t i = 0; round % 4 == 3 && newest.serial > 0 && i < kBoards; ++i) {
      EXPECT_EQ(boards_[i].id("cell"), text_of(newest)) << "board " << i << " in round " << round;
    }
  }
  EXPECT_GT(newest.serial, 5U);
}

// The oracle is the order of sending: the list that was accepted last is that of all boards, whichever were off when it
// or those before it were sent.
TEST_F(UserLists, Of_all_boards_are_the_last_one_that_a_desk_with_a_clock_has_sent) {
  std::mt19937 random(2);
  std::int64_t wall_ns = 1'796'000'000'000'000'000;
  UserListId last;
  for (int round = 0; round < 160; ++round) {
    for (auto lists = random() % 4; lists > 0; --lists) {
      wall_ns += 1'000'000'000 + static_cast<std::int64_t>(random());
      const auto reached = 1U << (random() % kBoards) | (random() % 2 == 0 ? random() % (1U << kBoards) : 0U);
      const UserList list{"cell", next_serial(highest_of(reached), wall_ns),
                          "<users>\n  <user name=\"u" + std::to_string(random()) + "\" role=\"look\"/>\n</users>\n",
                          ""};
      for (std::size_t i = 0; i < kBoards; ++i) {
        if ((reached >> i) % 2 == 1) {
          EXPECT_TRUE(boards_[i].replace("cell", text_of(list)));
          last = id_of(list);
        }
      }
    }
    for (auto some = random() % 6; some > 0; --some) {
      ask(random() % kBoards, random() % kBoards);
    }
    if (round % 4 == 3) {
      all_ask_all();
    }
    for (std::size_t i = 0; round % 4 == 3 && last.serial > 0 && i < kBoards; ++i) {
      EXPECT_EQ(boards_[i].id("cell"), text_of(last)) << "board " << i << " in round " << round;
    }
  }
  EXPECT_EQ(next_serial(last.serial, 0), last.serial + 1) << "the clock of a desk may be wrong";
}

TEST_F(UserLists, Are_not_replaced_by_older_ones_or_those_of_other_plants_or_a_far_serial) {
  const auto list = [](const std::string& plant, std::uint64_t serial) {
    return text_of(UserList{plant, serial, "<users>\n  <user name=\"anna\" role=\"look\"/>\n</users>\n", ""});
  };
  ASSERT_TRUE(boards_[0].replace("cell", list("cell", 7)));
  EXPECT_THAT(boards_[0].replace("cell", list("cell", 6)).error().text, testing::HasSubstr("has list 7 of the users"));
  EXPECT_THAT(boards_[0].replace("cell", list("cell", ~std::uint64_t{0})).error().text,
              testing::HasSubstr("has list 7"));
  EXPECT_THAT(boards_[0].replace("cell", list("other", 8)).error().text,
              testing::HasSubstr("not a list of users of this plant"));
  EXPECT_FALSE(boards_[0].replace("cell", "<users/>"));
  EXPECT_TRUE(boards_[0].replace("cell", list("cell", 7))) << "the same again";
  EXPECT_EQ(boards_[0].newer_than("cell", boards_[0].id("cell")), "");
  EXPECT_EQ(boards_[0].newer_than("other", ""), "");
}

}  // namespace
}  // namespace indurop::deploy
