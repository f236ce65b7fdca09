// SPDX-License-Identifier: Apache-2.0
// The C interface over a store that the test made: names, values, changes, and a layout that changes under a reader.

#include <gmock/gmock.h>
#include <indurop/c.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "core/schema/schema.h"
#include "store/operate/journal.h"
#include "store/vars/custody.h"
#include "store/vars/shm_file.h"
#include "store/vars/store.h"

namespace indurop::c {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

schema::Type type_of(schema::Base base) {
  schema::Type type;
  type.base = base;
  type.element_size = type.align = schema::size_of(base);
  return type;
}

schema::Variable variable(const std::string& name, schema::Type type) {
  schema::Variable out;
  out.name = name;
  out.kind = type.dims.empty() && type.base != schema::Base::Struct && type.base != schema::Base::Text
                 ? abi::Kind::Scalar
                 : abi::Kind::Ring;
  out.type = std::move(type);
  out.type_hash = schema::hash_of(out.type);
  return out;
}

schema::Schema variables() {
  schema::Type place = type_of(schema::Base::Struct);
  place.name = "Place";
  place.element_size = 16;
  place.align = 8;
  place.fields.resize(2);
  place.fields[0].name = "x";
  place.fields[0].type = type_of(schema::Base::Double);
  place.fields[1].name = "y";
  place.fields[1].type = type_of(schema::Base::Double);
  place.fields[1].offset = 8;
  place.dims = {3};
  schema::Schema schema;
  schema.variables = {variable("cell::gain", type_of(schema::Base::Double)), variable("cell::places", place),
                      variable("cell::count", type_of(schema::Base::Int32))};
  schema.variables[0].range = schema::Range{0, 10};
  schema.variables[0].unit = "mm";
  schema.variables[0].retain = true;
  return schema;
}

class CInterface : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string folder = (std::filesystem::temp_directory_path() / "c_interface_XXXXXX").string();
    ASSERT_NE(::mkdtemp(folder.data()), nullptr);
    folder_ = folder;
    ASSERT_EQ(::setenv("INDUROP_STATE_DIR", folder.c_str(), 1), 0);
    std::filesystem::create_directories(folder_ / node_);
    ASSERT_TRUE(vars::Custody::create(node_).ok());
    make(variables());
    ASSERT_EQ(irp_open(node_.c_str(), IRP_WRITE, &handle_), IRP_OK) << irp_error();
  }
  void TearDown() override {
    irp_close(handle_);
    store_.reset();
    EXPECT_TRUE(vars::remove_shm_file(vars::block_file(node_)).ok());
    EXPECT_TRUE(vars::remove_shm_file(vars::custody_file(node_)).ok());
    std::filesystem::remove_all(folder_);
  }
  void make(const schema::Schema& schema) {
    auto made = vars::Store::create(node_, schema);
    ASSERT_TRUE(made.ok());
    store_.emplace(std::move(made).value());
  }
  std::uint32_t id_of(const char* name) {
    std::uint32_t id = 0;
    EXPECT_EQ(irp_find(handle_, name, &id), IRP_OK) << irp_error();
    return id;
  }
  void grow(const std::vector<schema::Variable>& variables) {
    ASSERT_TRUE(store_->reserve(variables).ok());
    auto next = store_->prepare(variables);
    ASSERT_TRUE(next.ok());
    store_->announce(std::move(next).value());
  }
  template <class T>
  T read(const char* name) {
    T value{};
    EXPECT_EQ(irp_read(handle_, id_of(name), &value, sizeof value), IRP_OK) << irp_error();
    return value;
  }
  template <class T>
  irp_code write(const char* name, T value) {
    return irp_write(handle_, id_of(name), &value, sizeof value, "a trial");
  }

  const std::string node_ = "c_interface_" + std::to_string(::getpid());
  std::filesystem::path folder_;
  std::optional<vars::Store> store_;
  irp_node* handle_ = nullptr;
};

