// SPDX-License-Identifier: Apache-2.0
// An external plane that only holders of keys take part in: indurop itself, programs of Cyclone DDS and of Fast DDS, as
// friends with lists of variables and as strangers with no keys, wrong ones or those of another user.

#include <dlfcn.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "core/keys/participant_keys.h"
#include "live.h"
#include "network/dds/endpoint.h"
#include "network/dds/guid.h"
#include "network/dds/setup.h"

namespace indurop::test {
namespace {

namespace fs = std::filesystem;

class Secured : public Live {
 protected:
  // A plant of one board, and tools: "panel" reads the state and sets the target, "blind" knows other variables only.
  void start_plant() {
    file_ = write("plant.xml", "<plant name=\"cell\"><security>keys</security><external secure=\"on\">" + domain() +
                                   "</external><domain>" + std::to_string(dds_domain(1)) + "</domain><types>" +
                                   EXAMPLE_FOLDER "/libstation_types.so</types>" +
                                   "<variable name=\"station::target\" external=\"write\"/><board name=\"" + node() +
                                   "\"><module><filename>" EXAMPLE_FOLDER "/axis.so</filename><moduletype>thread" +
                                   "</moduletype><operationtype>periodic</operationtype><period>1ms</period>" +
                                   "<priority>1</priority></module></board></plant>");
    make({"init", file_});
    make({"add", "--dir", keys(""), "--tool", "panel", "--read", "station::state", "--write", "station::target"});
    make({"add", "--dir", keys(""), "--tool", "blind", "--read", "other::*"});
    Program& program = start_file(file_, {"--board", node(), "--one-host"});
    ASSERT_TRUE(wait_until_running(program)) << program.err();
    ASSERT_TRUE(wait_until([&] { return block() != nullptr && block()->network.load() == mirror::Network::Up; }))
        << (block() == nullptr ? "no external plane" : block()->problem.get());
    EXPECT_TRUE(runs_reach("axis", 300)) << "what a late joiner gets first may be 100 ms old";
  }
  void make(std::vector<std::string> words) const {
    words.insert(words.begin(), "keys");
    const Outcome made = indurop(words);
    ASSERT_EQ(made.code, 0) << made.err;
  }
  std::string keys(const std::string& whose) const { return (folder() / "keys" / whose).string(); }
  const std::string& file() const { return file_; }
  // Without keys if `whose` is "none".
  Outcome remote(std::vector<std::string> words, const std::string& whose) const {
    words.insert(words.end(), {"--one-host", "--domain", domain()});
    if (whose != "none") {
      words.insert(words.end(), {"--keys", whose.starts_with("/") ? whose : keys(whose)});
    }
    return indurop(words);
  }
  Program& example(const std::vector<std::string>& words, const std::vector<std::string>& settings) {
    std::vector<std::string> command = words;
    command.front() = std::string(EXAMPLE_FOLDER) + "/" + command.front();
    programs_.push_back(std::make_unique<Program>(command, Environment{settings, static_cast<uid_t>(-1), {}}));
    return *programs_.back();
  }
  // The file of examples/external with a folder of keys in it.
  std::string filled_in(const std::string& example, const std::string& whose, const std::string& mark) const {
    std::ifstream in(std::string(EXAMPLE_SOURCES) + "/" + example);
    std::string text{std::istreambuf_iterator<char>(in), {}};
    for (auto at = text.find(mark); at != std::string::npos; at = text.find(mark)) {
      text.replace(at, mark.size(), keys(whose));
    }
    std::string name = whose + "_" + example;
    std::replace(name.begin(), name.end(), '/', '_');
    return write(name, text);
  }
  Program& cyclone(const std::vector<std::string>& words, const std::string& whose) {
    return example(words, {"CYCLONEDDS_URI=file://" + filled_in("keys_cyclone.xml", whose, "${KEYS}")});
  }
  Program& fastdds(const std::vector<std::string>& words, const std::string& whose) {
    const std::string profiles = filled_in("keys_fastdds.xml", whose, "KEYS");
    return example(words, {"FASTRTPS_DEFAULT_PROFILES_FILE=" + profiles,   // Fast DDS 2
                           "FASTDDS_DEFAULT_PROFILES_FILE=" + profiles});  // Fast DDS 3
  }
  // A participant of this process that writes 666 to station::target whatever it may.
  bool write_target(const dds::Security& security) {
    dds::NetworkSettings settings;
    settings.domain = dds_domain();
    settings.interface_name = "lo";
    settings.security = security;
    const auto joined = dds::join_network(settings);
    void* const types = ::dlopen(EXAMPLE_FOLDER "/libstation_types.so", RTLD_NOW);
    const auto* type = static_cast<const dds::TypeDescriptor*>(::dlsym(types, "station_target__desc"));
    EXPECT_TRUE(joined.ok());
    EXPECT_NE(type, nullptr);
    if (!joined.ok() || type == nullptr) {
      return false;
    }
    const auto writer =
        dds::make_writer(joined->participant.get(), *type, "station/target", dds::make_qos({.for_late_ones = false}));
    EXPECT_TRUE(writer.ok()) << writer.why();
    const double wrong = 66.6;
    // As long as a friend needs to be let in and to set the variable, which it does after this writer was made.
    EXPECT_EQ(remote({"set", "station::target", "12.5"}, "tools/panel").code, 0);
    for (int i = 0; i < 5; ++i) {
      (void)dds::write_bytes(writer.get(), &wrong);
      EXPECT_EQ(remote({"get", "station::target"}, "tools/panel").out, "12.5\n");
    }
    return dds::readers_of(writer.get()).value_or(0) > 0;
  }
  static dds::Security files_of(const fs::path& folder) {
    const keys::ParticipantKeys in(folder);
    return {in.authority.string(),  in.certificate.string(), in.key.string(),
            in.governance.string(), in.permissions.string(), in.revoked.string()};
  }

