// SPDX-License-Identifier: Apache-2.0
// A program without a command line chooses a node and finds its variables; what people have to know comes as messages.
#include "tools/client/node/node_choice.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include "store/vars/shm_file.h"
#include "tools/client/values/variables.h"

namespace indurop::tools {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

schema::Schema one_number() {
  schema::Variable out;
  out.name = "plant::speed";
  out.type.base = schema::Base::Double;
  out.type.element_size = sizeof(double);
  out.type.align = sizeof(double);
  out.kind = abi::Kind::Scalar;
  out.type_hash = schema::hash_of(out.type);
  schema::Schema schema;
  schema.variables.push_back(out);
  return schema;
}

class NodeChoice : public ::testing::Test {
 protected:
  NodeChoice() { access_.messages = &messages_; }
  ~NodeChoice() override { EXPECT_TRUE(vars::remove_shm_file(vars::block_file(node_)).ok()); }

  std::string node_ = "node_choice_test_" + std::to_string(getpid());
  vars::Store there_ = std::move(vars::Store::create(node_, one_number())).value();
  KeptMessages messages_;
  Access access_;
};

TEST_F(NodeChoice, Takes_a_node_by_its_name) {
  const auto chosen = choose_node(node_);
  ASSERT_TRUE(chosen) << chosen.error().text;
  EXPECT_EQ(*chosen, node_);
}

TEST_F(NodeChoice, Names_what_is_wrong_with_a_name) {
  const auto invalid = choose_node("a/b");
  ASSERT_FALSE(invalid);
  EXPECT_EQ(invalid.error().code, kUsage);
  const auto similar = choose_node(node_ + "x");
  ASSERT_FALSE(similar);
  EXPECT_EQ(similar.error().code, kUnreachable);
  EXPECT_THAT(similar.error().text, HasSubstr("there is no node '" + node_ + "x'"));
}

TEST_F(NodeChoice, Opens_the_values_of_the_node) {
  access_.node = node_;
  const auto store = open_store(access_, vars::Mode::ReadOnly);
  ASSERT_TRUE(store) << store.error().text;
  std::vector<Item> items;
  EXPECT_EQ(select_items(access_, *store, {"speed"}, items), kOk);
  ASSERT_THAT(items, SizeIs(1));
  EXPECT_EQ(items[0].name, "plant::speed");
  EXPECT_THAT(messages_.texts, IsEmpty());
}

TEST_F(NodeChoice, Returns_messages_instead_of_printing_them) {
  access_.node = node_;
  const auto store = open_store(access_, vars::Mode::ReadOnly);
  ASSERT_TRUE(store) << store.error().text;
  std::vector<Item> items;
  EXPECT_EQ(select_items(access_, *store, {"sped", "nothing::*"}, items), kFailed);
  EXPECT_THAT(messages_.texts, ElementsAre(HasSubstr("speed"), HasSubstr("no variable of node")));
}

}  // namespace
}  // namespace indurop::tools