TEST_F(CInterface, Names_and_describes_variables_and_parts) {
  ASSERT_EQ(irp_count(handle_), 3U);
  EXPECT_STREQ(irp_name(handle_, 0), "cell::count");
  EXPECT_STREQ(irp_name(handle_, 2), "cell::places");
  EXPECT_EQ(irp_name(handle_, 3), nullptr);
  irp_variable gain = IRP_VARIABLE_INIT;
  ASSERT_EQ(irp_describe(handle_, id_of("gain"), &gain), IRP_OK);
  EXPECT_STREQ(gain.name, "cell::gain");
  EXPECT_STREQ(gain.layout, "f64");
  EXPECT_STREQ(gain.unit, "mm");
  EXPECT_EQ(gain.size, 8U);
  EXPECT_EQ(gain.max, 10);
  EXPECT_EQ(gain.flags, static_cast<std::uint32_t>(IRP_HAS_RANGE | IRP_RETAIN));
  irp_variable part = IRP_VARIABLE_INIT;
  ASSERT_EQ(irp_describe(handle_, id_of("places[1]"), &part), IRP_OK);
  EXPECT_STREQ(part.name, "cell::places[1]");
  EXPECT_STREQ(part.layout, "struct(16,8){x@0:f64,y@8:f64}");
  EXPECT_EQ(id_of("cell::gain"), id_of("gain")) << "one variable has one id";
}

TEST_F(CInterface, A_program_with_an_older_header_gets_what_it_knows) {
  irp_variable gain{};
  gain.struct_size = offsetof(irp_variable, layout);
  gain.layout = "untouched";
  ASSERT_EQ(irp_describe(handle_, id_of("gain"), &gain), IRP_OK);
  EXPECT_STREQ(gain.type, "double");
  EXPECT_STREQ(gain.layout, "untouched");
}

TEST_F(CInterface, Says_what_is_wrong_with_a_name) {
  std::uint32_t id = 0;
  EXPECT_EQ(irp_find(handle_, "gian", &id), IRP_NOT_FOUND);
  EXPECT_THAT(irp_error(), HasSubstr("gain"));
  EXPECT_EQ(irp_find(handle_, "places[3]", &id), IRP_NOT_FOUND);
  double value = 0;
  EXPECT_EQ(irp_read(handle_, 77, &value, sizeof value), IRP_NOT_FOUND);
}

TEST_F(CInterface, Reads_and_writes_parts) {
  EXPECT_EQ(write("gain", 2.5), IRP_OK) << irp_error();
  EXPECT_EQ(write("places[2].y", 7.0), IRP_OK) << irp_error();
  EXPECT_EQ(read<double>("gain"), 2.5);
  EXPECT_EQ((read<std::array<double, 6>>("places")[5]), 7.0);
  EXPECT_EQ(irp_set_text(handle_, id_of("places[0]"), "{x: 1}", nullptr), IRP_OK) << irp_error();
  std::array<char, 100> text{};
  std::size_t needed = 0;
  EXPECT_EQ(irp_get_text(handle_, id_of("places"), text.data(), 5, &needed), IRP_SIZE);
  ASSERT_EQ(irp_get_text(handle_, id_of("places"), text.data(), text.size(), nullptr), IRP_OK);
  EXPECT_STREQ(text.data(), "[{x: 1, y: 0}, {x: 0, y: 0}, {x: 0, y: 7}]");
  EXPECT_EQ(needed, std::strlen(text.data()) + 1);
  EXPECT_EQ(operate::read_orders(node_, 0).front().reason, "a trial");
}

TEST_F(CInterface, Keeps_values_within_their_declared_range) {
  EXPECT_EQ(write("gain", 11.0), IRP_RANGE);
  EXPECT_THAT(irp_error(), HasSubstr("outside 0..10"));
  EXPECT_EQ(write("gain", std::numeric_limits<double>::quiet_NaN()), IRP_RANGE);
  EXPECT_EQ(write("gain", 1.0F), IRP_SIZE);
  const double high = 11;
  EXPECT_EQ(irp_force(handle_, id_of("gain"), &high, sizeof high, 0, nullptr), IRP_RANGE);
  EXPECT_EQ(read<double>("gain"), 0);
}

TEST_F(CInterface, A_reader_cannot_write) {
  irp_node* reader = nullptr;
  ASSERT_EQ(irp_open(node_.c_str(), IRP_READ, &reader), IRP_OK);
  std::uint32_t id = 0;
  ASSERT_EQ(irp_find(reader, "gain", &id), IRP_OK);
  const double value = 1;
  EXPECT_EQ(irp_write(reader, id, &value, sizeof value, nullptr), IRP_DENIED);
  EXPECT_EQ(irp_release(reader, id, nullptr), IRP_DENIED);
  irp_close(reader);
}

