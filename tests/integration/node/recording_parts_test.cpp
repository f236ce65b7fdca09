// SPDX-License-Identifier: Apache-2.0
// Recordings without end: in parts, within bounds of the disk, on a full one, and of a recorder that is killed.

#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <thread>

#include "node_fixture.h"
#include "tests/support/wait_until.h"

namespace indurop::test {
namespace {

namespace fs = std::filesystem;

class RecordingParts : public NodeTest {
 protected:
  const std::vector<Module> kPartsCounter = {{.file = "counter.so", .name = "counter", .priority = 1}};

  std::vector<fs::path> parts(const fs::path& in) const {
    std::vector<fs::path> all;
    for (const auto& entry : fs::directory_iterator(in)) {
      if (entry.path().extension() == ".mcap") {
        all.push_back(entry.path());
      }
    }
    std::sort(all.begin(), all.end());
    return all;
  }
  std::vector<std::string> command(const std::vector<std::string>& more) const {
    std::vector<std::string> words = {INDUROP_PROGRAM, "record", "--node", node()};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  // That a reader finds in a file, closed or not; 0 if it is no recording yet (then there is an error to read).
  std::uint64_t runs_in(const fs::path& file) const {
    const Outcome info = indurop({"recording", "info", file.string(), "-o", "json"});
    const auto found = nlohmann::json::parse(info.out, nullptr, false);
    return found.contains("modules") && !found["modules"].empty() ? found["modules"][0]["runs"].get<std::uint64_t>()
                                                                  : 0;
  }
  Outcome replay(const fs::path& file) const { return indurop({"replay", file.string(), "--node", node() + "-r"}); }
};

TEST_F(RecordingParts, Old_ones_go_and_each_can_be_replayed) {
  Program& sut = start_and_wait(kPartsCounter);
  ASSERT_TRUE(runs_reach("counter", 20));
  const fs::path base = folder() / "last.mcap";
  const Outcome kept =
      indurop({"record", "-o", base.string(), "--split", "200ms", "--keep", "500ms", "--duration", "2s"});
  EXPECT_EQ(kept.code, 0) << kept.err;
  EXPECT_CONTAINS(kept.err, " older parts were removed");
  const auto left = parts(folder());
  EXPECT_GE(left.size(), 3U);
  EXPECT_LE(left.size(), 6U) << kept.err;
  EXPECT_FALSE(fs::exists(folder() / "last.0001.mcap"));
  EXPECT_FALSE(fs::exists(base));
  for (const fs::path& part : left) {
    const Outcome again = replay(part);
    EXPECT_EQ(again.code, 0) << part << again.out << again.err;
    EXPECT_CONTAINS(again.out, " values: equal");
  }
  const Outcome twice = indurop({"record", "-o", base.string(), "--keep", "1h"});
  EXPECT_EQ(twice.code, 1);
  EXPECT_CONTAINS(twice.err, "a part of another recording");
  EXPECT_EQ(indurop({"record", "-o", base.string(), "--keep", "much"}).code, 2);
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0);
}

// Beginnings of a part say what was known before: a run's inputs that did not change are there as well.
TEST_F(RecordingParts, Begin_with_what_was_known) {
  Program& sut = start_and_wait(kPartsCounter);
  const Outcome kept =
      indurop({"record", "-o", (folder() / "run.mcap").string(), "--split", "300ms", "--duration", "1s"});
  EXPECT_EQ(kept.code, 0) << kept.err;
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0);
  EXPECT_TRUE(fs::exists(folder() / "run.0001.mcap"));
  const Outcome second = replay(folder() / "run.0002.mcap");
  EXPECT_EQ(second.code, 0) << second.out << second.err;
}

// However old what was known then: of a module that waits for its event, what it left at its start.
TEST_F(RecordingParts, Begin_when_they_were_begun) {
  Program& sut = start_and_wait({{.file = "counter.so", .name = "counter", .priority = 1},
                                 {.file = "event.so", .name = "event", .operation = "sporadic", .priority = 2}});
  ASSERT_TRUE(runs_reach("counter", 1000));
  const std::int64_t now = rt::wall_ns();
  ASSERT_EQ(indurop({"record", "-o", (folder() / "run.mcap").string(), "--split", "300ms", "--duration", "700ms"}).code,
            0);
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0);
  std::int64_t end = now;
  for (const char* part : {"run.0001.mcap", "run.0002.mcap"}) {
    const auto info = indurop({"recording", "info", (folder() / part).string(), "-o", "json"}).json();
    EXPECT_GE(info["begin_ns"].get<std::int64_t>(), end - 10'000'000) << part;
    end = info["end_ns"].get<std::int64_t>();
    const Outcome again = replay(folder() / part);
    EXPECT_EQ(again.code, 0) << again.out << again.err;
    EXPECT_CONTAINS(again.out, " values: equal");
  }
}

