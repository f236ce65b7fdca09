// SPDX-License-Identifier: Apache-2.0
// One bit that the disk has changed, in any file an agent keeps: what would be run is compared byte by byte with what
// was deployed, whatever the digests say.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "core/keys/digest.h"
#include "deploy/agent/agent_state.h"
#include "deploy/disk/state_check.h"

namespace indurop::deploy {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

using Content = std::map<std::string, std::string>;  // by path

std::string read_all(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void write_all(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary | std::ios::trunc) << text;
}

class AgentDamage : public testing::Test {
 protected:
  AgentDamage() : root_(fs::temp_directory_path() / ("indurop-agent-damage-" + std::to_string(::getpid()))) {
    fs::remove_all(root_);
    ::setenv("INDUROP_STATE_DIR", root_.c_str(), 1);
    open();
  }
  ~AgentDamage() override {
    ::unsetenv("INDUROP_STATE_DIR");
    fs::remove_all(root_);
  }
  void open() {
    state_.reset();
    lines_.clear();
    auto opened = AgentState::open("a", [this](const std::string& line) { lines_.push_back(line); });
    ASSERT_TRUE(opened) << opened.error().text;
    state_.emplace(std::move(*opened));
  }
  std::string random_text(std::size_t size) {
    std::string text(size, '\0');
    for (char& byte : text) {
      byte = static_cast<char>(random_());
    }
    return text;
  }
  // As it lies there when it was fetched, and is committed.
  std::string deploy(const Content& content) {
    Package package;
    package.plant = "cell";
    package.manifest = "plant.xml";
    package.boards = {"a"};
    for (const auto& [path, bytes] : content) {
      package.files.push_back({path, keys::digest_of(bytes), bytes.size(), path.ends_with(".exe")});
      blobs_[package.files.back().digest] = bytes;
    }
    const std::string text = to_text(package);
    const std::string id = keys::digest_of(text);
    blobs_[id] = text;
    fetch(id);
    EXPECT_TRUE(state_->install(id));
    contents_[id] = content;
    Committed next = state_->committed();
    next.previous = next.current;
    next.current = id;
    next.current_size = text.size();
    next.plant = "cell";
    next.members = {"a"};
    next.history.push_back({id, "cell", ++next.generation, "desk", 1, "committed", {}});
    EXPECT_TRUE(state_->commit(std::move(next)));
    return id;
  }
  // What another board would send: everything that is not here as it should be.
  void fetch(const std::string& id) {
    if (!state_->has_sound(id, "the package")) {
      bring(id);
    }
    const auto package = state_->package(id);
    ASSERT_TRUE(package);
    for (const PackageFile& file : package->files) {
      if (!state_->has_sound(file.digest, file.path)) {
        bring(file.digest);
      }
    }
  }
  void bring(const std::string& digest) {
    write_all(state_->part(digest), blobs_.at(digest));
    ASSERT_TRUE(state_->keep(digest));
  }
  // A file and a bit of it are changed. `which`: those to choose from.
  fs::path flip_a_bit(std::vector<fs::path> which) {
    const fs::path file = which[random_() % which.size()];
    std::string bytes = read_all(file);
    const std::size_t bit = random_() % (bytes.size() * 8);
    bytes[bit / 8] = static_cast<char>(bytes[bit / 8] ^ (1 << (bit % 8)));
    write_all(file, bytes);
    return file;
  }
  std::vector<fs::path> all_files() const {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(state_->folder())) {
      if (entry.is_regular_file() && entry.file_size() > 0) {
        files.push_back(entry.path());
      }
    }
    std::sort(files.begin(), files.end());
    return files;
  }
  // Would exactly what was deployed be run?
  testing::AssertionResult is_laid_out(const std::string& id) const {
    const fs::path folder = state_->manifest(id).parent_path();
    for (const auto& [path, bytes] : contents_.at(id)) {
      struct stat about {};
      if (read_all(folder / path) != bytes || ::stat((folder / path).c_str(), &about) != 0) {
        return testing::AssertionFailure() << path << " is not what was deployed";
      }
      if (about.st_nlink != 1 || ((about.st_mode & S_IXUSR) != 0) != path.ends_with(".exe")) {
        return testing::AssertionFailure() << path << " has a second name or another mode";
      }
    }
    return testing::AssertionSuccess();
  }
  StateReport verified() const {
    StateCheck check(state_->folder());
    while (!check.step()) {
    }
    return check.report();
  }
  bool has_printed(const std::string& part) const {
    return std::any_of(lines_.begin(), lines_.end(),
                       [&](const std::string& line) { return line.find(part) != std::string::npos; });
  }
  Content version(const std::string& mark) {
    return {{"plant.xml", "<plant name='cell'/>" + mark},
            {"mods/main.so", random_text(3000)},
            {"mods/twin.so", "the same in both versions"},
            {"mods/tool.exe", random_text(500)},
            {"empty.txt", ""}};
  }

