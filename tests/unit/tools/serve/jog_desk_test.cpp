// SPDX-License-Identifier: Apache-2.0
// The desk of jogs while other clients write ROBOT_JOG, too.
#include "tools/serve/jog/jog_desk.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <cstring>
#include <filesystem>
#include <span>
#include <thread>

#include "core/schema/schema.h"
#include "store/vars/store.h"

namespace indurop::serve {
namespace {

constexpr std::uint32_t kSixthSpeed = 48;  // offset of dSpeed[5]

void add_field(schema::Type& to, const char* name, schema::Base base, std::uint32_t offset, std::uint32_t count = 0) {
  schema::Field field;
  field.name = name;
  field.offset = offset;
  field.type.base = base;
  field.type.element_size = field.type.align = schema::size_of(base);
  if (count > 0) {
    field.type.dims = {count};
  }
  to.fields.push_back(field);
}

schema::Schema schema_of_a_robot() {
  schema::Variable jog;
  jog.name = "arm::ROBOT_JOG";
  jog.kind = abi::Kind::Ring;
  jog.type.base = schema::Base::Struct;
  jog.type.name = "arm::ROBOT_JOG_t";
  jog.type.element_size = 64;
  jog.type.align = 8;
  add_field(jog.type, "bEnable", schema::Base::Int16, 0);
  add_field(jog.type, "eFrame", schema::Base::Int16, 2);
  add_field(jog.type, "dSpeed", schema::Base::Double, 8, 6);
  add_field(jog.type, "nBeat", schema::Base::UInt32, 56);
  jog.type_hash = schema::hash_of(jog.type);
  schema::Schema schema;
  schema.variables.push_back(jog);
  return schema;
}

// Reading the switch, changing its beat and writing all of it would press a switch again that was released in between.
TEST(Jog_desk, A_beat_takes_back_nothing_that_another_client_writes) {
  const std::string node = "jog_desk_" + std::to_string(::getpid());
  auto store = vars::Store::create(node, schema_of_a_robot());
  ASSERT_TRUE(store) << store.error().where;
  const auto file = std::filesystem::temp_directory_path() / (node + ".jsonl");
  const Audit audit(file);
  {
    JogDesk desk(audit);
    const auto jog = desk.begin(node, "arm", "anna", "here", {"base", {0, 0, 25}});
    ASSERT_TRUE(jog) << jog.error().text;
    Client anna;
    anna.name = "anna";
    std::atomic<bool> ended = false;
    std::atomic<int> beats = 0;
    std::thread keeping([&] {
      while (!ended && desk.keep(node, *jog, anna)) {
        ++beats;
      }
    });
    const vars::DirectoryEntry& variable = store->directory()[0];
    double found = 0;
    double written = 0;
    while (found == written && (written < 100'000 || beats < 10'000)) {
      ++written;
      const std::span bytes(reinterpret_cast<const std::uint8_t*>(&written), sizeof written);
      ASSERT_TRUE(store->write(variable, kSixthSpeed, bytes));
      ASSERT_TRUE(store->read(variable, kSixthSpeed, {reinterpret_cast<std::uint8_t*>(&found), sizeof found}));
    }
    ended = true;
    keeping.join();
    EXPECT_EQ(found, written) << "after " << beats << " beats";
    EXPECT_TRUE(desk.end(node, *jog, "anna"));
  }
  std::filesystem::remove(file);
  for (const auto& entry : std::filesystem::directory_iterator("/dev/shm")) {
    if (entry.path().filename().string().find(node) != std::string::npos) {
      std::filesystem::remove(entry.path());
    }
  }
}

}  // namespace
}  // namespace indurop::serve