TEST_F(CInterface, Forces_and_releases) {
  const double held = 4;
  ASSERT_EQ(irp_force(handle_, id_of("gain"), &held, sizeof held, 0, "test stand"), IRP_OK) << irp_error();
  EXPECT_EQ(write("gain", 2.0), IRP_FORCED);
  irp_quality quality = IRP_QUALITY_INIT;
  ASSERT_EQ(irp_get_quality(handle_, id_of("gain"), &quality), IRP_OK);
  EXPECT_EQ(quality.flags, static_cast<std::uint32_t>(IRP_IS_FORCED));
  EXPECT_EQ(irp_release(handle_, id_of("gain"), nullptr), IRP_OK);
  EXPECT_EQ(irp_release(handle_, id_of("gain"), nullptr), IRP_NOT_FOUND);
  EXPECT_EQ(write("gain", 2.0), IRP_OK);
}

TEST_F(CInterface, Tells_a_change_from_none) {
  std::uint64_t seen = 0;
  EXPECT_EQ(irp_wait_change(handle_, id_of("gain"), &seen, 0), IRP_OK);
  const std::uint64_t before = seen;
  EXPECT_EQ(irp_wait_change(handle_, id_of("gain"), &seen, 0), IRP_GONE) << "no node runs on this store";
  EXPECT_EQ(write("gain", 3.0), IRP_OK);
  EXPECT_EQ(irp_wait_change(handle_, id_of("gain"), &seen, 0), IRP_OK);
  EXPECT_NE(seen, before);
}

// The reader of a changed layout gets an error, never the bytes of another variable.
TEST_F(CInterface, Notices_other_variables) {
  const std::uint32_t gain = id_of("gain");
  const std::uint32_t count = id_of("count");
  ASSERT_EQ(write("gain", 2.5), IRP_OK);
  schema::Schema changed = variables();
  changed.variables[2] = variable("cell::count", type_of(schema::Base::Int64));
  changed.variables.insert(changed.variables.begin(), variable("cell::another", type_of(schema::Base::Int32)));
  changed.variables[1].range = schema::Range{0, 10};
  make(changed);
  double value = 0;
  EXPECT_EQ(irp_read(handle_, gain, &value, sizeof value), IRP_CHANGED);
  EXPECT_EQ(irp_running(handle_), IRP_CHANGED);
  ASSERT_EQ(irp_refresh(handle_), IRP_OK) << irp_error();
  EXPECT_EQ(irp_count(handle_), 4U);
  EXPECT_EQ(irp_read(handle_, gain, &value, sizeof value), IRP_OK);
  EXPECT_EQ(value, 2.5);
  std::int32_t old_type = 0;
  EXPECT_EQ(irp_read(handle_, count, &old_type, sizeof old_type), IRP_NOT_FOUND) << "it has another type now";
  EXPECT_EQ(read<std::int64_t>("count"), 0);
}

TEST_F(CInterface, Follows_a_store_that_grows) {
  const std::uint32_t gain = id_of("gain");
  const std::uint32_t count = id_of("count");
  ASSERT_EQ(write("gain", 2.5), IRP_OK);
  ASSERT_EQ(write("count", 7), IRP_OK);
  grow({variable("cell::another", type_of(schema::Base::Int32))});
  double value = 0;
  EXPECT_EQ(irp_read(handle_, gain, &value, sizeof value), IRP_OK);
  EXPECT_NE(irp_running(handle_), IRP_CHANGED);
  std::uint32_t another = 0;
  EXPECT_EQ(irp_find(handle_, "another", &another), IRP_CHANGED);
  ASSERT_EQ(irp_refresh(handle_), IRP_OK);
  EXPECT_EQ(read<std::int32_t>("another"), 0);
  EXPECT_EQ(irp_count(handle_), 4U);
  EXPECT_EQ(irp_read(handle_, gain, &value, sizeof value), IRP_OK);
  EXPECT_EQ(value, 2.5);
  grow({variable("cell::count", type_of(schema::Base::Int64))});
  std::int32_t number = 0;
  EXPECT_EQ(irp_read(handle_, count, &number, sizeof number), IRP_CHANGED) << "never what another layout has there";
  const std::array<void*, 2> to{&value, &number};
  const std::array<std::uint32_t, 2> ids{gain, count};
  const std::array<std::size_t, 2> sizes{sizeof value, sizeof number};
  EXPECT_EQ(irp_read_together(handle_, ids.data(), 2, to.data(), sizes.data()), IRP_CHANGED);
  EXPECT_EQ(irp_read(handle_, gain, &value, sizeof value), IRP_OK);
  ASSERT_EQ(irp_refresh(handle_), IRP_OK);
  EXPECT_EQ(irp_read(handle_, count, &number, sizeof number), IRP_NOT_FOUND) << "it has another type now";
  EXPECT_EQ(read<std::int64_t>("count"), 0);
  EXPECT_EQ(read<std::int32_t>("count_before"), 7);
}

