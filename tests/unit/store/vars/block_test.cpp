// SPDX-License-Identifier: Apache-2.0

#include "store/vars/block.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <random>
#include <set>

#include "test_schema.h"

namespace indurop::vars {
namespace {

using test::array_type;
using test::scalar_type;
using test::variable;

schema::Schema some_schema() {
  schema::Schema schema;
  schema.variables.push_back(variable("a::tick", scalar_type(schema::Base::UInt32)));
  schema.variables.push_back(variable("a::on", scalar_type(schema::Base::Bool)));
  schema.variables.push_back(variable("b::joints", array_type(schema::Base::Double, 30), true));
  schema.variables.push_back(variable("b::grid", array_type(schema::Base::Int16, 1000)));
  schema::Function function;
  function.name = "b::add";
  function.arguments.base = schema::Base::Struct;
  function.arguments.element_size = 8;
  function.arguments.align = 8;
  function.arguments.name = "b::add_args";
  schema::Field field;
  field.name = "x";
  field.type = scalar_type(schema::Base::Double);
  function.arguments.fields.push_back(field);
  function.result = scalar_type(schema::Base::Double);
  function.type_hash = schema::hash_of(function);
  schema.functions.push_back(function);
  return schema;
}

// A complete block in private memory.
class Block {
 public:
  explicit Block(const schema::Schema& schema) : plan_(plan_block(schema).value()) {
    memory_.reset(static_cast<std::byte*>(std::aligned_alloc(4096, plan_.total_size)));
    std::memset(memory_.get(), 0, plan_.total_size);
    EXPECT_TRUE(fill_block(memory_.get(), plan_, "local").ok());
    header().state.store(BlockState::Ready);
    header().magic.store(kMagic);
  }
  BlockHeader& header() { return *header_of(memory_.get()); }
  std::byte* memory() { return memory_.get(); }
  const BlockPlan& plan() { return plan_; }
  Errc check() { return check(plan_.total_size); }
  Errc check(std::size_t size) {
    const auto result = check_block({memory_.get(), size});
    return result.ok() ? Errc::Ok : result.error().code;
  }

