// SPDX-License-Identifier: Apache-2.0
// EEPROM images: small ones made here, those of real slaves, and bytes that are no image.
#include "control/io/ethercat/sii.h"

#include <gmock/gmock.h>

#include <random>

#include "real_data.h"

namespace indurop::io::ethercat {
namespace {

using Image = std::vector<std::uint8_t>;

void append_category(Image& image, std::uint16_t category, Image bytes) {
  bytes.resize((bytes.size() + 1) / 2 * 2);
  const std::size_t at = image.size();
  image.resize(at + 4);
  store<std::uint16_t>(image, at, category);
  store<std::uint16_t>(image, at + 2, static_cast<std::uint16_t>(bytes.size() / 2));
  image.insert(image.end(), bytes.begin(), bytes.end());
}

Image small_image() {
  Image image(128);
  store<std::uint16_t>(image, 8, 0x0107);
  store<std::uint32_t>(image, 0x10, 0x000004D8);
  store<std::uint32_t>(image, 0x14, 0x12345678);
  image[0x0E] = sii_checksum(image);
  // The texts come last: their numbers are known before.
  append_category(image, 51, {0x00, 0x16, 1, 2, 0, 1, 0, 0, 0x40, 0x60, 0, 2, 6, 16, 0, 0});
  append_category(image, 10, {2, 4, 'p', 'd', 'o', '1', 3, 'c', 't', 'l'});
  image.insert(image.end(), {0xFF, 0xFF});
  return image;
}

TEST(Sii, A_small_image_is_read) {
  const auto sii = read_sii(small_image());
  ASSERT_TRUE(sii.ok()) << sii.error();
  EXPECT_TRUE(sii->checksum_fits);
  EXPECT_EQ(sii->alias, 0x0107);
  EXPECT_EQ(sii->identity, (Identity{0x4D8, 0x12345678, 0, 0}));
  ASSERT_EQ(sii->outputs.size(), 1U);
  EXPECT_EQ(sii->outputs[0].name, "pdo1");
  EXPECT_EQ(sii->outputs[0].sync_manager, 2);
  ASSERT_EQ(sii->outputs[0].entries.size(), 1U);
  EXPECT_EQ(sii->outputs[0].entries[0].name, "ctl");
  EXPECT_EQ(bits_of(sii->outputs[0]), 16U);
}

TEST(Sii, Broken_images_say_where) {
  const auto error_of = [](const Image& image) {
    const auto sii = read_sii(image);
    return sii.ok() ? std::string("no error") : sii.error();
  };
  EXPECT_EQ(error_of(Image(100)), "the image has 100 bytes, its fixed part alone has 128");
  EXPECT_EQ(error_of(Image(128, 0xFF)), "the EEPROM is empty; write the maker's image to it");
  auto image = small_image();
  image[130] = 99;
  EXPECT_EQ(error_of(image), "word 0040h: category 51 has 198 bytes, the image ends after 32");
  image = small_image();
  image[134] = 2;
  EXPECT_EQ(error_of(image), "word 0040h: category 51: PDO 1600h has 2 entries, more than the category");
  image = small_image();
  image[152] = 3;
  EXPECT_EQ(error_of(image), "word 004ah: category 10: text 3 of 3 is longer than the category");
}

TEST(Sii, No_bytes_lead_the_reader_astray) {
  std::mt19937 random(2);
  for (int round = 0; round < 50'000; ++round) {
    auto image = small_image();
    const auto changes = random() % 6 + 1;
    for (unsigned i = 0; i < changes; ++i) {
      image[random() % image.size()] = static_cast<std::uint8_t>(random());
    }
    image.resize(random() % 4 == 0 ? random() % image.size() : image.size());
    const auto sii = read_sii(image);
    ASSERT_TRUE(sii.ok() || !sii.error().empty());
  }
}

Sii real(const std::string& name) {
  const auto image = bytes_of_file(real_data() / "dumps" / name);
  auto sii = read_sii(image);
  EXPECT_TRUE(sii.ok()) << name << ": " << sii.error();
  return sii.ok() ? std::move(sii).value() : Sii();
}

TEST(RealSii, A_coupler_has_a_name_and_supplies_current) {
  INDUROP_NEEDS_REAL_DATA();
  const Sii sii = real("ek1100-eeprom-dump.bin");
  EXPECT_TRUE(sii.checksum_fits);
  EXPECT_EQ(sii.identity, (Identity{2, 0x044C2C52, 0x00120000, 0}));
  EXPECT_EQ(sii.order, "EK1100");
  EXPECT_EQ(sii.name, "EK1100 EtherCAT-Koppler (2A E-Bus)");
  EXPECT_EQ(sii.ebus_milliamperes, -2000);
  EXPECT_THAT(sii.sync_managers, testing::IsEmpty());
}

TEST(RealSii, A_terminal_has_four_outputs) {
  INDUROP_NEEDS_REAL_DATA();
  const Sii sii = real("el2004-eeprom-dump.bin");
  EXPECT_EQ(sii.identity.product, 0x07D43052U);
  EXPECT_EQ(sii.ebus_milliamperes, 100);
  ASSERT_EQ(sii.sync_managers.size(), 1U);
  EXPECT_EQ(sii.sync_managers[0].start, 0x0F00);
  EXPECT_EQ(sii.sync_managers[0].control, 0x44);
  EXPECT_EQ(sii.sync_managers[0].use, SyncManagerUse::Outputs);
  ASSERT_EQ(sii.outputs.size(), 4U);
  EXPECT_EQ(sii.outputs[3].name, "Channel 4");
  EXPECT_EQ(sii.outputs[3].entries[0].bits, 1);
}

TEST(RealSii, A_servo_drive_has_mailboxes_mappings_and_clock_modes) {
  INDUROP_NEEDS_REAL_DATA();
  const Sii sii = real("eeprom/akd.hex");
  EXPECT_EQ(sii.identity.vendor, 0x6AU);
  EXPECT_EQ(sii.name, "AKD EtherCAT Drive (CoE)");
  EXPECT_EQ(sii.mailbox.receive_at, 0x1800);
  EXPECT_EQ(sii.mailbox.send_size, 0x400);
  EXPECT_NE(sii.protocols & kProtocolCoe, 0);
  ASSERT_EQ(sii.sync_managers.size(), 4U);
  EXPECT_EQ(sii.sync_managers[3].use, SyncManagerUse::Inputs);
  EXPECT_THAT(sii.fmmus,
              testing::ElementsAre(FmmuUse::Outputs, FmmuUse::Inputs, FmmuUse::MailboxState, FmmuUse::Unused));
  ASSERT_EQ(sii.clocks.size(), 2U);
  EXPECT_EQ(sii.clocks[0].name, "DcSync");
  EXPECT_EQ(sii.clocks[0].assign_activate, 0x0300);
  ASSERT_FALSE(sii.outputs.empty());
  EXPECT_EQ(sii.outputs[0].entries[0].name, "Controlword");
}

TEST(RealSii, All_images_are_read_or_named_empty) {
  INDUROP_NEEDS_REAL_DATA();
  for (const char* const name : {"eeprom/ek1100.hex", "eeprom/el2262.bin", "eeprom/el2828.hex", "eeprom/el2889.hex",
                                 "eeprom/hbm_clipx_eeprom_dump.bin"}) {
    const Sii sii = real(name);
    EXPECT_NE(sii.identity.vendor, 0U) << name;
    EXPECT_FALSE(sii.name.empty()) << name;
  }
  const auto empty = read_sii(bytes_of_file(real_data() / "dumps/issue-286-empty-eeprom-example.bin"));
  ASSERT_FALSE(empty.ok());
  // Its texts were cut without a change of their category's length.
  const auto cut = read_sii(bytes_of_file(real_data() / "dumps/eeprom/akd_null_strings.hex"));
  ASSERT_FALSE(cut.ok());
  EXPECT_EQ(cut.error(), "word 0145h: category 256 has 2560 bytes, the image ends after 1382");
  EXPECT_THAT(empty.error(), testing::HasSubstr("empty"));
}

}  // namespace
}  // namespace indurop::io::ethercat
