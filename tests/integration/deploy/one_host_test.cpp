// SPDX-License-Identifier: Apache-2.0
// Deployments to two agents on one host, and the ways they end.

#include <cstdlib>
#include <fstream>

#include "agents_fixture.h"

namespace indurop::test {
namespace {

using testing::HasSubstr;

class Deploying : public AgentsTest {
 protected:
  void start_both() {
    start_agent("a");
    start_agent("b");
  }
  // The id of what both run now.
  std::string deployed(const std::string& file) {
    const Outcome done = deploy(file);
    EXPECT_EQ(done.code, 0) << done.err;
    return done.code == 0 ? done.json()["deployment"].get<std::string>() : "";
  }
};

TEST_F(Deploying, A_plant_is_put_to_work_on_all_boards) {
  start_both();
  const Outcome done = deploy(manifest("v1.xml", {{"a", "steady"}, {"b", "steady"}}));
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_THAT(done.err, HasSubstr("open: no keys"));
  const Json result = done.json();
  EXPECT_EQ(result["result"], "committed");
  ASSERT_EQ(result["boards"].size(), 2U);
  const Json seen = report("a");
  EXPECT_EQ(seen["state"], "running");
  EXPECT_EQ(seen["deployment"], result["deployment"]);
  EXPECT_GT(seen["tick"].get<int>(), 0);
  EXPECT_TRUE(runs("b", result["deployment"]));
}

TEST_F(Deploying, A_module_that_faults_on_one_board_rolls_all_back) {
  start_both();
  const std::string good = deployed(manifest("v1.xml", {{"a", "steady"}, {"b", "steady"}}));
  const Outcome bad = deploy(manifest("v2.xml", {{"a", "other"}, {"b", "faulty"}}), {"--health", "5s"});
  EXPECT_EQ(bad.code, 5) << bad.err;
  EXPECT_EQ(bad.json()["result"], "rolled back");
  EXPECT_THAT(bad.err, HasSubstr(board("b") + ": module faulty faulted: SIGSEGV"));
  EXPECT_TRUE(wait_until([&] { return runs("a", good) && runs("b", good); }));
  // What is said of it is past.
  const std::string taken_back = "deployment " + bad.json()["deployment"].get<std::string>().substr(0, 12) +
                                 " was rolled back: module faulty faulted: SIGSEGV";
  EXPECT_THAT(report("b")["message"].get<std::string>(), HasSubstr(taken_back));
}

TEST_F(Deploying, The_first_deployment_that_does_not_do_leaves_nothing_running) {
  start_both();
  EXPECT_EQ(deploy(manifest("v1.xml", {{"a", "steady"}, {"b", "faulty"}}), {"--health", "5s"}).code, 5);
  EXPECT_TRUE(wait_until([&] { return report("a")["state"] == "empty" && report("b")["state"] == "empty"; }));
  EXPECT_EQ(vars::running_node(board("a")), 0);
}

TEST_F(Deploying, A_bundle_is_deployed_where_its_sources_are_not) {
  start_both();
  const std::string file = manifest("v1.xml", {{"a", "steady"}, {"b", "other"}});
  const std::string id = deployed(file);
  const Outcome packed = indurop_here({"pack", file, "-o", path("p.bundle")});
  ASSERT_EQ(packed.code, 0) << packed.err;
  EXPECT_THAT(packed.err, HasSubstr("not signed"));
  EXPECT_THAT(packed.out, HasSubstr(id.substr(0, 12)));
  for (const char* source : {"v1.xml", "steady.so", "other.so"}) {
    std::filesystem::remove(folder() / source);
  }
  const Outcome done = deploy(path("p.bundle"));
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_EQ(done.json()["deployment"], id);
  EXPECT_TRUE(runs("a", id) && runs("b", id));
  std::fstream bundle(path("p.bundle"), std::ios::in | std::ios::out | std::ios::binary);
  constexpr std::streamoff kDamaged = 500;
  bundle.seekg(kDamaged);
  const int byte = bundle.get();
  bundle.seekp(kDamaged);
  bundle.put(static_cast<char>(byte ^ 1));
  bundle.close();
  ASSERT_TRUE(bundle.good());
  const Outcome refused = deploy(path("p.bundle"));
  EXPECT_EQ(refused.code, 1);
  EXPECT_THAT(refused.err, HasSubstr("p.bundle: "));
  EXPECT_THAT(refused.err, HasSubstr("damaged"));
  EXPECT_TRUE(runs("a", id) && runs("b", id));
}

// Its list of files is changed by another program, as only one who packs it can do.
TEST_F(Deploying, A_bundle_that_leaves_out_a_board_of_its_manifest_is_refused) {
  start_both();
  const std::string file = manifest("v1.xml", {{"a", "steady"}, {"b", "steady"}});
  const std::string id = deployed(file);
  ASSERT_EQ(indurop_here({"pack", file, "-o", path("p.bundle")}).code, 0);
  std::ofstream(folder() / "repack.sh") << R"(set -e
mkdir m
tar --zstd -xf p.bundle -C m
cd m
sed -i "s/,\"$1\"]/]/" package.json
sed -i "s/\"deployment\":\"[0-9a-f]*/\"deployment\":\"$(sha256sum < package.json | cut -c1-64)/" signature.json
tar --zstd -cf ../p.bundle package.json signature.json files/*
)";
  ASSERT_EQ(std::system(("cd " + path("") + " && sh repack.sh " + board("b")).c_str()), 0);
  const Outcome refused = deploy(path("p.bundle"));
  EXPECT_EQ(refused.code, 1);
  EXPECT_THAT(refused.err, HasSubstr("names another plant, or other boards, than the manifest in it"));
  EXPECT_TRUE(runs("a", id) && runs("b", id));
  EXPECT_EQ(deploy(path("p.bundle"), {"-m", "text"}).code, 2) << "a bundle has its comment";
}

TEST_F(Deploying, Without_a_temporary_folder_the_files_here_stay_as_they_are) {
  start_both();
  const std::string file = manifest("v1.xml", {{"a", "steady"}, {"b", "steady"}});
  std::ofstream(folder() / "CMakeLists.txt") << "project(x)\n";
  deployed(file);
  std::ofstream(folder() / "CMakeLists.txt") << "project(changed)\n";
  const Outcome none = start({"/bin/sh", "-c", "cd " + path("") + " && exec \"$@\"", "sh", INDUROP_PROGRAM, "diff",
                              file, "--one-host", "--domain", std::to_string(link_domain())},
                             {.variables = {"TMPDIR=/nonexistent"}})
                           .finish();
  EXPECT_EQ(none.code, 1);
  EXPECT_THAT(none.err, HasSubstr("is TMPDIR a folder with room"));
  std::string text;
  std::getline(std::ifstream(folder() / "CMakeLists.txt"), text);
  EXPECT_EQ(text, "project(changed)");
  EXPECT_FALSE(std::filesystem::exists(folder() / "sources"));
}

TEST_F(Deploying, A_bundle_that_is_older_than_what_runs_is_refused_without_older) {
  start_both();
  const auto packed = [&](const char* name, const char* module) {
    const std::string bundle = path(std::string(name) + ".bundle");
    const std::string file = manifest(std::string(name) + ".xml", {{"a", module}, {"b", "steady"}});
    EXPECT_EQ(indurop_here({"pack", file, "-o", bundle}).code, 0);
    return bundle;
  };
  const std::string first = packed("v1", "steady");
  const std::string second = packed("v2", "other");
  const std::string old_id = deployed(first);
  const std::string id = deployed(second);
  EXPECT_EQ(deploy(second).code, 0) << "what runs may be deployed again";
  const Outcome refused = deploy(first);
  EXPECT_EQ(refused.code, 1);
  EXPECT_THAT(refused.err, HasSubstr("v1.bundle: deployment " + old_id.substr(0, 12) + " was committed on board "));
  EXPECT_THAT(refused.err, HasSubstr("before " + id.substr(0, 12)));
  EXPECT_THAT(refused.err, HasSubstr("add --older"));
  EXPECT_TRUE(runs("a", id) && runs("b", id));
  EXPECT_EQ(deploy(first, {"--older"}).code, 0);
  // A board whose modules stay the same says a little later what they belong to.
  EXPECT_TRUE(test::wait_until([&] { return runs("a", old_id) && runs("b", old_id); }));
  EXPECT_EQ(deploy(second).code, 0) << "the newer one needs no word";
}

TEST_F(Deploying, The_sources_come_back_from_a_board) {
  start_both();
  const std::string file = manifest("v1.xml", {{"a", "steady"}, {"b", "steady"}});
  std::filesystem::create_directories(folder() / "src/deep");
  std::ofstream(folder() / "CMakeLists.txt") << "project(x)\n";
  std::ofstream(folder() / "src/deep/a.cpp") << "int a;\n";
  std::ofstream(folder() / "secret.txt") << "-----BEGIN PRIVATE KEY-----\n";
  std::ofstream(folder() / "made.log") << "made\n";
  std::ofstream(folder() / ".gitignore") << "*.log\n*.so\n/state/\n/back/\n";
  const std::string git = "cd " + path("") +
                          " && git init -q . && git -c user.name=x -c user.email=x add . && "
                          "git -c user.name=x -c user.email=x commit -qm first";
  ASSERT_EQ(std::system(git.c_str()), 0);
  const std::string id = deployed(file);
  EXPECT_EQ(indurop({"diff", file}).code, 0);

  const Outcome pulled = indurop({"pull", path("back")});
  ASSERT_EQ(pulled.code, 0) << pulled.err;
  EXPECT_THAT(pulled.out, HasSubstr("git commit "));
  EXPECT_THAT(pulled.out, testing::Not(HasSubstr("not committed")));
  for (const char* source : {"v1.xml", "CMakeLists.txt", "src/deep/a.cpp", ".gitignore"}) {
    const std::string same = "cmp -s " + path(source) + " " + path("back") + "/" + source;
    EXPECT_EQ(std::system(same.c_str()), 0) << source;
  }
  for (const char* none : {"secret.txt", "made.log", "steady.so"}) {
    EXPECT_FALSE(std::filesystem::exists(folder() / "back" / none)) << none;
  }
  EXPECT_EQ(indurop({"pull", path("back")}).code, 1) << "it is not empty";
  // In no work tree any more; the modules are as they were built.
  std::filesystem::copy(folder() / "back", folder().string() + "-back", std::filesystem::copy_options::recursive);
  std::filesystem::copy_file(folder() / "steady.so", folder().string() + "-back/steady.so");
  const Outcome same = indurop({"diff", folder().string() + "-back/v1.xml"});
  EXPECT_EQ(same.code, 0) << same.out << same.err;
  std::filesystem::remove_all(folder().string() + "-back");

  std::ofstream(folder() / "src/deep/a.cpp") << "int b;\n";
  const Outcome different = indurop({"diff", file, "-o", "json"});
  EXPECT_EQ(different.code, 1) << different.err;
  ASSERT_EQ(different.json()["files"].size(), 1U) << different.out;
  EXPECT_NE(deployed(file), id);
}

TEST_F(Deploying, Sources_stay_where_the_manifest_says_so) {
  start_both();
  const std::string file = manifest("v1.xml", {{"a", "steady"}, {"b", "steady"}});
  std::ofstream(folder() / "CMakeLists.txt") << "project(x)\n";
  ASSERT_EQ(std::system(("sed -i 's|<external>|<sources>off</sources><external>|' " + file).c_str()), 0);
  deployed(file);
  const Outcome pulled = indurop({"pull", path("back")});
  EXPECT_EQ(pulled.code, 1);
  EXPECT_THAT(pulled.err, HasSubstr("was deployed without its sources"));
  EXPECT_FALSE(std::filesystem::exists(folder() / "back"));
}

TEST_F(Deploying, A_missing_board_is_named_and_nothing_is_deployed) {
  start_agent("a");
  const Outcome refused = deploy(manifest("v1.xml", {{"a", "steady"}, {"b", "steady"}}), {"--timeout", "1s"});
  EXPECT_EQ(refused.code, 6);
  EXPECT_THAT(refused.err, HasSubstr("missing: " + board("b")));
  EXPECT_EQ(report("a")["state"], "empty");
}

TEST_F(Deploying, A_missing_board_takes_over_what_it_missed_when_it_comes) {
  start_agent("a");
  const Outcome done =
      deploy(manifest("v1.xml", {{"a", "steady"}, {"b", "steady"}}), {"--timeout", "2s", "--allow-missing"});
  ASSERT_EQ(done.code, 0) << done.err;
  start_agent("b");
  EXPECT_TRUE(wait_until([&] { return runs("b", done.json()["deployment"]); }));
}

TEST_F(Deploying, Errors_of_the_manifest_are_reported_before_anything_is_sent) {
  start_both();
  const Outcome refused = deploy(manifest("v1.xml", {{"a", "steady"}, {"b", "gone"}}));
  EXPECT_EQ(refused.code, 4);
  EXPECT_THAT(refused.err, HasSubstr("v1.xml:3:"));
  EXPECT_THAT(refused.err, HasSubstr("nothing was deployed"));
  EXPECT_EQ(deploy(path("steady.so")).code, 2);
}

TEST_F(Deploying, Rollback_goes_back_and_history_tells_it) {
  start_both();
  const std::string first = deployed(manifest("v1.xml", {{"a", "steady"}, {"b", "steady"}}));
  const std::string second = deployed(manifest("v2.xml", {{"a", "other"}, {"b", "steady"}}));
  ASSERT_NE(first, second);
  const Outcome back = indurop({"rollback", "--health", "500ms", "-o", "json"});
  ASSERT_EQ(back.code, 0) << back.err;
  EXPECT_EQ(back.json()["deployment"], first);
  EXPECT_TRUE(runs("a", first) && runs("b", first));
  const Outcome named = indurop({"rollback", second.substr(0, 8), "--health", "500ms"});
  EXPECT_EQ(named.code, 0) << named.err;
  EXPECT_TRUE(runs("a", second));
  const Json past = indurop({"history", "-o", "json"}).json();
  ASSERT_EQ(past["deployments"].size(), 4U);
  EXPECT_EQ(past["deployments"][0]["deployment"], first);
  EXPECT_EQ(past["deployments"][3]["deployment"], second);
  EXPECT_EQ(past["deployments"][3]["current"], true);
  EXPECT_EQ(past["deployments"][3]["boards"].size(), 2U);
  EXPECT_EQ(indurop({"rollback", "ffffffff"}).code, 1);
}

TEST_F(Deploying, A_comment_stays_with_its_deployment) {
  start_both();
  const std::string file = manifest("v1.xml", {{"a", "steady"}, {"b", "steady"}});
  EXPECT_EQ(deploy(file, {"-m", "two\nlines"}).code, 2);
  EXPECT_EQ(deploy(file, {"-m", "as it was: 20 °C"}).code, 0);
  EXPECT_EQ(report("a")["comment"], "as it was: 20 °C");
  EXPECT_EQ(deploy(manifest("v2.xml", {{"a", "other"}, {"b", "steady"}}), {"--comment", "wider"}).code, 0);
  EXPECT_EQ(indurop({"rollback", "--health", "500ms"}).code, 0);
  EXPECT_EQ(report("b")["comment"], "as it was: 20 °C");
  std::vector<std::string> comments;
  const Json answer = indurop({"history", "-o", "json"}).json();
  for (const Json& past : answer["deployments"]) {
    comments.push_back(past["comment"]);
  }
  EXPECT_THAT(comments, testing::ElementsAre("as it was: 20 °C", "wider", "as it was: 20 °C"));
  stop_agent("a", SIGKILL);  // it is on the disk
  start_agent("a");
  EXPECT_TRUE(wait_until([&] { return report("a").is_object() && report("a")["comment"] == "as it was: 20 °C"; }));
}

TEST_F(Deploying, A_board_that_does_not_report_its_history_is_named) {
  start_both();
  deployed(manifest("v1.xml", {{"a", "steady"}, {"b", "steady"}}));
  agent("b").signal(SIGSTOP);
  const Outcome past = indurop({"history", "-o", "json"});
  agent("b").signal(SIGCONT);
  EXPECT_EQ(past.code, 6);
  EXPECT_THAT(past.err, HasSubstr("board " + board("b") + " was not heard or did not answer"));
  EXPECT_EQ(past.json()["missing"], Json({board("b")}));
  EXPECT_EQ(past.json()["deployments"].size(), 1U);
}

TEST_F(Deploying, The_second_of_two_deployers_gets_the_answer_busy) {
  start_both();
  const std::string one = manifest("v1.xml", {{"a", "steady"}, {"b", "steady"}});
  const std::string two = manifest("v2.xml", {{"a", "other"}, {"b", "steady"}});
  Program& first = start_indurop({"deploy", one, "--health", "3s", "-o", "json"});
  Program& second = start_indurop({"deploy", two, "--health", "3s", "-o", "json"});
  const Outcome a = first.finish();
  const Outcome b = second.finish();
  const Outcome& winner = a.code == 0 ? a : b;
  const Outcome& loser = a.code == 0 ? b : a;
  ASSERT_EQ(winner.code, 0) << a.err << b.err;
  ASSERT_EQ(loser.code, 1) << loser.err;
  EXPECT_EQ(loser.json()["result"], "busy");
  EXPECT_THAT(loser.err, HasSubstr("busy with deployment"));
  EXPECT_TRUE(runs("a", winner.json()["deployment"]) && runs("b", winner.json()["deployment"]));
}

TEST_F(Deploying, Two_agents_of_one_name_are_refused) {
  start_both();
  std::filesystem::create_directories(folder() / "elsewhere");
  ASSERT_TRUE(wait_until([&] { return report("b").is_object(); }));
  // The state directory of the second is another machine's; its node would be the same here, but none is started.
  const std::string twin = path("elsewhere");
  Program& known = agent("a");
  start_agent("a", {}, twin);
  const std::string file = manifest("v1.xml", {{"a", "steady"}, {"b", "steady"}});
  EXPECT_TRUE(wait_until([&] {
    const Outcome refused = deploy(file, {"--timeout", "1s"});
    return refused.code == 1 && refused.err.find("two agents are named " + board("a")) != std::string::npos;
  }));
  stop_agent("a", SIGTERM);
  adopt_agent("a", known);
}

// Of two who are let into the network of agents: the key that signs deployments is the deployer's alone.
TEST_F(Deploying, A_board_with_a_key_takes_signed_deployments_only) {
  const std::string file = manifest("v1.xml", {{"a", "steady"}, {"b", "steady"}});
  bring_keys(file, {"a", "b"});
  ASSERT_EQ(indurop_here({"keys", "init", file, "--dir", path("strange")}).code, 0);
  const auto thief = folder() / "thief";
  std::filesystem::copy(folder() / "keys/deployer", thief);
  std::filesystem::copy_file(folder() / "strange/deployer/deploy.key", thief / "deploy.key",
                             std::filesystem::copy_options::overwrite_existing);
  start_both();
  const std::string plant = "p" + std::to_string(::getpid());
  const Outcome strange = deploy(file, {"--keys", thief.string()});
  EXPECT_EQ(strange.code, 1);
  EXPECT_THAT(strange.err, HasSubstr("not signed with the key of plant " + plant));
  speak_with_keys(path("keys"));
  EXPECT_EQ(report("a")["state"], "empty");
  const Outcome done = deploy(file);
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_EQ(done.json()["signed"], true);
  EXPECT_TRUE(runs("a", done.json()["deployment"]) && runs("b", done.json()["deployment"]));
}

TEST_F(Deploying, An_agent_needs_a_board_and_a_place) {
  start_agent("a");
  ASSERT_TRUE(wait_until([&] { return report("a").is_object(); }));
  Program& known = agent("a");
  start_agent("a");  // the same state directory
  EXPECT_TRUE(wait_until([&] { return agent("a").err().find("another agent of board") != std::string::npos; }));
  stop_agent("a", SIGTERM);
  adopt_agent("a", known);
}

}  // namespace
}  // namespace indurop::test
