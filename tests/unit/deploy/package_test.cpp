// SPDX-License-Identifier: Apache-2.0
// What travels to boards, and what a board makes of a package it is sent.

#include "deploy/transaction/package.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <fstream>

#include "core/keys/digest.h"

namespace indurop::deploy {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Package sample() {
  Package package;
  package.plant = "cell";
  package.manifest = "plant.xml";
  package.boards = {"a", "b"};
  package.files = {{"mods/x.so", std::string(64, 'a'), 10, true}, {"plant.xml", std::string(64, 'b'), 20, false}};
  return package;
}

std::string problem_of(const Package& package) {
  const auto sut = read_package(to_text(package));
  return sut ? "" : sut.error().text;
}

TEST(Digest, Known_values) {
  EXPECT_EQ(keys::digest_of(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(keys::digest_of("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_FALSE(keys::is_digest(std::string(63, 'a')));
  EXPECT_FALSE(keys::is_digest(std::string(64, 'A')));
}

TEST(Package, Text_and_back) {
  const auto sut = read_package(to_text(sample()));
  ASSERT_TRUE(sut) << sut.error().text;
  EXPECT_EQ(to_text(*sut), to_text(sample()));
  EXPECT_TRUE(sut->files[0].executable);
}

TEST(Package, Paths_that_leave_the_folder_are_refused) {
  for (const char* path : {"../x", "/etc/passwd", "a/../../x", "a//b", "./x", "", "a/", "a/.."}) {
    Package bad = sample();
    bad.files[0].path = path;
    EXPECT_THAT(problem_of(bad), HasSubstr("is not a path")) << path;
  }
}

TEST(Package, What_contradicts_itself_is_refused) {
  Package twice = sample();
  twice.files[0].path = "plant.xml";
  EXPECT_THAT(problem_of(twice), HasSubstr("twice"));
  Package below = sample();
  below.files[0].path = "plant.xml/x";
  EXPECT_THAT(problem_of(below), HasSubstr("both a file and a folder"));
  Package digest = sample();
  digest.files[0].digest = "../../x";
  EXPECT_THAT(problem_of(digest), HasSubstr("SHA-256"));
  Package manifest = sample();
  manifest.manifest = "other.xml";
  EXPECT_THAT(problem_of(manifest), HasSubstr("manifest"));
  Package huge = sample();
  huge.files[0].size = ~std::uint64_t{0};
  EXPECT_THAT(problem_of(huge), HasSubstr("larger"));
}

TEST(Package, Garbage_is_no_package) {
  for (const char* text :
       {"", "{", "[]", "null", "{\"indurop_package\":1}", "{\"indurop_package\":\"x\"}",
        "{\"indurop_package\":1,\"plant\":1,\"manifest\":2,\"boards\":3,\"files\":4}",
        "{\"indurop_package\":1,\"plant\":\"p\",\"manifest\":\"m\",\"boards\":[1],\"files\":[]}",
        "{\"indurop_package\":1,\"plant\":\"p\",\"manifest\":\"m\",\"boards\":[\"a\"],\"files\":[{}]}"}) {
    const auto sut = read_package(text);
    ASSERT_FALSE(sut) << text;
    EXPECT_NE(sut.error().text, "") << text;
  }
  EXPECT_THAT(read_package("{\"indurop_package\":2}").error().text, HasSubstr("another InduRoP version"));
}

class Packing : public testing::Test {
 protected:
  Packing() : folder_(std::filesystem::temp_directory_path() / ("irp-pack-" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(folder_ / "cell");
    std::filesystem::create_directories(folder_ / "mods");
    put("cell/plant.xml", "manifest");
    put("mods/x.so", "module");
  }
  ~Packing() override { std::filesystem::remove_all(folder_); }
  void put(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
  config::Plant plant(const std::string& module) const {
    config::Plant out;
    out.file = folder_ / "cell/plant.xml";
    out.name = "cell";
    out.boards.resize(1);
    out.boards[0].name = "a";
    out.boards[0].config.modules.resize(1);
    out.boards[0].config.modules[0].file_as_written = module;
    return out;
  }
  std::filesystem::path folder_;
};

TEST_F(Packing, Files_keep_their_places_to_each_other) {
  const auto sut = pack_plant(plant("../mods/x.so"), {folder_});
  ASSERT_TRUE(sut) << sut.error().text;
  ASSERT_EQ(sut->package.files.size(), 2U);
  EXPECT_EQ(sut->package.manifest, "cell/plant.xml");
  EXPECT_EQ(sut->package.files[1].path, "mods/x.so");
  EXPECT_EQ(sut->package.files[1].digest, keys::digest_of("module"));
  EXPECT_EQ(sut->sources.at(keys::digest_of("module")), folder_ / "mods/x.so");
  EXPECT_EQ(sut->id, keys::digest_of(sut->text));
}

TEST_F(Packing, One_changed_byte_is_another_deployment) {
  const std::string before = pack_plant(plant("../mods/x.so"), {folder_})->id;
  EXPECT_EQ(pack_plant(plant("../mods/x.so"), {folder_})->id, before);
  put("mods/x.so", "Module");
  EXPECT_NE(pack_plant(plant("../mods/x.so"), {folder_})->id, before);
}

TEST_F(Packing, What_lies_outside_of_the_folder_does_not_travel_unless_it_was_allowed) {
  put("secret.txt", "not for boards");
  put("cell/plain.txt", "of the plant");
  std::filesystem::create_symlink(folder_ / "secret.txt", folder_ / "cell/link.txt");
  config::Plant with = plant("./x.so");
  put("cell/x.so", "module");
  auto& properties = with.boards[0].config.modules[0].properties;
  for (const char* named : {"../secret.txt", "link.txt", "../cell/../secret.txt", "plain.txt link.txt"}) {
    properties = {{"x", named}};
    const auto sut = pack_plant(with);
    ASSERT_FALSE(sut) << named;
    EXPECT_THAT(sut.error().text, HasSubstr((folder_ / "secret.txt").string())) << named;
    EXPECT_THAT(sut.error().text, HasSubstr("--also FOLDER"));
    EXPECT_TRUE(pack_plant(with, {folder_})) << named;
  }
  properties = {{"x", "plain.txt"}};
  EXPECT_TRUE(pack_plant(with));
  // A module is named by the manifest, and is a program: others may have built it elsewhere.
  EXPECT_THAT(pack_plant(plant("../secret.txt")).error().text, HasSubstr("secret.txt"));
  std::filesystem::remove(folder_ / "cell/x.so");
  std::filesystem::create_symlink(folder_ / "secret.txt", folder_ / "cell/x.so");
  EXPECT_THAT(pack_plant(plant("./x.so")).error().text, HasSubstr("secret.txt"));
  put("mods/x.so",
      "\x7f"
      "ELF and so on");
  EXPECT_TRUE(pack_plant(plant("../mods/x.so")));
}

TEST_F(Packing, Files_of_the_board_itself_do_not_travel) {
  const auto sut = pack_plant(plant("/usr/bin/env"));
  ASSERT_TRUE(sut) << sut.error().text;
  EXPECT_EQ(sut->package.files.size(), 1U);
}

TEST_F(Packing, A_module_named_without_ending_travels_as_its_file_or_is_of_the_installation) {
  put("cell/libx.so", "module");
  config::Plant with = plant("x");
  with.boards[0].config.modules[0].file = folder_ / "cell/libx.so";
  const auto packed = pack_plant(with);
  ASSERT_TRUE(packed) << packed.error().text;
  ASSERT_EQ(packed->package.files.size(), 2U);
  EXPECT_EQ(packed->package.files[0].path, "libx.so");
  with.boards[0].config.modules[0].file = "/usr/local/lib/libx.so";
  EXPECT_EQ(pack_plant(with)->package.files.size(), 1U);
}

TEST_F(Packing, The_files_of_an_io_module_travel_too) {
  put("cell/io.xml",
      "<ioconfig><device name='a' driver='csv' file='../mods/values.csv'><input variable='x'/></device>"
      "<device name='b' driver='csv' file='/etc/own.csv'><input variable='y'/></device></ioconfig>");
  put("mods/values.csv", "time,x\n0,1\n");
  config::Plant with = plant("/usr/local/lib/libiodispat.so");
  config::Module& module = with.boards[0].config.modules[0];
  module.file = module.file_as_written;
  module.properties = {{"config", "io.xml"}};
  const auto sut = pack_plant(with, {folder_});
  ASSERT_TRUE(sut) << sut.error().text;
  ASSERT_EQ(sut->package.files.size(), 3U);
  EXPECT_EQ(sut->package.files[0].path, "cell/io.xml");
  EXPECT_EQ(sut->package.files[2].path, "mods/values.csv");
  module.properties = {{"config", "/etc/io.xml"}};
  EXPECT_EQ(pack_plant(with, {folder_})->package.files.size(), 1U) << "the board's own";
  module.properties = {{"config", "gone.xml"}};
  EXPECT_THAT(pack_plant(with, {folder_}).error().text, HasSubstr("gone.xml"));
}

TEST_F(Packing, Files_that_properties_name_travel_too) {
  put("cell/pick.job", "MOVJ P1\n");
  put("mods/arm.urdf", "<robot/>");
  config::Plant with = plant("../mods/x.so");
  with.boards[0].config.modules[0].properties = {
      {"jobs", "pick.job  gone.job"}, {"urdf", "../mods/arm.urdf"}, {"own", "/etc/hostname"}, {"folder", "../mods"}};
  const auto sut = pack_plant(with, {folder_});
  ASSERT_TRUE(sut) << sut.error().text;
  std::vector<std::string> paths;
  for (const PackageFile& file : sut->package.files) {
    paths.push_back(file.path);
  }
  EXPECT_THAT(paths, ElementsAre("cell/pick.job", "cell/plant.xml", "mods/arm.urdf", "mods/x.so"));
}

TEST_F(Packing, Each_board_s_libraries_of_types_travel) {
  put("cell/amd64.so", "types");
  put("cell/arm64.so", "types of another processor");
  config::Plant with = plant("../mods/x.so");
  with.boards.push_back(with.boards[0]);
  with.boards[0].types.types_as_written = {"amd64.so"};
  with.boards[1].types.types_as_written = {"arm64.so"};
  const auto sut = pack_plant(with, {folder_});
  ASSERT_TRUE(sut) << sut.error().text;
  std::vector<std::string> paths;
  for (const PackageFile& file : sut->package.files) {
    paths.push_back(file.path);
  }
  EXPECT_THAT(paths, ElementsAre("cell/amd64.so", "cell/arm64.so", "cell/plant.xml", "mods/x.so"));
}

TEST_F(Packing, A_file_that_cannot_be_read_is_named) {
  EXPECT_THAT(pack_plant(plant("gone.so")).error().text, HasSubstr("gone.so"));
}

}  // namespace
}  // namespace indurop::deploy
