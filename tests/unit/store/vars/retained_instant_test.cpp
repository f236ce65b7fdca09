// SPDX-License-Identifier: Apache-2.0
// Retained values are saved while modules write them.

#include <gmock/gmock.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <thread>

#include "core/rt/relax.h"
#include "store/vars/retain.h"
#include "store/vars/shm_file.h"
#include "test_schema.h"

namespace indurop::vars {
namespace {

using test::hash;
using test::scalar_type;
using test::TestNode;
using test::variable;

schema::Schema schema_with_two() {
  schema::Schema schema;
  schema.variables.push_back(variable("a::count", scalar_type(schema::Base::UInt64), true));
  schema.variables.push_back(variable("a::half", scalar_type(schema::Base::Double), true));
  return schema;
}

template <class T>
void set(Store& store, const char* name, T value) {
  EXPECT_TRUE(store.write(*store.find(hash(name)), 0, test::bytes_of(value)).ok());
}

template <class T>
T get(const Store& store, const char* name) {
  T value{};
  std::vector<std::uint8_t> bytes(sizeof value);
  EXPECT_TRUE(store.read(*store.find(hash(name)), 0, bytes).ok());
  std::memcpy(&value, bytes.data(), sizeof value);
  return value;
}

// Values that a module writes one after the other are never further apart than between two of its writes.
TEST(RetainedInstant, Is_the_same_for_all_values) {
  const TestNode node("instant");
  const TestNode other("instant_other");
  Store store = Store::create(node.name(), schema_with_two()).value();
  Store restored = Store::create(other.name(), schema_with_two()).value();
  std::string directory = std::string(kShmDirectory) + "/t-instant-XXXXXX";
  ASSERT_NE(::mkdtemp(directory.data()), nullptr);
  {
    const std::jthread writer([&store](const std::stop_token& end) {
      for (std::uint64_t count = 1; !end.stop_requested(); ++count) {
        set(store, "a::count", count);
        set(store, "a::half", static_cast<double>(count) / 2);
        for (int pause = 0; pause < 2'000; ++pause) {
          rt::relax();
        }
      }
    });
    RetainFile sut(directory);
    for (int i = 0; i < 3'000; ++i) {
      ASSERT_TRUE(sut.save(store).ok());
      ASSERT_TRUE(RetainFile(directory).load(restored).ok());
      const auto count = static_cast<double>(get<std::uint64_t>(restored, "a::count"));
      EXPECT_THAT(get<double>(restored, "a::half") * 2, testing::AnyOf(count, count - 1)) << "save " << i;
    }
  }
  std::filesystem::remove_all(directory);
}

}  // namespace
}  // namespace indurop::vars