  std::mt19937 random_{1};
  fs::path root_;
  std::optional<AgentState> state_;
  std::vector<std::string> lines_;
  std::map<std::string, std::string> blobs_;  // by digest, as they were sent
  std::map<std::string, Content> contents_;   // by id
};

TEST_F(AgentDamage, A_changed_bit_is_never_run_never_called_committed_and_repaired_by_what_others_have) {
  const std::string first = deploy(version("1"));
  const std::string second = deploy(version("2"));
  constexpr int kFlips = 300;
  int refused = 0;
  for (int i = 0; i < kFlips; ++i) {
    const fs::path file = flip_a_bit(all_files());
    SCOPED_TRACE(fmt::format("{} {}", i, file.string()));
    const bool of_deployments = file.string().find("committed.json") == std::string::npos;
    const StateReport found = verified();
    EXPECT_EQ(found.damaged.size(), 1U);
    EXPECT_TRUE(found.damaged.empty() || found.damaged[0].file == file);
    open();  // the board resumes
    if (!of_deployments) {
      // What it had committed is what it says, or it has nothing committed.
      EXPECT_TRUE(state_->committed().current.empty());
      EXPECT_TRUE(has_printed("committed.json is damaged"));
      Committed again;
      again.generation = 2;
      again.plant = "cell";
      again.members = {"a"};
      again.current = second;
      again.previous = first;
      ASSERT_TRUE(state_->commit(again));
      fs::remove(state_->folder() / "committed.json.damaged");
    }
    for (const std::string& id : {second, first}) {  // resume, and roll back
      if (const auto repaired = state_->repair(id); !repaired) {
        ++refused;
        EXPECT_THAT(repaired.error().text, HasSubstr("SHA-256"));
        EXPECT_THAT(repaired.error().text, testing::AnyOf(HasSubstr(id), HasSubstr(file.filename().string())));
        fetch(id);
        ASSERT_TRUE(state_->repair(id));
      }
      EXPECT_TRUE(is_laid_out(id));
    }
    EXPECT_TRUE(verified().damaged.empty());
  }
  EXPECT_GT(refused, 0) << "a package has no second copy on the board";
}

// The folder of releases has the same form.
TEST_F(AgentDamage, Of_a_release_of_the_platform_is_found_as_that_of_a_deployment) {
  const std::string id = deploy(version("1"));
  const fs::path platform = platform_folder(state_->folder());
  fs::copy(state_->folder(), root_ / "copy", fs::copy_options::recursive);
  fs::rename(root_ / "copy", platform);
  const StateReport sound = verified();
  EXPECT_TRUE(sound.damaged.empty());
  EXPECT_EQ(sound.deployments, std::vector{id});
  EXPECT_EQ(sound.releases, std::vector{id});
  std::vector<fs::path> of_platform = all_files();
  std::erase_if(of_platform, [&](const fs::path& file) { return !file.string().starts_with(platform.string()); });
  ASSERT_EQ(of_platform.size() * 2, all_files().size());
  const fs::path file = flip_a_bit(of_platform);
  ASSERT_EQ(verified().damaged.size(), 1U);
  EXPECT_EQ(verified().damaged[0].file, file);
}

