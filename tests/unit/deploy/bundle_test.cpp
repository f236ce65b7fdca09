// SPDX-License-Identifier: Apache-2.0
// A plant as one file: packed, read back, by a foreign program too, and refused wherever it was changed.
#include "deploy/bundle/bundle.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include "core/keys/credentials.h"
#include "core/keys/digest.h"
#include "core/keys/plant_keys.h"
#include "gnu_tar.h"

namespace indurop::deploy {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::string bytes_of_file(const fs::path& file) {
  std::ifstream from(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(from), {}};
}

class Bundle : public testing::Test {
 protected:
  Bundle() {
    std::string name = (fs::temp_directory_path() / "indurop-bundle-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
    add("cell/plant.xml", "<plant/>", false);
    add("cell/mods/control.so", std::string(700'000, '\1') + "end", true);
    add("cell/mods/copy.so", std::string(700'000, '\1') + "end", true);
    packed_.package.plant = "cell";
    packed_.package.manifest = "cell/plant.xml";
    packed_.package.boards = {"a"};
    packed_.text = to_text(packed_.package);
    packed_.id = keys::digest_of(packed_.text);
  }
  ~Bundle() override { fs::remove_all(folder_); }

  void add(const std::string& path, const std::string& content, bool executable) {
    const fs::path source = folder_ / ("source" + std::to_string(packed_.package.files.size()));
    std::ofstream(source, std::ios::binary) << content;
    packed_.package.files.push_back({path, keys::digest_of(content), content.size(), executable});
    packed_.sources.emplace(packed_.package.files.back().digest, source);
  }
  std::string write(const BundleSignature& signature = {}) {
    const auto written = write_bundle(packed_, signature, file());
    return written ? "" : written.error().text;
  }
  // Opens the bundle in a new folder.
  Result<OpenedBundle, base::Problem> open() {
    out_ = folder_ / ("out" + std::to_string(++opened_));
    fs::create_directory(out_);
    return open_bundle(file(), out_);
  }
  std::string problem() {
    const auto sut = open();
    return sut ? "" : sut.error().text;
  }
  [[nodiscard]] fs::path file() const { return folder_ / "cell.bundle"; }

  fs::path folder_;
  fs::path out_;
  PackedPlant packed_;
  int opened_ = 0;
};

TEST_F(Bundle, Is_unpacked_as_it_was_packed) {
  ASSERT_EQ(write(), "");
  EXPECT_TRUE(is_bundle(file()));
  const auto sut = open();
  ASSERT_TRUE(sut) << sut.error().text;
  EXPECT_EQ(sut->packed.id, packed_.id);
  EXPECT_EQ(sut->manifest, out_ / "cell/plant.xml");
  for (const PackageFile& one : packed_.package.files) {
    EXPECT_EQ(bytes_of_file(out_ / one.path), bytes_of_file(packed_.sources.at(one.digest))) << one.path;
    EXPECT_EQ(::access((out_ / one.path).c_str(), X_OK) == 0, one.executable) << one.path;
    EXPECT_TRUE(sut->packed.sources.contains(one.digest));
  }
}

TEST_F(Bundle, Is_the_same_file_each_time_and_readable_by_tar) {
  if (!has_gnu_tar()) {
    GTEST_SKIP() << "there is no GNU tar";
  }
  ASSERT_EQ(write(), "");
  const std::string first = bytes_of_file(file());
  ASSERT_EQ(write(), "");
  EXPECT_EQ(bytes_of_file(file()), first);
  EXPECT_LT(first.size(), 10'000U);
  const std::string to = (folder_ / "names").string();
  ASSERT_EQ(std::system(("tar --zstd -tf " + file().string() + " > " + to).c_str()), 0);
  EXPECT_THAT(bytes_of_file(to), testing::StartsWith("package.json\nsignature.json\nfiles/"));
}

TEST_F(Bundle, Changed_by_one_byte_is_refused_or_means_the_same) {
  ASSERT_EQ(write({"certificate", "signature"}), "");
  const std::string good = bytes_of_file(file());
  int refused = 0;
  for (std::size_t at = 0; at < good.size(); at += 7) {
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] ^ 0x10);
    std::ofstream(file(), std::ios::binary | std::ios::trunc) << bad;
    const auto sut = open();
    if (!sut) {
      ++refused;
      EXPECT_THAT(sut.error().text, HasSubstr("cell.bundle: ")) << at;
    } else {
      EXPECT_EQ(sut->packed.id, packed_.id) << at;
      EXPECT_EQ(sut->packed.sources.size(), packed_.sources.size()) << at;
    }
  }
  EXPECT_GT(refused, 20);
}

TEST_F(Bundle, Cut_anywhere_is_refused) {
  ASSERT_EQ(write(), "");
  const std::string good = bytes_of_file(file());
  std::ofstream(file(), std::ios::trunc) << good.substr(0, good.size() / 2);
  EXPECT_NE(problem(), "");
  std::ofstream(file(), std::ios::trunc) << "PK\3\4 something else";
  EXPECT_FALSE(is_bundle(file()));
  EXPECT_THAT(problem(), HasSubstr("not a bundle made by indurop pack"));
}

// Made by tar: what write_bundle() never writes.
TEST_F(Bundle, Members_that_the_package_does_not_list_are_refused) {
  if (!has_gnu_tar()) {
    GTEST_SKIP() << "there is no GNU tar";
  }
  ASSERT_EQ(write(), "");
  const std::string script = "cd " + folder_.string() +
                             " && mkdir m && tar --zstd -xf cell.bundle -C m && cd m && echo x > ../escaped && "
                             "tar --zstd -P -cf ../cell.bundle package.json signature.json ";
  ASSERT_EQ(std::system((script + "../escaped files/* 2>/dev/null").c_str()), 0);
  EXPECT_THAT(problem(), HasSubstr("is damaged"));
  ASSERT_EQ(
      std::system(("rm -r " + (folder_ / "m").string() + "; cp " + file().string() + " " + (folder_ / "kept").string())
                      .c_str()),
      0);
  ASSERT_EQ(write(), "");
  ASSERT_EQ(std::system((script + " 2>/dev/null").c_str()), 0);
  EXPECT_THAT(problem(), HasSubstr("ends before cell/"));
}

TEST_F(Bundle, A_file_that_changes_while_it_is_packed_leaves_no_bundle) {
  std::ofstream(packed_.sources.begin()->second, std::ios::trunc) << "other";
  EXPECT_THAT(write(), HasSubstr("has changed while it was packed"));
  EXPECT_FALSE(fs::exists(file()));
  EXPECT_FALSE(fs::exists(file().string() + ".part"));
}

TEST_F(Bundle, Does_not_replace_what_it_was_packed_from) {
  const fs::path source = packed_.sources.begin()->second;
  const std::string before = bytes_of_file(source);
  EXPECT_THAT(write_bundle(packed_, {}, source).error().text, HasSubstr("is a file of the plant and would be lost"));
  EXPECT_EQ(bytes_of_file(source), before);
  EXPECT_THAT(write_bundle(packed_, {}, folder_).error().text, HasSubstr("it is not a regular file"));
  EXPECT_THAT(write_bundle(packed_, {}, "/dev/null").error().text, HasSubstr("it is not a regular file"));
}

TEST_F(Bundle, Is_known_before_it_is_finished) {
  if (!has_gnu_tar()) {
    GTEST_SKIP() << "there is no GNU tar";
  }
  ASSERT_EQ(write(), "");
  EXPECT_TRUE(is_packed_plant(file()));
  const std::string good = bytes_of_file(file());
  std::ofstream(file(), std::ios::trunc) << good.substr(0, good.size() - 10);
  EXPECT_TRUE(is_packed_plant(file()));
  ASSERT_EQ(std::system(("cd " + folder_.string() + " && tar --zstd -cf cell.bundle source0").c_str()), 0);
  EXPECT_FALSE(is_packed_plant(file()));
}

class SignedBundle : public Bundle {
 protected:
  SignedBundle() {
    const auto until = keys::Instant(std::chrono::sys_days(std::chrono::year(2040) / 1 / 1));
    EXPECT_TRUE(plant_.make("cell", {"a"}, until));
    EXPECT_TRUE(other_.make("cell", {"a"}, until));
  }
  [[nodiscard]] std::string refusal(const BundleSignature& signature, const keys::PlantKeys& of) const {
    const keys::ParticipantKeys own(of.deployer());
    return bundle_refusal(signature, packed_.text, bytes_of_file(own.authority), bytes_of_file(own.revoked));
  }
  BundleSignature sign(const fs::path& keys) {
    auto made = sign_package(packed_.text, keys);
    EXPECT_TRUE(made) << made.error().text;
    return made ? *made : BundleSignature{};
  }
  keys::PlantKeys plant_{folder_ / "keys"};
  keys::PlantKeys other_{folder_ / "other"};
};

TEST_F(SignedBundle, Counts_if_a_deployer_of_the_plant_signed_it) {
  const BundleSignature good = sign(plant_.folder());
  EXPECT_EQ(refusal(good, plant_), "");
  EXPECT_THAT(refusal(good, other_), HasSubstr("another authority"));
  EXPECT_THAT(refusal({}, plant_), HasSubstr("not signed"));
  EXPECT_THAT(refusal(sign(plant_.board("a")), plant_), HasSubstr("not a deployer"));
  BundleSignature wrong = good;
  wrong.signature[10] = wrong.signature[10] == '0' ? '1' : '0';
  EXPECT_THAT(refusal(wrong, plant_), HasSubstr("does not fit"));
  for (const keys::KeyListing& one : plant_.list(keys::instant_now())) {
    if (one.role == keys::Role::Deployer) {
      ASSERT_TRUE(plant_.revoke(one));
    }
  }
  EXPECT_THAT(refusal(good, plant_), HasSubstr("revoked"));
}

}  // namespace
}  // namespace indurop::deploy