// Two variables that a writer changes one after the other: a snapshot has both of one round, or the second one round
// behind; values that are read one by one may be any rounds apart.
TEST_F(CInterface, A_snapshot_is_of_one_moment) {
  irp_node* reader = nullptr;
  ASSERT_EQ(irp_open(node_.c_str(), IRP_READ, &reader), IRP_OK);
  std::array<std::uint32_t, 2> ids{};
  ASSERT_EQ(irp_find(reader, "places", ids.data()), IRP_OK);
  ASSERT_EQ(irp_find(reader, "count", &ids[1]), IRP_OK);
  const auto* places = store_->find(schema::Variable{variable("cell::places", {})}.name_hash());
  const auto* count = store_->find(variable("cell::count", {}).name_hash());
  std::atomic<bool> done{false};
  std::thread writer([&] {
    for (std::int32_t round = 1; !done; ++round) {
      std::array<double, 6> six{};
      six.fill(round);
      std::array<std::uint8_t, sizeof six> bytes{};
      std::memcpy(bytes.data(), six.data(), sizeof six);
      (void)store_->write(*places, 0, bytes);
      std::array<std::uint8_t, sizeof round> number{};
      std::memcpy(number.data(), &round, sizeof round);
      (void)store_->write(*count, 0, number);
      for (int pause = 0; pause < 100 && !done; ++pause) {
        std::this_thread::yield();
      }
    }
  });
  int together = 0;
  for (int i = 0; i < 2000; ++i) {
    std::array<double, 6> six{};
    std::int32_t number = 0;
    const std::array<void*, 2> to{six.data(), &number};
    const std::array<std::size_t, 2> sizes{sizeof six, sizeof number};
    const irp_code code = irp_read_together(reader, ids.data(), 2, to.data(), sizes.data());
    if (code == IRP_OK) {
      ++together;
      EXPECT_EQ(six[0], six[5]);
      EXPECT_TRUE(number == six[0] || number == six[0] - 1) << number << " and " << six[0];
    } else {
      EXPECT_EQ(code, IRP_APART) << irp_error();
    }
  }
  done = true;
  writer.join();
  irp_close(reader);
  EXPECT_GT(together, 1000);
}

// What the bytes of any value say as text is read back as the same bytes, so irp_write() stores exactly its bytes.
TEST_F(CInterface, Any_number_is_written_as_it_is) {
  std::mt19937_64 random(7);
  const std::uint32_t id = id_of("places[0].x");
  for (int i = 0; i < 500; ++i) {
    double value = 0;
    const std::uint64_t bits = random();
    std::memcpy(&value, &bits, sizeof value);
    const irp_code code = irp_write(handle_, id, &value, sizeof value, nullptr);
    if (code == IRP_OK) {
      double found = 0;
      ASSERT_EQ(irp_read(handle_, id, &found, sizeof found), IRP_OK);
      EXPECT_TRUE(std::memcmp(&found, &value, sizeof value) == 0 || (std::isnan(value) && std::isnan(found)))
          << value << " became " << found;
    } else {
      EXPECT_EQ(code, IRP_RANGE);
      EXPECT_FALSE(value - value == 0) << value << " is a number: " << irp_error();
    }
  }
}

}  // namespace
}  // namespace indurop::c
