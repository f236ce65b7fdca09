// SPDX-License-Identifier: Apache-2.0
// Meshes found in URDF files, and the files with solids instead: what urdfdom reads there is what was put in.
#include "tools/solids/urdf_meshes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "control/robot/files/urdf.h"
#include "tests/unit/tools/solids/bodies.h"
#include "tools/solids/fit.h"

namespace indurop::solids {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr const char* kArm = R"(<?xml version="1.0"?>
<!-- ä <collision> that is none -->
<robot name="arm">
  <link name="base">
    <visual><geometry><mesh filename="base.dae"/></geometry></visual>
    <collision name="of the base">
      <!-- </collision> -->
      <origin xyz="0.1 0.2 0.3" rpy="0 0 1.5"/>
      <geometry><mesh filename="package://arm/base.stl" scale="0.001 0.001 0.001"/></geometry>
    </collision>
    <collision><geometry><box size="0.1 0.1 0.1"/></geometry></collision>
  </link>
  <link name="Ärmel"><collision><geometry><mesh filename="a.stl"/></geometry></collision ><visual/></link>
  <joint name="j1" type="revolute"><parent link="base"/><child link="Ärmel"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" velocity="1" effort="0"/></joint>
</robot>
)";

std::vector<std::string> mistakes_in(const std::string& text) {
  std::vector<std::string> mistakes;
  for (const base::Diagnostic& one : find_meshes("arm.urdf", text).mistakes) {
    mistakes.push_back(base::to_string(one));
  }
  return mistakes;
}

TEST(Urdf_meshes, Are_those_of_collisions_only) {
  const FoundMeshes found = find_meshes("arm.urdf", kArm);
  EXPECT_THAT(mistakes_in(kArm), IsEmpty());
  ASSERT_EQ(found.meshes.size(), 2U);
  const CollisionMesh& first = found.meshes[0];
  EXPECT_EQ(first.link, "base");
  EXPECT_EQ(first.uri, "package://arm/base.stl");
  EXPECT_EQ(first.place, (base::SourcePlace{6, 5}));
  EXPECT_TRUE(first.origin.position.isApprox(Vec3(0.1, 0.2, 0.3)));
  EXPECT_TRUE(robot::to_rpy(first.origin.orientation).isApprox(Vec3(0, 0, 1.5)));
  EXPECT_TRUE(first.scale.isApprox(Vec3(0.001, 0.001, 0.001)));
  const std::string text = kArm;
  EXPECT_THAT(text.substr(first.begin, first.end - first.begin), testing::EndsWith("</geometry>\n    </collision>"));
  const CollisionMesh& second = found.meshes[1];
  EXPECT_EQ(text.substr(second.begin, second.end - second.begin),
            "<collision><geometry><mesh filename=\"a.stl\"/></geometry></collision >");
  EXPECT_TRUE(second.scale.isApprox(Vec3::Ones()));
}

TEST(Urdf_meshes, Give_way_to_solids_and_the_rest_stays) {
  const FoundMeshes found = find_meshes("arm.urdf", kArm);
  const robot::Solid ball = robot::Solid::ball(0.25, {{1, -0.5, 0}, robot::Quat::Identity()});
  const robot::Solid box = robot::Solid::box({0.2, 0.3, 0.4}, {{0, 0, 0}, robot::from_rpy({0, 0, 1.5})});
  const std::string text = with_solids(kArm, found.meshes, {{ball, box}, {}});
  EXPECT_THAT(text, HasSubstr(R"(    <collision>
      <origin xyz="1 -0.5 0" rpy="0 0 0"/>
      <geometry><sphere radius="0.25"/></geometry>
    </collision>
    <collision>
      <origin xyz="0 0 0" rpy="0 0 1.5"/>
      <geometry><box size="0.2 0.3 0.4"/></geometry>
    </collision>
    <collision><geometry><box size="0.1 0.1 0.1"/></geometry></collision>
  </link>
  <link name="Ärmel"><visual/></link>
)"));
  EXPECT_THAT(text, HasSubstr(R"(<mesh filename="base.dae"/>)"));
  EXPECT_THAT(find_meshes("arm.urdf", text).meshes, IsEmpty());
}

// In a base's own frame, as urdfdom reads them.
std::vector<Solid> read_back(const std::string& text) {
  const auto arm = robot::arm_from_urdf("arm.urdf", text);
  if (!arm) {
    ADD_FAILURE() << base::to_text(arm.error());
    return {};
  }
  for (const robot::LinkBody& body : arm->bodies) {
    if (body.name == "base") {
      return body.solids;
    }
  }
  return {};
}

TEST(Urdf_meshes, Random_solids_come_back_as_they_were) {
  Chance chance(1);
  const FoundMeshes found = find_meshes("arm.urdf", kArm);
  for (int round = 0; round < 60; ++round) {
    std::vector<Vec3> points;
    for (int i = 0; i < 6; ++i) {
      points.push_back(vector_between(chance, -0.3, 0.3));
    }
    Solid solid;
    solid.kind = static_cast<robot::SolidKind>(round % 3);
    solid.place = pose_within(chance, 0.3);
    solid = rounded(solid, points);
    const std::vector<Solid> back = read_back(with_solids(kArm, found.meshes, {{solid}, {}}));
    ASSERT_EQ(back.size(), 2U);  // the other one is the box that was there
    EXPECT_EQ(back[0].kind, solid.kind);
    EXPECT_TRUE(back[0].half.isApprox(solid.half, 1e-9));
    EXPECT_TRUE(back[0].place.position.isApprox(solid.place.position, 1e-9));
    EXPECT_LT(back[0].place.orientation.angularDistance(solid.place.orientation), 1e-9);
  }
}

TEST(Urdf_meshes, Say_all_that_is_wrong) {
  EXPECT_THAT(mistakes_in("<sdf/>"),
              ElementsAre("arm.urdf:1:1: error: a URDF file is a <robot> with links, not a <sdf>"));
  EXPECT_THAT(mistakes_in("<robot><link name='a'>\n<collision><geometry><mesh/></geometry></collision>\n"
                          "<collision><origin xyz='1 2'/><geometry><mesh filename='a.stl'/></geometry></collision>\n"
                          "<collision><geometry><mesh filename='a.stl' scale='1 0 1'/></geometry></collision>\n"
                          "<collision><origin rpy='0 0 pi'/><geometry><mesh filename='a.stl'/></geometry></collision>\n"
                          "</link></robot>"),
              ElementsAre("arm.urdf:2:22: error: <mesh> needs filename=\"...\"",
                          "arm.urdf:3:25: error: xyz is three numbers, not '1 2'",
                          "arm.urdf:4:22: error: scale has to be another number than 0 in each direction",
                          "arm.urdf:5:25: error: rpy is three numbers, not '0 0 pi'"));
  EXPECT_THAT(mistakes_in("<robot><link>"), Not(IsEmpty()));
  EXPECT_THAT(mistakes_in(""), Not(IsEmpty()));
}

TEST(Urdf_meshes, Of_files_that_end_anywhere_are_found_or_refused) {
  const std::string text = kArm;
  for (std::size_t length = 0; length < text.size() - 1; ++length) {
    EXPECT_THAT(mistakes_in(text.substr(0, length)), Not(IsEmpty())) << length;
  }
}

}  // namespace
}  // namespace indurop::solids
