// SPDX-License-Identifier: Apache-2.0
// Where <mesh filename="..."> leads to.
#include "tools/solids/mesh_file.h"

#include <gtest/gtest.h>

#include <fstream>

#include "core/base/temporary_folder.h"

namespace indurop::solids {
namespace {

namespace fs = std::filesystem;

class MeshFiles : public testing::Test {
 protected:
  MeshFiles() {
    for (const char* folder : {"ws/arm/urdf", "ws/arm/meshes", "ws/gripper/meshes", "elsewhere/meshes"}) {
      fs::create_directories(folder_.path() / folder);
    }
    for (const char* file : {"ws/arm/meshes/a.stl", "ws/gripper/meshes/g.stl", "elsewhere/meshes/e.stl"}) {
      std::ofstream(folder_.path() / file) << "x";
    }
  }

  // Below the folder of the test, or what is wrong.
  std::string find(const std::string& uri, const Packages& packages = {}) {
    const auto file = mesh_file(uri, folder_.path() / "ws/arm/urdf/arm.urdf", packages);
    return file ? fs::relative(*file, folder_.path()).string() : file.error().text;
  }

  base::TemporaryFolder folder_;
};

TEST_F(MeshFiles, Of_packages_are_in_the_folders_around) {
  EXPECT_EQ(find("package://arm/meshes/a.stl"), "ws/arm/meshes/a.stl");
  EXPECT_EQ(find("package://gripper/meshes/g.stl"), "ws/gripper/meshes/g.stl");
  EXPECT_EQ(find("model://gripper/meshes/g.stl"), "ws/gripper/meshes/g.stl");
}

TEST_F(MeshFiles, Of_packages_elsewhere_are_where_the_user_says) {
  const Packages packages = {{"tool", folder_.path() / "elsewhere"}};
  EXPECT_EQ(find("package://tool/meshes/e.stl", packages), "elsewhere/meshes/e.stl");
  EXPECT_EQ(find("package://tool/meshes/e.stl"),
            "there is no tool/meshes/e.stl in the folders around the URDF file; say where it is with --package "
            "tool=FOLDER");
  EXPECT_EQ(find("package://tool/none.stl", packages),
            "there is no " + (folder_.path() / "elsewhere/none.stl").string());
}

TEST_F(MeshFiles, Without_a_package_are_next_to_the_file) {
  EXPECT_EQ(find("../meshes/a.stl"), "ws/arm/meshes/a.stl");
  EXPECT_EQ(find("file://" + (folder_.path() / "elsewhere/meshes/e.stl").string()), "elsewhere/meshes/e.stl");
  EXPECT_EQ(find((folder_.path() / "elsewhere/meshes/e.stl").string()), "elsewhere/meshes/e.stl");
  EXPECT_EQ(find("a.stl"), "there is no " + (folder_.path() / "ws/arm/urdf/a.stl").string());
}

TEST_F(MeshFiles, With_odd_names_lead_nowhere) {
  std::ofstream(folder_.path() / "ws/x") << "in a folder above that of the file";
  for (const char* uri :
       {"package://", "package:///", "package://arm", "package://arm/", "package://../x", "file://"}) {
    SCOPED_TRACE(uri);
    const auto file = mesh_file(uri, folder_.path() / "ws/arm/urdf/arm.urdf", {});
    EXPECT_FALSE(file.ok() && fs::is_regular_file(*file));
  }
}

}  // namespace
}  // namespace indurop::solids