TEST_F(RecordingParts, Are_put_together_again) {
  Program& sut = start_and_wait(kPartsCounter);
  for (const char* name : {"run.mcap", "other.mcap"}) {
    ASSERT_EQ(indurop({"record", "-o", (folder() / name).string(), "--split", "300ms", "--duration", "1s"}).code, 0);
  }
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0);
  const auto runs_of = [&](const std::string& file) {
    return indurop({"recording", "info", (folder() / file).string(), "-o", "json"}).json()["modules"][0]["runs"];
  };
  const auto join = [&](const std::vector<std::string>& files, const std::string& to) {
    std::vector<std::string> words = {"recording", "join", "-o", (folder() / to).string()};
    for (const std::string& file : files) {
      words.push_back((folder() / file).string());
    }
    return indurop(words);
  };
  const Outcome joined = join({"run.0003.mcap", "run.0001.mcap", "run.0002.mcap"}, "all.mcap");
  ASSERT_EQ(joined.code, 0) << joined.err;
  std::uint64_t runs = 0;
  for (const char* part : {"run.0001.mcap", "run.0002.mcap", "run.0003.mcap"}) {
    runs += runs_of(part).get<std::uint64_t>();
  }
  EXPECT_EQ(runs_of("all.mcap"), runs);
  const Outcome again = replay(folder() / "all.mcap");
  EXPECT_EQ(again.code, 0) << again.out << again.err;
  EXPECT_CONTAINS(again.out, ", " + std::to_string(runs) + " runs, ");
  EXPECT_FALSE(contains(joined.err, "missing")) << joined.err;

  // What ran in a part that is gone, or while a recorder could not follow, does not count as a suspended machine.
  const Outcome holed = join({"run.0001.mcap", "run.0003.mcap"}, "holed.mcap");
  ASSERT_EQ(holed.code, 0) << holed.err;
  EXPECT_CONTAINS(holed.err, "1 part is missing between ");
  const auto explained_of = [&](const char* file, const std::vector<std::string>& more) {
    std::vector<std::string> words = {"explain", "counter", "--from", (folder() / file).string()};
    words.insert(words.end(), more.begin(), more.end());
    return indurop(words).out;
  };
  const auto second = indurop({"recording", "info", (folder() / "run.0002.mcap").string(), "-o", "json"}).json();
  const std::uint64_t inside = second["modules"][0]["first_tick"].get<std::uint64_t>() + 100;
  const std::string of_hole = explained_of("holed.mcap", {"--tick", std::to_string(inside)});
  EXPECT_CONTAINS(of_hole, "the recording lacks ");
  EXPECT_CONTAINS(of_hole, " runs of counter between the ticks ");
  EXPECT_FALSE(contains(explained_of("all.mcap", {"--tick", std::to_string(inside)}), "lacks"));

  EXPECT_CONTAINS(join({"run.0001.mcap", "run.0001.mcap"}, "x.mcap").err,
                  "join one of each, or parts of one recording");
  EXPECT_CONTAINS(join({"run.0001.mcap", "other.0002.mcap"}, "x.mcap").err, "join one of each");
  EXPECT_FALSE(fs::exists(folder() / "x.mcap"));
  const Outcome explained = indurop({"explain", "counter", "--from", (folder() / "run.0001.mcap").string(), "--from",
                                     (folder() / "run.0002.mcap").string()});
  EXPECT_EQ(explained.code, 2);
  EXPECT_CONTAINS(explained.err, "put parts of one together first: indurop recording join");
  ASSERT_EQ(run_to_end(kPartsCounter, {"--sim", "--until", "100ms", "--record", (folder() / "sim.mcap").string()}).code,
            0);
  EXPECT_CONTAINS(join({"run.0001.mcap", "sim.mcap"}, "x.mcap").err, "they have no common time");
}

