// SPDX-License-Identifier: Apache-2.0
#include "network/dds/setup.h"

#include <gmock/gmock.h>

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
  const auto interval = [](std::size_t others) {
    NetworkSettings settings = plain();
    settings.others = others;
    const std::string text = domain_configuration(settings, "eth7");
    const auto end = text.find(" ms</HeartbeatInterval>");
    return std::stoi(text.substr(text.rfind('>', end) + 1));
  };
  EXPECT_EQ(interval(0), 10);
  EXPECT_EQ(interval(8), 10);
  EXPECT_EQ(interval(16), 20);
  EXPECT_EQ(interval(63), 78);
  EXPECT_EQ(interval(1000), 100) << "as DDS does it by itself";
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
