// SPDX-License-Identifier: Apache-2.0
// Where parts of the process data are: objects, what PDOs have from one object to another, and whole PDOs.
#include "control/io/ethercat/master/block.h"

#include <gmock/gmock.h>

#include "control/io/ethercat/master/mapping.h"
#include "slaves.h"

namespace indurop::io::ethercat {
namespace {

// Inputs as a safe drive has them: a frame of five parts with a gap, before it a PDO of the application, and one that
// is not assigned.
std::vector<Pdo> safe_pdos() {
  return {{0x1A00, 3, 0, "Drive", {{0x6041, 0, 16, 6, ""}, {0x6064, 0, 32, 4, ""}, {0, 0, 3, 0, ""}}},
          {0x1B00,
           3,
           0,
           "Safety",
           {{0x6E00, 1, 8, 5, ""},
            {0x6E01, 1, 1, 1, ""},
            {0, 0, 7, 0, ""},
            {0x6E00, 3, 16, 6, ""},
            {0x6E00, 2, 16, 6, ""}}},
          {0x1B01, kNotAssigned, 0, "Other", {{0x6E10, 1, 8, 5, ""}, {0x6E10, 2, 8, 5, ""}}},
          {0x1A10, 2, 0, "First", {{0x6010, 1, 12, 0, ""}}}};
}

void expect_place(const Block& block, std::size_t bit, std::size_t bits) {
  const auto found = find_block(safe_pdos(), block);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->bit, bit);
  EXPECT_EQ(found->bits, bits);
}

TEST(Block, Is_where_its_sync_manager_and_pdo_are) {
  constexpr std::size_t kSecond = 16;  // bytes of a SyncManager are whole
  expect_place({0x6010, 1}, 0, 12);
  expect_place({0x6041, 0}, kSecond, 16);
  expect_place({0x6064, 0}, kSecond + 16, 32);
  expect_place({0x1A00, 0}, kSecond, 51);
  expect_place({0x1B00, 0}, kSecond + 51, 48);
  expect_place({0x6E00, 3}, kSecond + 51 + 16, 16);
}

TEST(Block, From_one_object_to_another_has_all_between_them) {
  expect_place({0x6E01, 1, 0x6E00, 3}, 16 + 51 + 8, 24);  // with the gap
  expect_place({0x6E00, 1, 0x6E00, 2}, 16 + 51, 48);
  expect_place({0x6E00, 1, 0x6E00, 1}, 16 + 51, 8);
  EXPECT_FALSE(find_block(safe_pdos(), {0x6E00, 2, 0x6E00, 1})) << "the other way round";
  EXPECT_FALSE(find_block(safe_pdos(), {0x6064, 0, 0x6E00, 1})) << "in two PDOs";
  EXPECT_FALSE(find_block(safe_pdos(), {0x6E10, 1})) << "not assigned";
  EXPECT_FALSE(find_block(safe_pdos(), {0x1B01, 0}));
}

TEST(Block, Has_a_pdo_that_need_not_be_assigned) {
  const auto pdos = safe_pdos();
  EXPECT_EQ(pdo_with(pdos, {0x6E10, 1, 0x6E10, 2}), &pdos[2]);
  EXPECT_EQ(pdo_with(pdos, {0x1B01, 0}), &pdos[2]);
  EXPECT_EQ(pdo_with(pdos, {0x6041, 0, 0x6064, 0}), pdos.data());
  EXPECT_EQ(pdo_with(pdos, {0x6041, 0, 0x6010, 1}), nullptr);
}

// PDOs of a block stay as they are while others are filled for points.
TEST(Block, Its_pdo_is_assigned_and_not_filled) {
  Sii sii = drive_sii();
  sii.coe_details |= kCoePdoAssign | kCoePdoConfiguration;
  sii.inputs = safe_pdos();
  sii.inputs.pop_back();
  const std::vector<WantedObject> inputs = {{0x6041, 0, 0, 0}, {0x2000, 1, 16, 3}};
  const std::vector<std::uint16_t> whole = {0x1B01, 0x1B00};
  const auto sut = map_objects(sii, {}, inputs, whole);
  ASSERT_TRUE(sut) << sut.error().reason;
  const auto frame = find_block(sut->inputs, {0x6E00, 1, 0x6E00, 2});
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->bits, 48U);
  EXPECT_TRUE(find_block(sut->inputs, {0x6E10, 1, 0x6E10, 2}));
  EXPECT_TRUE(find_block(sut->inputs, {0x6041, 0}));
  EXPECT_TRUE(find_block(sut->inputs, {0x2000, 1}));
}

TEST(Block, A_pdo_that_cannot_be_assigned_is_named) {
  Sii sii = drive_sii();
  sii.inputs = safe_pdos();
  const std::vector<std::uint16_t> other = {0x1B01};
  const auto fixed = map_objects(sii, {}, {}, other);
  ASSERT_FALSE(fixed);
  EXPECT_EQ(fixed.error().object.index, 0x1B01);
  EXPECT_EQ(fixed.error().reason, "the slave does not let its master assign this PDO");
  sii.coe_details |= kCoePdoAssign;
  sii.inputs[1].flags = kPdoMandatory;
  sii.inputs[1].excludes = {0x1B01};
  const auto excluded = map_objects(sii, {}, {}, other);
  ASSERT_FALSE(excluded);
  EXPECT_FALSE(excluded.error().output);
  EXPECT_EQ(excluded.error().reason, "this PDO may not be assigned together with the others");
}

}  // namespace
}  // namespace indurop::io::ethercat