 private:
  std::string file_;
};

TEST_F(Secured, A_tool_reads_and_sets_what_its_lists_name) {
  start_plant();
  const Outcome state = remote({"get", "station::state.program"}, "tools/panel");
  EXPECT_EQ(state.code, 0) << state.err;
  EXPECT_EQ(state.out, "\"pick and place\"\n");
  const Outcome set = remote({"set", "station::target", "42.5"}, "tools/panel");
  EXPECT_EQ(set.code, 0) << set.err;
  EXPECT_CONTAINS(get("station::target"), "42.5");
  const Outcome limit = remote({"get", "station::limit"}, "tools/panel");
  EXPECT_EQ(limit.code, 1);
  EXPECT_CONTAINS(limit.err, "do not let station::limit be read");
  const Outcome all = remote({"get", "station::*", "-o", "csv"}, "tools/panel");
  EXPECT_EQ(all.code, 0);
  EXPECT_CONTAINS(all.err, "do not let station::limit be read");
  EXPECT_CONTAINS(all.out, "station::target");
  EXPECT_FALSE(contains(all.out, "station::limit"));
}

TEST_F(Secured, A_tool_of_other_variables_reads_and_sets_nothing) {
  start_plant();
  const Outcome state = remote({"get", "station::state"}, "tools/blind");
  EXPECT_EQ(state.code, 1);
  EXPECT_EQ(state.out, "");
  const Outcome set = remote({"set", "station::target", "3"}, "tools/blind");
  EXPECT_EQ(set.code, 1);
  EXPECT_CONTAINS(set.err, "do not let");
  EXPECT_CONTAINS(get("station::target"), "100");
}

TEST_F(Secured, A_viewer_reads_everything_and_sets_nothing) {
  start_plant();
  EXPECT_EQ(remote({"get", "station::limit"}, "").out, "400\n") << "the plant's folder means its viewer";
  const Outcome set = remote({"set", "station::target", "3"}, "viewer");
  EXPECT_EQ(set.code, 1);
  EXPECT_CONTAINS(set.err, "the keys given by --keys do not let it be set");
  EXPECT_CONTAINS(get("station::target"), "100");
}

TEST_F(Secured, Without_keys_or_with_wrong_ones_a_message_says_what_to_do) {
  start_plant();
  const Outcome none = remote({"get", "station::state", "--wait", "1s"}, "none");
  EXPECT_EQ(none.code, 6);
  EXPECT_CONTAINS(none.err, "<external secure=\"on\">: --keys");
  make({"init", file(), "--dir", (folder() / "foreign").string()});
  const Outcome foreign = remote({"get", "station::state", "--wait", "2s"}, (folder() / "foreign").string());
  EXPECT_EQ(foreign.code, 6);
  EXPECT_CONTAINS(foreign.err, "only boards of the same plant");
  EXPECT_EQ(remote({"get", "station::state"}, "/nowhere").code, 2);
  fs::copy_file(keys("tools/panel/permissions.p7s"), keys("tools/blind/permissions.p7s"),
                fs::copy_options::overwrite_existing);
  const Outcome borrowed = remote({"get", "station::state"}, "tools/blind");
  EXPECT_EQ(borrowed.code, 6);
  EXPECT_CONTAINS(borrowed.err, "keys refused");
}

TEST_F(Secured, Strangers_cannot_set_a_variable) {
  start_plant();
  EXPECT_FALSE(write_target({})) << "without keys";
  make({"init", file(), "--dir", (folder() / "foreign").string()});
  make({"add", "--dir", (folder() / "foreign").string(), "--tool", "panel", "--write", "station::target"});
  EXPECT_FALSE(write_target(files_of(folder() / "foreign/tools/panel"))) << "with keys of another authority";
}

TEST_F(Secured, A_Cyclone_program_reads_what_its_keys_let_it) {
  start_plant();
  Program& stranger = tool({"watch_cyclone", domain()});
  Program& blind = cyclone({"watch_cyclone", domain()}, "tools/blind");
  expect_samples(cyclone({"watch_cyclone", domain(), "20"}, "tools/panel"), 20);
  EXPECT_EQ(blind.wait(), 1);
  EXPECT_CONTAINS(blind.err(), "cannot read station/state");
  EXPECT_EQ(lines(stranger), 0U);
  stranger.kill();
}

TEST_F(Secured, Changed_lists_count_after_a_renewal) {
  start_plant();
  std::ofstream(keys("tools/blind/variables.txt")) << "read station::limit\n";
  EXPECT_CONTAINS(indurop({"keys", "list", "--dir", keys("")}).out, "indurop keys renew blind");
  make({"renew", "blind", "--dir", keys("")});
  EXPECT_EQ(remote({"get", "station::limit"}, "tools/blind").out, "400\n");
}

#ifdef WITH_FASTDDS
// Fast DDS is let in and then hears nothing, for good, about every third time (docs/adr/0016): it starts again then.
TEST_F(Secured, A_FastDDS_program_reads_and_sets_what_its_keys_let_it) {
#ifdef FASTDDS_3
  GTEST_SKIP() << "Fast DDS 3 waits for a message that Cyclone DDS 0.10 does not send (docs/adr/0016)";
#endif
  start_plant();
  const auto succeeds = [&](const std::vector<std::string>& words) {
    constexpr int kStarts = 8;
    for (int i = 0; i < kStarts; ++i) {
      Program& program = fastdds(words, "tools/panel");
      const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(25);
      while (program.running() && std::chrono::steady_clock::now() < end) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
      }
      program.kill();
      if (program.wait() == 0) {
        return true;
      }
    }
    return false;
  };
  EXPECT_TRUE(succeeds({"watch_fastdds", domain(), "20"}));
  EXPECT_TRUE(succeeds({"set_fastdds", "33", domain()}));
  EXPECT_CONTAINS(get("station::target"), "33");
}

TEST_F(Secured, A_FastDDS_program_without_rights_reads_nothing) {
  start_plant();
  Program& stranger = tool({"watch_fastdds", domain()});
  Program& blind = fastdds({"watch_fastdds", domain()}, "tools/blind");
  expect_samples(cyclone({"watch_cyclone", domain(), "20"}, "tools/panel"), 20);
  EXPECT_EQ(blind.wait(), 1);
  EXPECT_EQ(lines(stranger), 0U);
  stranger.kill();
}
#endif

}  // namespace
}  // namespace indurop::test