TEST_F(RecordingParts, Of_two_simulations_are_not_put_together) {
  std::vector<std::string> words = {"recording", "join", "-o", (folder() / "x.mcap").string()};
  for (const char* name : {"first", "second"}) {
    words.push_back((folder() / (std::string(name) + ".mcap")).string());
    ASSERT_EQ(indurop({"run", write("two.xml", xml(kPartsCounter)), "--sim", "-q", "--until", "100ms", "--node",
                       node() + "-" + name, "--record", words.back()})
                  .code,
              0);
  }
  const Outcome joined = indurop(words);
  EXPECT_EQ(joined.code, 1);
  EXPECT_CONTAINS(joined.err, "two simulations, not boards of one plant");
  EXPECT_FALSE(fs::exists(folder() / "x.mcap"));
}

TEST_F(RecordingParts, Of_a_killed_recorder_are_readable) {
  Program& sut = start_and_wait(kPartsCounter);
  for (int i = 0; i < 5; ++i) {
    const fs::path file = folder() / ("killed" + std::to_string(i) + ".mcap");
    Program recorder(command({"-o", file.string()}), environment());
    // At another moment each time: while the file begins, after the first chunk, in the middle of one.
    const std::uint64_t runs = static_cast<std::uint64_t>(i) * 400;
    ASSERT_TRUE(wait_until([&] { return fs::exists(file) && (i == 0 || runs_in(file) >= runs); })) << recorder.err();
    recorder.kill();
    recorder.wait();
    const std::uint64_t kept = runs_in(file);
    const Outcome again = replay(file);
    if (kept == 0) {
      EXPECT_EQ(i, 0);
      EXPECT_EQ(again.code, 1) << again.out << again.err;
      // It was killed while the file began: before its first bytes, its description, or its first chunk.
      EXPECT_THAT(again.err, testing::AnyOf(testing::HasSubstr("not a recording"), testing::HasSubstr("has no runs"),
                                            testing::HasSubstr("before it had written the first runs")));
      continue;
    }
    EXPECT_EQ(again.code, 0) << again.out << again.err;
    EXPECT_CONTAINS(again.err, "the recording was not closed");
    EXPECT_CONTAINS(again.out, ", " + std::to_string(kept) + " runs, ");
    EXPECT_CONTAINS(again.out, " values: equal");
  }
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0) << "the node did not notice";
}

// As one whose disk does not answer.
TEST_F(RecordingParts, A_recorder_that_is_stopped_reports_what_it_lost_and_disturbs_no_module) {
  Program& sut = start_and_wait(kPartsCounter, {"--tape", "1"});
  ASSERT_TRUE(runs_reach("counter", 20));
  const std::string file = (folder() / "slow.mcap").string();
  Program recorder(command({"-o", file}), environment());
  ASSERT_TRUE(wait_until([&] {
    std::error_code ignored;
    return fs::exists(file, ignored) && fs::file_size(file, ignored) > 10'000;
  }));
  recorder.signal(SIGSTOP);
  const std::uint64_t runs = module("counter").runs.load();
  ASSERT_TRUE(runs_reach("counter", runs + 5000)) << "the node does not wait";
  recorder.signal(SIGCONT);
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0);
  const Outcome slow = recorder.finish();
  EXPECT_EQ(slow.code, 1) << slow.err;
  EXPECT_CONTAINS(slow.err, " runs of counter are not in the recording: they were overwritten before they were read");
  const auto info = nlohmann::json::parse(indurop({"recording", "info", file, "-o", "json"}).out);
  const auto lost = info["modules"][0]["lost_runs"].get<std::uint64_t>();
  EXPECT_GT(lost, 0U);
  EXPECT_CONTAINS(slow.err, std::to_string(lost) + " runs of counter") << "the numbers of the runs in the file say so";
}

