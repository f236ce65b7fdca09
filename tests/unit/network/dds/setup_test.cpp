// SPDX-License-Identifier: Apache-2.0
#include "network/dds/setup.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include "network/dds/handshakes.h"
#include "network/dds/security.h"

namespace indurop::dds {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

NetworkSettings plain() {
  NetworkSettings settings;
  settings.board = "a";
  settings.domain = 3;
  return settings;
}

TEST(Domain_configuration, Multicast_is_for_finding_only) {
  EXPECT_THAT(domain_configuration(plain(), "eth7"), HasSubstr("<AllowMulticast>spdp</AllowMulticast>"));
}

TEST(Domain_configuration, Without_multicast_boards_are_found_at_their_addresses) {
  NetworkSettings settings = plain();
  settings.multicast = false;
  settings.peers = {"10.0.0.1", "board-b.local"};
  const std::string sut = domain_configuration(settings, "eth7");
  EXPECT_THAT(sut, HasSubstr("<AllowMulticast>false</AllowMulticast>"));
  EXPECT_THAT(sut, HasSubstr("<Peer address=\"10.0.0.1\"/><Peer address=\"board-b.local\"/>"));
}

TEST(Domain_configuration, Boards_of_one_host_are_found_by_one_message_to_all) {
  NetworkSettings settings = plain();
  settings.one_host = true;
  const std::string sut = domain_configuration(settings, "lo");
  EXPECT_THAT(sut, HasSubstr("<NetworkInterface name=\"lo\" multicast=\"true\"/>"));
  EXPECT_THAT(sut, HasSubstr("<AllowMulticast>spdp</AllowMulticast>"));
  EXPECT_THAT(sut, Not(HasSubstr("Peer")));
  EXPECT_THAT(sut, Not(HasSubstr("ParticipantIndex"))) << "there may be more than ports to try";
}

TEST(Joining, Programs_that_are_started_later_inherit_no_socket) {
  NetworkSettings settings = plain();
  settings.one_host = true;
  const auto sut = join_network(settings);
  ASSERT_TRUE(sut) << sut.error().text;
  constexpr int kMostFiles = 1024;
  for (int file = STDERR_FILENO + 1; file < kMostFiles; ++file) {
    const int flags = ::fcntl(file, F_GETFD);
    EXPECT_TRUE(flags < 0 || (flags & FD_CLOEXEC) != 0) << file;
  }
}

TEST(Joining, Cyclone_sets_no_limit_for_handshakes) {
  EXPECT_TRUE(handshakes_are_unlimited());
}

NetworkSettings boards_of_one_host(std::size_t others) {
  NetworkSettings settings = plain();
  settings.one_host = true;
  settings.others = others;
  settings.unicast_topics = "indurop/*/*/*/*";
  return settings;
}

TEST(Domain_configuration, On_one_host_all_is_sent_once_for_all_but_what_few_read) {
  const std::string sut = domain_configuration(boards_of_one_host(63), "lo");
  EXPECT_THAT(sut, HasSubstr("<AllowMulticast>spdp,asm</AllowMulticast>"));
  EXPECT_THAT(sut, HasSubstr("<NetworkPartition Name=\"own\" Address=\"127.0.0.1\"/>"));
  EXPECT_THAT(sut, HasSubstr("<PartitionMapping NetworkPartition=\"own\" DCPSPartitionTopic=\"*.indurop/*/*/*/*\"/>"));
  EXPECT_THAT(sut, HasSubstr("<MaxAutoParticipantIndex>118</MaxAutoParticipantIndex>"))
      << "without a port of the domain the address that readers announce has none";
}

TEST(Domain_configuration, More_boards_of_one_host_than_a_domain_has_ports_are_sent_all_one_by_one) {
  const std::string sut = domain_configuration(boards_of_one_host(100), "lo");
  EXPECT_THAT(sut, HasSubstr("<AllowMulticast>spdp</AllowMulticast>"));
  EXPECT_THAT(sut, Not(HasSubstr("Partition")));
  EXPECT_THAT(sut, Not(HasSubstr("ParticipantIndex")));
}

TEST(Domain_configuration, Between_hosts_values_are_sent_to_their_readers_only) {
  NetworkSettings settings = boards_of_one_host(3);
  settings.one_host = false;
  EXPECT_THAT(domain_configuration(settings, "eth7"), HasSubstr("<AllowMulticast>spdp</AllowMulticast>"));
}

TEST(Domain_configuration, Who_is_silent_is_not_forgotten_at_once) {
  NetworkSettings settings = plain();
  EXPECT_THAT(domain_configuration(settings, "eth7"), HasSubstr("<LeaseDuration>500000000 ns</LeaseDuration>"));
  EXPECT_THAT(domain_configuration(settings, "eth7"), Not(HasSubstr("SPDPInterval")));
  settings.forget_ns = 10'000'000'000;
  EXPECT_THAT(domain_configuration(settings, "eth7"), HasSubstr("<LeaseDuration>10000000000 ns</LeaseDuration>"));
  EXPECT_THAT(domain_configuration(settings, "eth7"), HasSubstr("<SPDPInterval>500 ms</SPDPInterval>"));
  settings.others = 64;
  EXPECT_THAT(domain_configuration(settings, "eth7"), HasSubstr("<SPDPInterval>2000 ms</SPDPInterval>"));
}

TEST(Domain_configuration, One_host_without_multicast_is_found_at_loopback) {
  NetworkSettings settings = plain();
  settings.one_host = true;
  settings.multicast = false;
  EXPECT_THAT(domain_configuration(settings, "lo"), HasSubstr("<Peer address=\"127.0.0.1\"/>"));
}

TEST(Domain_configuration, One_host_is_found_by_peers_where_programs_of_others_name_it) {
  NetworkSettings settings = plain();
  settings.one_host = true;
  settings.known_ports = true;
  const std::string sut = domain_configuration(settings, "lo");
  EXPECT_THAT(sut, HasSubstr("<NetworkInterface name=\"lo\"/>"));
  EXPECT_THAT(sut, HasSubstr("<AllowMulticast>false</AllowMulticast>"));
  EXPECT_THAT(sut, HasSubstr("<Peer address=\"127.0.0.1\"/>"));
}

TEST(Domain_configuration, The_more_others_there_are_the_more_rarely_all_are_asked_what_they_lack) {
  const auto interval = [](std::size_t others, bool one_host = false) {
    NetworkSettings settings = plain();
    settings.others = others;
    settings.one_host = one_host;
    const std::string text = domain_configuration(settings, "eth7");
    const auto end = text.find(" ms</HeartbeatInterval>");
    return std::stoi(text.substr(text.rfind('>', end) + 1));
  };
  EXPECT_EQ(interval(0), 10);
  EXPECT_EQ(interval(8), 10);
  EXPECT_EQ(interval(16), 20);
  EXPECT_EQ(interval(63), 78);
  EXPECT_EQ(interval(1000), 100) << "the default of DDS";
  EXPECT_EQ(interval(8, true), 10);
  EXPECT_EQ(interval(16, true), 40) << "on one host all share the processor";
  EXPECT_EQ(interval(63, true), 620);
  EXPECT_EQ(interval(1000, true), 1000);
}

TEST(Domain_configuration, No_priority_is_asked_for_without_the_right_to_it) {
  NetworkSettings settings = plain();
  EXPECT_THAT(domain_configuration(settings, "eth7"), Not(HasSubstr("realtime")));
  settings.fifo_priority = 1;
  EXPECT_THAT(domain_configuration(settings, "eth7"), HasSubstr("<Priority>1</Priority>"));
}

TEST(Domain_configuration, A_name_cannot_break_out_of_its_place) {
  EXPECT_THAT(domain_configuration(plain(), "e\"/><Evil x='&"), Not(HasSubstr("<Evil")));
}

TEST(Domain_configuration, Keys_switch_security_on) {
  NetworkSettings settings = plain();
  EXPECT_THAT(domain_configuration(settings, "eth7"), Not(HasSubstr("Security")));
  settings.security = {"/k/ca.pem", "/k/a&b.pem", "/k/a.key", "/k/g.p7s", "/k/p.p7s", ""};
  const std::string sut = domain_configuration(settings, "eth7");
  EXPECT_THAT(sut, HasSubstr("<IdentityCertificate>file:/k/a&amp;b.pem</IdentityCertificate>"));
  EXPECT_THAT(sut, HasSubstr("<PermissionsCA>file:/k/ca.pem</PermissionsCA>"));
  EXPECT_THAT(sut, Not(HasSubstr("<CRL>")));
  EXPECT_THAT(sut, HasSubstr(security_plugins().string() + "/libdds_security_crypto.so"));
}

TEST(Security, Without_plugins_it_is_said_where_they_come_from) {
  const auto sut = security_usable({"/k", "/k", "/k", "/k", "/k", ""}, {});
  ASSERT_FALSE(sut.ok());
  EXPECT_THAT(sut.error().text, HasSubstr("libddsc0debian"));
}

TEST(Security, A_file_that_cannot_be_read_is_named) {
  const auto sut = security_usable({"/nosuch/ca.pem", "/k", "/k", "/k", "/k", ""}, "/plugins");
  ASSERT_FALSE(sut.ok());
  EXPECT_THAT(sut.error().text, HasSubstr("/nosuch/ca.pem cannot be read: No such file"));
}

TEST(Security, An_open_plant_needs_nothing) {
  EXPECT_TRUE(security_usable({}, {}).ok());
}

TEST(Joining, A_network_interface_that_is_not_there_is_named) {
  NetworkSettings settings = plain();
  settings.interface_name = "nosuch0";
  const auto sut = join_network(settings);
  ASSERT_FALSE(sut.ok());
  EXPECT_THAT(sut.error().text, HasSubstr("nosuch0"));
}

}  // namespace
}  // namespace indurop::dds
