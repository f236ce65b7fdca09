// SPDX-License-Identifier: Apache-2.0
#include "node/parts/force_watch.h"

#include <gtest/gtest.h>

#include <chrono>
#include <string>

#include "store/operate/hold.h"
#include "store/vars/custody.h"
#include "tests/unit/store/vars/test_schema.h"

namespace indurop::node {
namespace {

using vars::test::TestNode;

class ForceWatching : public testing::Test {
 protected:
  static schema::Schema one_number() {
    schema::Schema schema;
    schema.variables.push_back(vars::test::variable("gain", vars::test::scalar_type(schema::Base::Int32)));
    return schema;
  }
  ~ForceWatching() override { static_cast<void>(vars::remove_shm_file(vars::custody_file(node_.name()))); }

  operate::Lease hold(const std::string& value, std::int64_t for_ns, operate::Ends ends) {
    const auto assignment = operate::parse(store_, "gain=" + value);
    EXPECT_TRUE(assignment.ok());
    auto lease = operate::hold(node_.name(), store_, {*assignment}, for_ns, ends, {"anna", "", ""});
    EXPECT_TRUE(lease.ok());
    return lease ? *lease : operate::Lease{};
  }
  // What the node prints now.
  std::string reported() {
    testing::internal::CaptureStderr();
    sut_.report_changes(store_, console_);
    return testing::internal::GetCapturedStderr();
  }

  TestNode node_{"force-watch"};
  vars::Store store_ = vars::Store::create(node_.name(), one_number()).value();
  vars::Custody custody_ = vars::Custody::create(node_.name()).value();
  Console console_{node_.name(), false};
  ForceWatch sut_{node_.name()};
  static constexpr std::int64_t kMinute = std::chrono::nanoseconds(std::chrono::minutes(1)).count();
};

TEST_F(ForceWatching, A_lease_is_reported_once_however_often_it_is_renewed) {
  operate::Lease lease = hold("5", kMinute, operate::Ends::UnlessRenewed);
  EXPECT_NE(reported().find("gain is forced to 5 as long as its client renews that"), std::string::npos);
  for (int i = 2; i < 5; ++i) {
    ASSERT_TRUE(operate::renew(lease, store_, i * kMinute).ok());
    EXPECT_EQ(reported(), "");
  }
  operate::end(node_.name(), store_, lease, {"anna", "", ""});
  EXPECT_NE(reported().find("gain is no longer forced"), std::string::npos);
}

TEST_F(ForceWatching, Another_value_and_another_end_of_a_force_are_reported) {
  hold("5", 0, operate::Ends::AtTime);
  EXPECT_NE(reported().find("gain is forced to 5 until it is released"), std::string::npos);
  EXPECT_EQ(reported(), "");
  hold("6", 0, operate::Ends::AtTime);
  EXPECT_NE(reported().find("gain is forced to 6 until it is released"), std::string::npos);
  hold("6", kMinute, operate::Ends::AtTime);
  EXPECT_NE(reported().find("gain is forced to 6 for "), std::string::npos);
}

}  // namespace
}  // namespace indurop::node