// Each part is full when its runs were taken, the last one, too.
TEST_F(RecordingParts, None_is_left_without_runs) {
  Program& sut = start_and_wait(kPartsCounter);
  ASSERT_TRUE(runs_reach("counter", 20));
  const fs::path base = folder() / "full.mcap";
  const Outcome recorded = indurop({"record", "-o", base.string(), "--split", "1ms", "--duration", "500ms"});
  EXPECT_EQ(recorded.code, 0) << recorded.err;
  for (const fs::path& part : parts(folder())) {
    EXPECT_GT(runs_in(part), 0U) << part;
  }
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0);
}

TEST_F(RecordingParts, Two_recorders_have_the_same) {
  Program& sut = start_and_wait(kPartsCounter);
  const std::string first = (folder() / "first.mcap").string();
  const std::string second = (folder() / "second.mcap").string();
  Program one(command({"-o", first, "--past"}), environment());
  Program two(command({"-o", second, "--past"}), environment());
  ASSERT_TRUE(wait_until([&] { return fs::exists(first) && fs::exists(second); }));
  ASSERT_TRUE(runs_reach("counter", module("counter").runs.load() + 500));
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0);
  EXPECT_EQ(one.wait(), 0) << one.err();
  EXPECT_EQ(two.wait(), 0) << two.err();
  // They began at two moments: the end is the same.
  const auto last_values = [&](const std::string& file) {
    const std::string csv = file + ".csv";
    EXPECT_EQ(indurop({"recording", "export", file, "nt::counted", "--csv", csv}).code, 0);
    std::ifstream in(csv);
    std::vector<std::string> values;
    for (std::string line; std::getline(in, line);) {
      values.push_back(line.substr(line.rfind(',') + 1));
    }
    values.erase(values.begin(), values.end() - std::min<std::ptrdiff_t>(400, std::ssize(values)));
    return values;
  };
  const std::vector<std::string> values = last_values(first);
  EXPECT_EQ(values.size(), 400U);
  EXPECT_EQ(values, last_values(second));
}

TEST_F(RecordingParts, A_full_disk_ends_the_recording_and_disturbs_no_module) {
  Program& sut = start_and_wait(kPartsCounter);
  const fs::path disk = folder() / "disk";
  fs::create_directory(disk);
  Environment small = environment();
  const std::string copy = (folder() / "copy.mcap").string();
  small.prepare = [&] { return mount_small(disk.string(), "200k"); };
  Program recorder({"/bin/sh", "-c",
                    std::string(INDUROP_PROGRAM) + " record --node " + node() + " -o " + (disk / "run.mcap").string() +
                        "; code=$?; cp " + (disk / "run.mcap").string() + " " + copy + "; exit $code"},
                   small);
  const Outcome full = recorder.finish();
  if (full.code == Program::kNotPrepared) {
    GTEST_SKIP() << "may not mount";
  }
  EXPECT_EQ(full.code, 1) << full.err;
  EXPECT_CONTAINS(full.err, "No space left on device");
  EXPECT_CONTAINS(full.err, "the recording ends here");
  EXPECT_CONTAINS(full.err, " runs, ") << "what it has is reported";
  const Outcome again = replay(copy);
  EXPECT_EQ(again.code, 0) << again.out << again.err;
  const std::uint64_t runs = module("counter").runs.load();
  EXPECT_TRUE(runs_reach("counter", runs + 100));
  EXPECT_EQ(module("counter").overruns.load(), 0U);
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0);
}

