// SPDX-License-Identifier: Apache-2.0
// Types as OMG IDL.

#include "history/recording/omg_idl.h"

#include <gmock/gmock.h>

#include "tests/unit/core/schema/types.h"

namespace indurop::recording {
namespace {

using schema::Base;
using schema::number;
using schema::structure;
using schema::text;
using schema::Type;

TEST(OmgIdl, A_struct_comes_after_what_it_needs) {
  const Type mode = schema::enumeration("knu::mode_t", {{"OFF", 0}, {"ON", 1}, {"LOST", 7}, {"GONE", 8}, {"NONE", -1}});
  const Type point = structure("knu::Robot::point_t", {{"x", number(Base::Double)}, {"y", number(Base::Double)}});
  Type path = point;
  path.dims = {2, 3};
  const Type type = structure("knu::Robot::state_t", {{"home", point},
                                                      {"path", path},
                                                      {"mode", mode},
                                                      {"name", text(16)},
                                                      {"byte", number(Base::UInt8)},
                                                      {"on", number(Base::Bool, {4})}});
  const OmgIdl idl = omg_idl(type);
  EXPECT_EQ(idl.name, "knu::Robot::state_t");
  EXPECT_EQ(idl.text,
            "module knu {\n"
            "  module Robot {\n"
            "    @final struct point_t {\n"
            "      double x;\n"
            "      double y;\n"
            "    };\n"
            "  };\n"
            "};\n"
            "module knu {\n"
            "  enum mode_t { OFF, ON, @value(7) LOST, GONE, @value(-1) NONE };\n"
            "};\n"
            "module knu {\n"
            "  module Robot {\n"
            "    @final struct state_t {\n"
            "      knu::Robot::point_t _home;\n"
            "      knu::Robot::point_t path[2][3];\n"
            "      knu::mode_t mode;\n"
            "      string<15> name;\n"
            "      uint8 _byte;\n"
            "      boolean on[4];\n"
            "    };\n"
            "  };\n"
            "};\n");
}

TEST(OmgIdl, What_is_no_struct_is_wrapped) {
  EXPECT_EQ(omg_idl(number(Base::Double)).text,
            "module indurop {\n"
            "  @final struct value_double {\n"
            "    double value;\n"
            "  };\n"
            "};\n");
  EXPECT_EQ(omg_idl(number(Base::Double)).name, "indurop::value_double");
  EXPECT_EQ(omg_idl(number(Base::Int16, {3, 4})).name, "indurop::value_int16_3_4");
  EXPECT_EQ(omg_idl(text(16, {2})).name, "indurop::value_text_16_2");
  const OmgIdl idl = omg_idl(schema::enumeration("mode_t", {{"OFF", 0}}));
  EXPECT_EQ(idl.name, "indurop::value_mode_t");
  EXPECT_EQ(idl.text,
            "enum mode_t { OFF };\n"
            "module indurop {\n"
            "  @final struct value_mode_t {\n"
            "    mode_t value;\n"
            "  };\n"
            "};\n");
}

}  // namespace
}  // namespace indurop::recording
