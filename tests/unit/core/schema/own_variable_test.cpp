// SPDX-License-Identifier: Apache-2.0
// Symbols as g++ 12 writes them.

#include "core/schema/own_variable.h"

#include <gtest/gtest.h>

namespace indurop::schema {
namespace {

TEST(OwnVariable, Has_the_name_that_its_author_wrote) {
  EXPECT_EQ(own_variable("counter"), "counter");
  EXPECT_EQ(own_variable("calls.0"), "calls");
  EXPECT_EQ(own_variable("_ZN12_GLOBAL__N_17countedE"), "counted");
  EXPECT_EQ(own_variable("_ZL5count"), "count");
  EXPECT_EQ(own_variable("_ZN6Filter4lastE"), "Filter::last");
  EXPECT_EQ(own_variable("_ZZ5onRunvE5count"), "count");
  EXPECT_EQ(own_variable("_ZZN12_GLOBAL__N_14Pump4stepEiE5count"), "count");
}

TEST(OwnVariable, Is_nothing_of_compilers_and_their_libraries) {
  for (const char* symbol :
       {"", "completed.0", "__dso_handle", "_DYNAMIC", "__gcov_.main", "DW.ref.__gxx_personality_v0", "_ZStL8__ioinit",
        "_ZGVZ5onRunvE5count", "_ZTVN6FilterE", "_ZTI6Filter", "_ZGR5count_", "_ZSt4cout", "_ZN5Eigen8internal5cacheE",
        "__odr_asan.counter"}) {
    EXPECT_EQ(own_variable(symbol), std::nullopt) << symbol;
  }
}

TEST(OwnVariable, Is_nothing_of_the_platform) {
  for (const char* symbol :
       {"_ZN34indurop_generated_506ffb9e97fb4a3c4refsE", "_ZL24indurop_implementation_0", "indurop_marker",
        "_ZN7indurop6detail5countE", "_ZZ20indurop_module_stateE14indurop_items_", "_ZN3irp4lastE"}) {
    EXPECT_EQ(own_variable(symbol), std::nullopt) << symbol;
  }
}

}  // namespace
}  // namespace indurop::schema