 private:
  struct Free {
    void operator()(std::byte* memory) const { std::free(memory); }
  };
  BlockPlan plan_;
  std::unique_ptr<std::byte, Free> memory_;
};

TEST(BlockPlan, Places_every_variable_on_cache_lines_of_its_own) {
  const auto sut = plan_block(some_schema());
  ASSERT_TRUE(sut.ok());
  std::uint64_t end = sut->schema_offset + sut->schema_text.size();
  std::uint64_t last_hash = 0;
  for (const DirectoryEntry& entry : sut->directory) {
    EXPECT_EQ(entry.offset % abi::kAlign, 0U);
    EXPECT_GE(entry.offset, end);
    EXPECT_GT(entry.name_hash, last_hash);
    end = entry.offset + abi::entry_size(entry.kind, entry.value_size);
    last_hash = entry.name_hash;
  }
  EXPECT_GE(sut->functions_offset, end);
  EXPECT_LE(sut->functions_offset, sut->total_size);
}

TEST(BlockPlan, Does_not_depend_on_the_order_of_declarations) {
  schema::Schema other = some_schema();
  std::swap(other.variables[0], other.variables[3]);
  EXPECT_EQ(plan_block(some_schema())->layout_hash, plan_block(other)->layout_hash);
}

TEST(BlockPlan, Any_difference_changes_the_layout_hash) {
  std::set<std::uint64_t> hashes{plan_block(some_schema())->layout_hash};
  const auto with = [&](auto change) {
    schema::Schema schema = some_schema();
    change(schema);
    EXPECT_TRUE(hashes.insert(plan_block(schema)->layout_hash).second);
  };
  with([](auto& s) { s.variables[0].name = "a::tock"; });
  with([](auto& s) { s.variables[0].type = scalar_type(schema::Base::Int32); });
  with([](auto& s) { s.variables[0].initial = {1, 0, 0, 0}; });
  with([](auto& s) { s.variables[0].retain = true; });
  with([](auto& s) { s.variables[2].type.dims = {31}; });
  with([](auto& s) { s.variables.pop_back(); });
  with([](auto& s) { s.functions.clear(); });
}

TEST(BlockPlan, Refuses_what_cannot_be_laid_out) {
  const auto refused = [](auto change) {
    schema::Schema schema = some_schema();
    change(schema);
    const auto plan = plan_block(schema);
    return plan.ok() ? Errc::Ok : plan.error().code;
  };
  EXPECT_EQ(refused([](auto& s) { s.variables.push_back(s.variables[0]); }), Errc::AlreadyExists);
  EXPECT_EQ(refused([](auto& s) { s.functions.push_back(s.functions[0]); }), Errc::AlreadyExists);
  EXPECT_EQ(refused([](auto& s) { s.variables[0].initial = {1}; }), Errc::InvalidArgument);
  EXPECT_EQ(refused([](auto& s) { s.variables[3].kind = abi::Kind::Scalar; }), Errc::InvalidArgument);
  EXPECT_EQ(refused([](auto& s) { s.variables[2].type.dims = {0}; }), Errc::InvalidArgument);
  EXPECT_EQ(refused([](auto& s) { s.variables[2].type.dims = {65536, 65536}; }), Errc::Overflow);
}

TEST(Block, Is_accepted_as_made) {
  Block sut(some_schema());
  const auto index = check_block({sut.memory(), sut.plan().total_size});
  ASSERT_TRUE(index.ok());
  EXPECT_EQ(index->directory.size(), 4U);
  EXPECT_EQ(index->schema.variables.size(), 4U);
  EXPECT_EQ(index->schema.functions.size(), 1U);
}

TEST(Block, Without_any_variable_is_a_block) {
  Block sut(schema::Schema{});
  EXPECT_EQ(sut.check(), Errc::Ok);
}

TEST(Block, Without_magic_is_not_complete) {
  Block sut(some_schema());
  sut.header().magic.store(0);
  EXPECT_EQ(sut.check(), Errc::Busy);
  sut.header().magic.store(1);
  EXPECT_EQ(sut.check(), Errc::Corrupt);
}

TEST(Block, Of_another_version_is_distinguished_from_a_corrupt_one) {
  Block sut(some_schema());
  sut.header().abi += 1;
  EXPECT_EQ(sut.check(), Errc::VersionMismatch);
  sut.header().abi -= 1;
  sut.header().header_size += 8;
  EXPECT_EQ(sut.check(), Errc::VersionMismatch);
}

TEST(Block, Every_header_field_that_lies_is_noticed) {
  Block sut(some_schema());
  const auto broken_by = [&](auto& field, auto wrong) {
    const auto right = field;
    field = static_cast<std::remove_reference_t<decltype(field)>>(wrong);
    const Errc code = sut.check();
    field = right;
    return code;
  };
  BlockHeader& header = sut.header();
  for (const std::uint64_t wrong : {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{64}, std::uint64_t{1} << 20U,
                                    std::uint64_t{1} << 63U, ~std::uint64_t{0}, ~std::uint64_t{63}}) {
    EXPECT_EQ(broken_by(header.total_size, wrong), Errc::Corrupt);
    EXPECT_EQ(broken_by(header.layout_hash, wrong), Errc::Corrupt);
    EXPECT_EQ(broken_by(header.variable_count, wrong), Errc::Corrupt);
    EXPECT_EQ(broken_by(header.directory_offset, wrong), Errc::Corrupt);
    EXPECT_EQ(broken_by(header.schema_offset, wrong), Errc::Corrupt);
    EXPECT_EQ(broken_by(header.schema_size, wrong), Errc::Corrupt);
  }
  EXPECT_EQ(broken_by(header.function_count, 2U), Errc::Corrupt);
  EXPECT_EQ(broken_by(header.functions_offset, sut.plan().total_size), Errc::Corrupt);
  EXPECT_EQ(broken_by(header.functions_offset, 1U), Errc::Corrupt);
  header.state.store(BlockState::Building);
  EXPECT_EQ(sut.check(), Errc::Corrupt);
  header.state.store(static_cast<BlockState>(7));
  EXPECT_EQ(sut.check(), Errc::Corrupt);
  header.state.store(BlockState::Retired);
  EXPECT_EQ(sut.check(), Errc::Ok);
  std::memset(header.node_name, 'x', sizeof(header.node_name));
  EXPECT_EQ(sut.check(), Errc::Corrupt);
}

TEST(Block, Cut_anywhere_is_corrupt) {
  Block sut(some_schema());
  for (std::size_t size = 0; size < sut.plan().total_size; size += size < 1000 ? 1 : 509) {
    EXPECT_EQ(sut.check(size), Errc::Corrupt) << size;
  }
}

TEST(Block, Every_flipped_bit_of_directory_and_schema_is_noticed) {
  Block sut(some_schema());
  const BlockPlan& plan = sut.plan();
  for (std::size_t i = plan.directory_offset; i < plan.schema_offset + plan.schema_text.size(); ++i) {
    const bool padding =
        i >= plan.directory_offset + plan.directory.size() * sizeof(DirectoryEntry) && i < plan.schema_offset;
    for (unsigned bit = 0; bit < 8 && !padding; ++bit) {
      sut.memory()[i] ^= std::byte{1} << bit;
      EXPECT_EQ(sut.check(), Errc::Corrupt) << i;
      sut.memory()[i] ^= std::byte{1} << bit;
    }
  }
  EXPECT_EQ(sut.check(), Errc::Ok);
}

TEST(Block, Random_damage_never_crashes_the_check) {
  Block sut(some_schema());
  std::mt19937 random(1);
  const std::vector<std::byte> sound(sut.memory(), sut.memory() + sizeof(BlockHeader));
  for (int i = 0; i < 20'000; ++i) {
    for (int k = 0; k < 3; ++k) {
      sut.memory()[16 + random() % (sizeof(BlockHeader) - 16)] = static_cast<std::byte>(random());
    }
    static_cast<void>(sut.check());
    std::memcpy(sut.memory(), sound.data(), sound.size());
  }
}

}  // namespace
}  // namespace indurop::vars