// After the first update, the board ran the installed release before; after `platform back`, it runs that one.
TEST_F(AgentDamage, Of_the_installed_release_no_files_are_missing) {
  deploy(version("1"));
  const auto ignore = [](const std::string& /*line*/) {};
  auto platform = AgentState::open_platform("a", ignore);
  ASSERT_TRUE(platform) << platform.error().text;
  Committed committed;
  committed.generation = 1;
  committed.plant = "cell";
  committed.members = {"a"};
  committed.current = kInstalledRelease;
  committed.previous = kInstalledRelease;
  ASSERT_TRUE(platform->commit(committed));
  const StateReport found = verified();
  EXPECT_TRUE(found.damaged.empty()) << describe(found.damaged.front());
  EXPECT_TRUE(found.releases.empty());
}

TEST_F(AgentDamage, In_both_copies_is_refused_with_file_and_digest_until_it_is_fetched_again) {
  const std::string id = deploy(version("1"));
  const std::string digest = keys::digest_of(contents_[id]["mods/main.so"]);
  flip_a_bit({state_->file(digest)});
  flip_a_bit({state_->manifest(id).parent_path() / "mods/main.so"});
  EXPECT_EQ(verified().damaged.size(), 2U);
  const auto refused = state_->repair(id);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().text, HasSubstr("mods/main.so"));
  EXPECT_THAT(refused.error().text, HasSubstr(digest));
  EXPECT_FALSE(state_->has(digest)) << "what does not hold is dropped";
  EXPECT_FALSE(state_->install(id));
  fetch(id);
  EXPECT_TRUE(state_->install(id));
  EXPECT_TRUE(is_laid_out(id));
}

TEST_F(AgentDamage, Copies_of_an_older_release_that_share_their_bytes_are_separated) {
  const std::string id = deploy(version("1"));
  const fs::path copy = state_->manifest(id).parent_path() / "mods/main.so";
  fs::remove(copy);
  fs::create_hard_link(state_->file(keys::digest_of(contents_[id]["mods/main.so"])), copy);
  ASSERT_TRUE(state_->install(id));
  EXPECT_TRUE(is_laid_out(id));
}

TEST_F(AgentDamage, A_damaged_package_of_what_runs_costs_none_of_its_files) {
  const std::string id = deploy(version("1"));
  flip_a_bit({state_->file(id)});
  state_->collect_garbage();
  for (const auto& [path, bytes] : contents_[id]) {
    EXPECT_TRUE(state_->has(keys::digest_of(bytes))) << path;
  }
  EXPECT_TRUE(fs::exists(state_->files().deployment(id) / "mods/main.so"));
}

TEST_F(AgentDamage, A_damaged_earlier_package_costs_none_of_its_files) {
  const std::string before = deploy(version("1"));
  deploy(version("2"));
  flip_a_bit({state_->file(before)});
  state_->collect_garbage();
  EXPECT_FALSE(state_->has_sound(before, "the package"));  // it is dropped
  state_->collect_garbage();
  for (const auto& [path, bytes] : contents_[before]) {
    EXPECT_TRUE(state_->has(keys::digest_of(bytes))) << path;
  }
  bring(before);
  EXPECT_TRUE(state_->repair(before));
  EXPECT_TRUE(is_laid_out(before));
}

TEST_F(AgentDamage, The_state_is_closed_to_other_users) {
  struct stat about {};
  ASSERT_EQ(::stat(state_->folder().c_str(), &about), 0);
  EXPECT_EQ(about.st_mode & 07777, 0750U);
}

TEST_F(AgentDamage, A_file_of_committed_json_without_digest_is_of_an_older_release) {
  deploy(version("1"));
  std::string text = read_all(state_->folder() / kCommittedFile);
  text.replace(text.find("\"indurop_state\": 2"), 18, "\"indurop_state\": 1");
  EXPECT_TRUE(read_committed(text));
}

}  // namespace
}  // namespace indurop::deploy
