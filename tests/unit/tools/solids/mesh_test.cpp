// SPDX-License-Identifier: Apache-2.0
// Files of meshes: what is read has the size and place that the file says.
#include "tools/solids/mesh.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>

#include "core/base/temporary_folder.h"
#include "tests/unit/tools/solids/bodies.h"
#include "tools/solids/cut.h"

namespace indurop::solids {
namespace {

class Meshes : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& name, const std::string& bytes) {
    const std::filesystem::path file = folder_.path() / name;
    std::ofstream(file, std::ios::binary) << bytes;
    return file;
  }

  base::TemporaryFolder folder_;
};

Eigen::AlignedBox3d extent_of(const Surface& surface) {
  Eigen::AlignedBox3d extent;
  for (const Vec3& corner : corners_of(surface)) {
    extent.extend(corner);
  }
  return extent;
}

void expect_extent(const Result<Surface, base::Problem>& surface, const Vec3& least, const Vec3& most) {
  ASSERT_TRUE(surface) << surface.error().text;
  EXPECT_TRUE(extent_of(*surface).min().isApprox(least, 1e-6)) << extent_of(*surface).min().transpose();
  EXPECT_TRUE(extent_of(*surface).max().isApprox(most, 1e-6)) << extent_of(*surface).max().transpose();
}

const Pose kPlace{{0.1, 0.2, 0.5}, robot::Quat::Identity()};
const Vec3 kLowCorner(0, 0.05, 0.3), kHighCorner(0.2, 0.35, 0.7);

Surface body() {
  return placed(box_surface({0.2, 0.3, 0.4}), kPlace);
}

std::string binary_stl(const Surface& surface) {
  std::string bytes(80, ' ');
  const auto put = [&bytes](const auto& value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    bytes.append(raw, sizeof value);
  };
  put(static_cast<std::uint32_t>(surface.size()));
  for (const Triangle& triangle : surface) {
    for (const Vec3& vector : {Vec3(0, 0, 0), triangle[0], triangle[1], triangle[2]}) {
      put(static_cast<float>(vector.x()));
      put(static_cast<float>(vector.y()));
      put(static_cast<float>(vector.z()));
    }
    put(std::uint16_t{0});
  }
  return bytes;
}

std::string text_stl(const Surface& surface) {
  std::string text = "solid body\n";
  for (const Triangle& triangle : surface) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const Vec3& corner : triangle) {
      text += fmt::format("vertex {} {} {}\n", corner.x(), corner.y(), corner.z());
    }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid body\n";
}

std::string obj(const Surface& surface) {
  std::string text;
  for (const Vec3& corner : corners_of(surface)) {
    text += fmt::format("v {} {} {}\n", corner.x(), corner.y(), corner.z());
  }
  for (std::size_t i = 0; i < surface.size(); ++i) {
    text += fmt::format("f {} {} {}\n", 3 * i + 1, 3 * i + 2, 3 * i + 3);
  }
  return text;
}

// In millimetres, with y upwards, and moved by a node of the scene.
std::string collada(const Surface& surface) {
  std::string places;
  std::string numbers;
  for (const Vec3& corner : corners_of(surface)) {
    places += fmt::format("{} {} {} ", 1000 * corner.x() - 7, 1000 * corner.y(), 1000 * corner.z());
  }
  for (std::size_t i = 0; i < 3 * surface.size(); ++i) {
    numbers += fmt::format("{} ", i);
  }
  return fmt::format(
      R"(<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="millimeter" meter="0.001"/><up_axis>Y_UP</up_axis></asset>
<library_geometries><geometry id="body"><mesh>
<source id="places"><float_array id="numbers" count="{0}">{1}</float_array>
<technique_common><accessor source="#numbers" count="{2}" stride="3">
<param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="corners"><input semantic="POSITION" source="#places"/></vertices>
<triangles count="{3}"><input semantic="VERTEX" source="#corners" offset="0"/><p>{4}</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="scene"><node id="node"><translate>7 0 0</translate>
<instance_geometry url="#body"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#scene"/></scene>
</COLLADA>
)",
      9 * surface.size(), places, 3 * surface.size(), surface.size(), numbers);
}

TEST_F(Meshes, Of_each_kind_are_as_large_as_the_file_says) {
  for (const auto& [name, bytes] : {std::pair("body.stl", binary_stl(body())), std::pair("text.stl", text_stl(body())),
                                    std::pair("body.obj", obj(body())), std::pair("body.dae", collada(body()))}) {
    SCOPED_TRACE(name);
    const auto surface = read_mesh(write(name, bytes), Vec3::Ones());
    expect_extent(surface, kLowCorner, kHighCorner);
    EXPECT_EQ(surface->size(), body().size());
  }
}

TEST_F(Meshes, Are_scaled_and_mirrored) {
  expect_extent(read_mesh(write("body.stl", binary_stl(body())), {2, -1, 0.5}), {0, -0.35, 0.15}, {0.4, -0.05, 0.35});
}

TEST_F(Meshes, That_cannot_be_read_are_reported) {
  EXPECT_EQ(read_mesh(folder_.path(), Vec3::Ones()).error().text, "it is not an ordinary file");
  EXPECT_NE(read_mesh(write("body.stl", "solid"), Vec3::Ones()).error().text, "");
  EXPECT_NE(read_mesh(write("body.xyz", "0 0 0"), Vec3::Ones()).error().text, "");
  EXPECT_NE(read_mesh(write("none.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n"), Vec3::Ones()).error().text, "");
  std::string cut_off = binary_stl(body());
  cut_off.resize(cut_off.size() / 2);
  EXPECT_NE(read_mesh(write("half.stl", cut_off), Vec3::Ones()).error().text, "");
  Surface endless = body();
  endless[3][1].y() = 1e300;
  EXPECT_EQ(read_mesh(write("endless.stl", binary_stl(endless)), Vec3::Ones()).error().text,
            "it has a point that is no number");
}

}  // namespace
}  // namespace indurop::solids