// A file may grow no more: what was recorded before stays.
TEST_F(RecordingParts, Only_a_full_disk_takes_the_oldest) {
  Program& sut = start_and_wait(kPartsCounter);
  Environment environment = this->environment();
  environment.prepare = [] { return std::signal(SIGXFSZ, SIG_IGN) != SIG_ERR; };  // it gets an error instead
  Program recorder(command({"-o", folder() / "run.mcap", "--split", "200ms", "--keep", "1h"}), environment);
  ASSERT_TRUE(wait_until([&] { return fs::exists(folder() / "run.0003.mcap"); })) << recorder.err();
  const rlimit few{2000, 2000};  // bytes: enough for what it says
  ASSERT_EQ(::prlimit(recorder.pid(), RLIMIT_FSIZE, &few, nullptr), 0);
  EXPECT_EQ(recorder.wait(), 1);
  EXPECT_CONTAINS(recorder.err(), "File too large; the recording ends here");
  EXPECT_FALSE(contains(recorder.err(), "removed")) << recorder.err();
  EXPECT_EQ(replay(folder() / "run.0001.mcap").code, 0);
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0);
}

// A disk of 300 kB, of which the recorder alone knows.
class RecordingPartsOnASmallDisk : public RecordingParts {
 protected:
  // What is on the disk in the end is copied; the recorder's pid is printed at once.
  Program recorder(const std::vector<std::string>& more) {
    const fs::path disk = folder() / "disk";
    fs::create_directory(disk);
    fs::create_directory(copies_);
    Environment small = environment();
    small.prepare = [disk] { return mount_small(disk.string(), "300k"); };
    std::string line;
    for (const std::string& word : command(more)) {
      line += word + " ";
    }
    return Program({"/bin/sh", "-c",
                    line + "-o " + (disk / "run.mcap").string() + " & echo $! > " + pid_file_.string() +
                        "; wait $!; code=$?; cp " + disk.string() + "/* " + copies_.string() + "; exit $code"},
                   small);
  }
  pid_t pid() const {
    pid_t pid = 0;
    EXPECT_TRUE(wait_until([&] { return static_cast<bool>(std::ifstream(pid_file_) >> pid); }));
    return pid;
  }
  void each_can_be_replayed() const {
    for (const fs::path& part : parts(copies_)) {
      const Outcome again = replay(part);
      EXPECT_EQ(again.code, 0) << part << again.out << again.err;
    }
  }

  fs::path copies_ = folder() / "copies";
  fs::path pid_file_ = folder() / "recorder.pid";
};

TEST_F(RecordingPartsOnASmallDisk, The_oldest_make_room) {
  Program& sut = start_and_wait(kPartsCounter);
  const Outcome full = recorder({"--split", "500ms", "--keep", "1h", "--duration", "6s"}).finish();
  if (full.code == Program::kNotPrepared) {
    GTEST_SKIP() << "may not mount";
  }
  EXPECT_EQ(full.code, 0) << full.err;
  EXPECT_CONTAINS(full.err, " older parts were removed");
  each_can_be_replayed();
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0);
}

// What came together meanwhile is more than a part.
TEST_F(RecordingPartsOnASmallDisk, The_oldest_make_room_after_the_recorder_stood_still) {
  Program& sut = start_and_wait(kPartsCounter);
  Program slow = recorder({"--split", "500ms", "--keep", "1h", "--duration", "6s"});
  if (!wait_until([&] { return fs::exists(pid_file_); })) {
    GTEST_SKIP() << "may not mount";
  }
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(runs_reach("counter", module("counter").runs.load() + 200));
    ::kill(pid(), SIGSTOP);
    ASSERT_TRUE(runs_reach("counter", module("counter").runs.load() + 2500));
    ::kill(pid(), SIGCONT);
  }
  const Outcome full = slow.finish();
  EXPECT_FALSE(contains(full.err, "No space left on device")) << full.err;
  EXPECT_CONTAINS(full.err, " older parts were removed");
  each_can_be_replayed();
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0);
}

}  // namespace
}  // namespace indurop::test
