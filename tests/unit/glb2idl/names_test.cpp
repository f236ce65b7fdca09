// SPDX-License-Identifier: Apache-2.0
#include "glb2idl/names.h"

#include <gtest/gtest.h>

#include <array>

namespace indurop::glb2idl {
namespace {

constexpr std::array<NameRole, 8> kRoles{NameRole::Namespace, NameRole::Type,       NameRole::Variable,
                                         NameRole::Constant,  NameRole::Enumerator, NameRole::Function,
                                         NameRole::Field,     NameRole::Parameter};

TEST(Names, Names_of_the_specification_pass) {
  for (const char* name : {"I0", "O0", "MAX_JOINTS", "ROBOT_MODULE_STATE", "ROBOT_MODULE_SERVICE", "AXIS1_IN", "tick",
                           "joints", "msgRobotServiceEditNum"}) {
    EXPECT_FALSE(objection(name, NameRole::Variable, false)) << name;
    EXPECT_FALSE(objection(name, NameRole::Variable, true)) << name;
  }
  for (const char* name :
       {"nAXESGROUP", "MotionDone", "Busy", "eState", "bRuntimeService", "dCurJoint", "nposeINFO", "eOpCode", "t_pl",
        "t_speed", "p_Target", "p_Mid", "error", "status", "mode", "position", "x", "y", "z"}) {
    EXPECT_FALSE(objection(name, NameRole::Field, false)) << name;
    EXPECT_FALSE(objection(name, NameRole::Variable, false)) << name;
  }
  EXPECT_FALSE(objection("PLC_ROBOT", NameRole::Namespace, true));
  EXPECT_FALSE(objection("knu", NameRole::Namespace, true));
}

TEST(Names, Keywords_of_C_and_Cpp_are_refused_everywhere) {
  for (const NameRole role : kRoles) {
    for (const char* name :
         {"class", "int", "default", "restrict", "and", "typename", "register", "NULL", "linux", "EOF", "M_PI"}) {
      EXPECT_TRUE(objection(name, role, false)) << name;
    }
  }
}

TEST(Names, Keywords_of_IDL_are_refused_only_where_they_cannot_be_escaped) {
  EXPECT_FALSE(objection("port", NameRole::Field, false));
  EXPECT_FALSE(objection("home", NameRole::Variable, false));
  EXPECT_FALSE(objection("Any", NameRole::Enumerator, false));
  EXPECT_TRUE(objection("port", NameRole::Type, false));
  EXPECT_TRUE(objection("Home", NameRole::Namespace, false));
}

TEST(Names, What_modules_use_without_prefix_is_refused) {
  EXPECT_TRUE(objection("lock", NameRole::Variable, false));
  EXPECT_FALSE(objection("lock", NameRole::Field, false));
  EXPECT_TRUE(objection("channel", NameRole::Namespace, false));
  EXPECT_TRUE(objection("get", NameRole::Field, false));
  EXPECT_FALSE(objection("get", NameRole::Variable, false));
  EXPECT_TRUE(objection("run", NameRole::Variable, true));
  EXPECT_FALSE(objection("run", NameRole::Variable, false));
  EXPECT_TRUE(objection("indurop_x", NameRole::Variable, false));
}

TEST(Names, A_proposal_has_no_objection) {
  const std::string longest(200, 'a');
  for (const NameRole role : kRoles) {
    for (const bool global : {false, true}) {
      for (const std::string& name :
           {std::string("class"), std::string("__a__b__"), std::string("_"), std::string("_1"), std::string("Port"),
            std::string("std"), std::string("lock"), std::string("size_t"), std::string("get"), std::string("time"),
            std::string("indurop"), longest}) {
        const std::string sut = proposal(name, role, global);
        EXPECT_FALSE(objection(sut, role, global)) << name << " -> " << sut;
      }
    }
  }
}

}  // namespace
}  // namespace indurop::glb2idl
