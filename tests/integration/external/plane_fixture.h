// SPDX-License-Identifier: Apache-2.0
// The external plane of a store of this test's own, and a participant that receives it.

#pragma once

#include <dds/dds.h>
#include <gmock/gmock.h>
#include <indurop/generated.h>
#include <indurop/indurop.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/schema/elf.h"
#include "kinds.h"
#include "live.h"
#include "network/dds/entity.h"
#include "network/mirror/external/external.h"
#include "network/mirror/external/external_block.h"
#include "network/mirror/external/external_type.h"
#include "store/vars/store.h"
#include "tests/support/dds_domain.h"
#include "tests/support/program.h"

namespace indurop::test {

using mirror::Exported;
using mirror::ExternalBlock;

inline schema::Schema own_schema() {
  const auto file = schema::read_module_file("/proc/self/exe");
  return schema::from_json(file.value().schema_json).value();
}

class Plane : public ::testing::Test {
 protected:
  Plane() : schema_(own_schema()) { leave_the_network(); }
  ~Plane() override {
    if (participant_ > 0) {
      dds_delete(participant_);
    }
    sut_.reset();
    store_.reset();
    (void)vars::remove_node(node());
  }

  static std::string node() { return "et" + std::to_string(::getpid()); }
  // Tests that run at the same time do not hear each other.
  static int domain() { return dds_domain(); }

  // `more`: further variables of type kinds::Inner, named kinds::moreN.
  void start(int more = 0, bool ros2 = false) {
    const auto inner = std::find_if(schema_.variables.begin(), schema_.variables.end(),
                                    [](const auto& v) { return v.name == "kinds::wanted_inner"; });
    const schema::Variable pattern = *inner;
    for (int i = 0; i < more; ++i) {
      schema_.variables.push_back(pattern);
      schema_.variables.back().name = "kinds::more" + std::to_string(i);
    }
    auto store = vars::Store::create(node(), schema_);
    ASSERT_TRUE(store.ok());
    store_ = std::move(store).value();
    mirror::ExternalSettings settings;
    settings.network.domain = domain();
    settings.network.one_host = true;
    settings.ros2 = ros2;
    settings.network.board = node();
    for (const schema::Variable& variable : schema_.variables) {
      settings.variables.push_back(
          {variable.name, descriptor_of(variable), variable.name.find("wanted") != std::string::npos, 0});
    }
    auto started = mirror::External::start(settings, node(), *store_, nullptr);
    ASSERT_TRUE(started.ok());
    sut_ = std::move(started).value();
    auto file = vars::ShmFile::open(vars::external_file(node()), vars::Mode::ReadOnly);
    ASSERT_TRUE(file.ok());
    file_ = std::move(file).value();
    ASSERT_TRUE(wait_until([&] { return block().network.load() == mirror::Network::Up; })) << block().problem.get();
    participant_ = dds_create_participant(static_cast<dds_domainid_t>(domain()), nullptr, nullptr);
    ASSERT_GT(participant_, 0);
  }

  static const void* descriptor_of(const schema::Variable& variable) {
    for (const dds_topic_descriptor_t* type :
         {&kinds_All_desc, &kinds_Inner_desc, &kinds_tick__desc, &kinds_colour__desc, &kinds_word__desc,
          &kinds_pair__desc, &kinds_wanted__desc, &kinds_rigid__desc}) {
      if (mirror::descriptor_problem(type, variable).empty()) {
        return type;
      }
    }
    ADD_FAILURE() << "no type for " << variable.name;
    return nullptr;
  }

  const ExternalBlock& block() const { return *reinterpret_cast<const ExternalBlock*>(file_->data()); }

  template <class T>
  void put(const std::string& variable, const T& value) {
    const auto* entry = store_->find(abi::fnv1a64(variable.data(), variable.size()));
    ASSERT_NE(entry, nullptr);
    ASSERT_EQ(entry->value_size, sizeof value);
    std::array<std::uint8_t, sizeof value> bytes{};
    std::memcpy(bytes.data(), &value, sizeof value);
    ASSERT_TRUE(store_->write(*entry, 0, bytes).ok());
  }
  template <class T>
  T get(const std::string& variable) {
    const auto* entry = store_->find(abi::fnv1a64(variable.data(), variable.size()));
    std::array<std::uint8_t, sizeof(T)> bytes{};
    EXPECT_TRUE(store_->read(*entry, 0, bytes).ok());
    T value;
    std::memcpy(&value, bytes.data(), sizeof value);
    return value;
  }

  dds_entity_t reader(const dds_topic_descriptor_t& type, const char* topic, bool late_joiner = true) {
    const std::unique_ptr<dds_qos_t, decltype(&dds_delete_qos)> qos(dds_create_qos(), &dds_delete_qos);
    dds_qset_reliability(qos.get(), DDS_RELIABILITY_RELIABLE, 0);
    dds_qset_durability(qos.get(), late_joiner ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
    dds_qset_history(qos.get(), DDS_HISTORY_KEEP_ALL, DDS_LENGTH_UNLIMITED);
    const dds_entity_t made = dds_create_topic(participant_, &type, topic, nullptr, nullptr);
    EXPECT_GT(made, 0);
    return dds_create_reader(participant_, made, qos.get(), nullptr);
  }
  dds_entity_t writer(const dds_topic_descriptor_t& type, const char* topic) {
    const dds_entity_t made = dds_create_topic(participant_, &type, topic, nullptr, nullptr);
    EXPECT_GT(made, 0);
    return dds_create_writer(participant_, made, nullptr, nullptr);  // reliable unless said otherwise
  }
  static bool matched(dds_entity_t writer) {
    dds_publication_matched_status_t status{};
    dds_get_publication_matched_status(writer, &status);
    return status.current_count > 0;
  }
  // The next value, if there is one.
  template <class T>
  static std::optional<T> take(dds_entity_t reader) {
    void* sample = nullptr;
    dds_sample_info_t info{};
    if (dds_take(reader, &sample, &info, 1, 1) <= 0) {
      return std::nullopt;
    }
    std::optional<T> value;
    if (info.valid_data) {
      value = *static_cast<const T*>(sample);
    }
    dds_return_loan(reader, &sample, 1);
    return value;
  }
  // True as soon as a value fulfils the condition.
  template <class T, class Condition>
  static bool receives(dds_entity_t reader, Condition condition) {
    return wait_until([&] {
      const auto value = take<T>(reader);
      return value && condition(*value);
    });
  }

  schema::Schema schema_;
  std::optional<vars::Store> store_;
  std::optional<mirror::External> sut_;
  std::optional<vars::ShmFile> file_;
  dds_entity_t participant_ = 0;
};

}  // namespace indurop::test
