// SPDX-License-Identifier: Apache-2.0
// What is no acceptable XML: place and hint of every mistake, and nothing that hurts.

#include <sys/stat.h>
#include <unistd.h>

#include <fstream>

#include "configuration.h"
#include "tests/support/unprivileged.h"

namespace indurop::config {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

TEST(Syntax, Errors_are_reported_with_line_and_column) {
  const struct {
    const char* xml;
    const char* where;
    const char* what;
  } cases[] = {
      {"<root>\n  <module>\n    <period>1</priority>\n", "m.xml:3:14: ",
       "</priority> where </period> must come first: "
       "<period> was opened at 3:5"},
      {"<root>\n <module>\n", "m.xml:2:2: ", "<module> is never closed"},
      {"<root>\n</root>\n</module>", "m.xml:3:1: ", "closes nothing"},
      {"<root>\n</root>\n<root/>", "m.xml:3:1: ", "second root element"},
      {"<root>\n</root>\n more", "m.xml:3:2: ", "text after the root element"},
      {"hello", "m.xml:1:1: ", "does not begin with a tag"},
      {"<root>\n<!-- open\n", "m.xml:2:1: ", "no end"},
      {"<root><!-- a <!-- b --> -->", "m.xml:1:7: ", "comment inside a comment: this one already ends at 1:24"},
      {"<root>\n<![CDATA[ x", "m.xml:2:1: ", "no end"},
      {"<?xml version=\"1.0\" ", "m.xml:1:1: ", "no end"},
      {"<root a=1>", "m.xml:1:9: ", "not in quotes"},
      {"<root a>", "m.xml:1:7: ", "has no value"},
      {"<root a=\"1>\n</root>", "m.xml:1:10: ", "no closing quote"},
      {"<root a=\"1\"b=\"2\"/>", "m.xml:1:12: ", "space is missing"},
      {"<root a=\"1\" a=\"2\"/>", "m.xml:1:13: ", "appears twice"},
      {"<root>\n<module\n</root>", "m.xml:2:1: ", "lacks its '>'"},
      {"<root></root", "m.xml:1:7: ", "lacks its '>'"},
      {"<root>\n a < b</root>", "m.xml:2:4: ", "write &lt;"},
      {"<root>\n a & b</root>", "m.xml:2:4: ", "write &amp;"},
      {"<root>&bomb;</root>", "m.xml:1:7: ", "write &amp;"},
      {"<root>&#0;</root>", "m.xml:1:7: ", "not a character XML allows"},
      {"<root>&#xD800;</root>", "m.xml:1:7: ", "not a character XML allows"},
      {"<!DOCTYPE root [<!ENTITY a \"b\">]>\n<root>&a;</root>", "m.xml:1:1: ", "are not accepted"},
      {"<root/>\n<?xml version=\"1.0\"?>", "m.xml:2:1: ", "start of the file"},
      {"<?xml version=\"1.0\" encoding=\"ISO-8859-1\"?><root/>",
       "m.xml:1:1: ", "encoding 'ISO-8859-1' is not accepted"},
      {"<root>\n\xE4</root>", "m.xml:2:1: ", "not UTF-8"},
      {"<root>\n\xC3\xA4\xE4</root>", "m.xml:2:2: ", "not UTF-8"},
      {"<root>\x01</root>", "m.xml:1:7: ", "control characters"},
      {"", "m.xml:1:1: ", "empty"},
      {" \r\n\t", "m.xml:1:1: ", "empty"},
      {"<!-- only a comment -->", "m.xml:1:24: ", "no element"},
      {"<>", "m.xml:1:1: ", "write &lt;"},
  };
  for (const auto& c : cases) {
    EXPECT_THAT(errors_of(c.xml), ElementsAre(AllOf(StartsWith(std::string(c.where) + "error: "), HasSubstr(c.what))))
        << c.xml;
  }
}

TEST(Syntax, Utf_16_is_named) {
  EXPECT_THAT(errors_of(std::string("\xFF\xFE<\0r\0", 6)), ElementsAre(HasSubstr("UTF-16")));
  EXPECT_THAT(errors_of(std::string("\0<\0r", 4)), ElementsAre(HasSubstr("UTF-16")));
}

TEST(Syntax, Entity_bomb_is_refused_before_it_grows) {
  std::string bomb = "<?xml version=\"1.0\"?>\n<!DOCTYPE lolz [\n<!ENTITY lol \"lol\">\n";
  for (int i = 0; i < 10; ++i) {
    bomb += "<!ENTITY lol" + std::to_string(i) + " \"&lol;&lol;&lol;&lol;&lol;&lol;&lol;&lol;&lol;&lol;\">\n";
  }
  EXPECT_THAT(errors_of(bomb + "]>\n<root>&lol9;</root>"), ElementsAre(StartsWith("m.xml:2:1: error: document type")));
}

TEST(Syntax, Deep_nesting_is_refused) {
  std::string deep;
  for (int i = 0; i < 100'000; ++i) {
    deep += "<root>";
  }
  EXPECT_THAT(errors_of(deep), ElementsAre(HasSubstr("deeper than 32")));
}

TEST(Syntax, File_above_four_megabytes_is_refused_and_one_of_four_is_read) {
  std::string large = "<root>" + periodic("a.so", "1ms", 1);
  const std::string end = "</root>";
  large.resize(std::size_t{4} * 1024 * 1024 - end.size(), ' ');
  EXPECT_THAT(errors_of(large + end), testing::IsEmpty());
  EXPECT_THAT(errors_of(large + " " + end), ElementsAre(HasSubstr("larger than 4 MB")));
}

TEST(Syntax, Thousands_of_mistakes_end_in_a_summary) {
  std::string many;
  for (int i = 0; i < 5'000; ++i) {
    many += "<modul/>\n";
  }
  const auto sut = errors_of(root(many));
  EXPECT_EQ(sut.size(), 201U);
  EXPECT_THAT(sut.back(), HasSubstr("the first 200 are shown"));
}

TEST(Syntax, Thousands_of_unknown_entities_are_not_all_listed) {
  EXPECT_EQ(errors_of("<root>" + std::string(100'000, '&') + "</root>").size(), 200U);
}

TEST(Syntax, Thousands_of_attributes_are_refused) {
  std::string many = "<root";
  for (int i = 0; i < 100'000; ++i) {
    many += " a" + std::to_string(i) + "=\"\"";
  }
  EXPECT_THAT(errors_of(many + "/>"), ElementsAre(HasSubstr("more than 32 attributes")));
}

TEST(Syntax, Byte_order_mark_and_windows_line_ends_do_not_matter) {
  const std::string xml =
      "\xEF\xBB\xBF<?xml version=\"1.0\" encoding=\"utf-8\"?>\r\n<root>\r\n  <module>\r\n    <filename>a.so"
      "</filename>\r\n    <period>0</period>\r\n  </module>\r\n</root>\r\n";
  EXPECT_THAT(errors_of(xml), testing::Contains(StartsWith("m.xml:5:13: error: <period>: 0")));
}

TEST(Syntax, Columns_count_characters) {
  EXPECT_THAT(errors_of("<root><!-- \xEA\xB8\xB0\xEA\xB3\x84 --><x/></root>"),
              testing::Contains(StartsWith("m.xml:1:18: ")));
}

class Files : public testing::Test {
 protected:
  Files() {
    char name[] = "/tmp/indurop-reader-XXXXXX";
    folder_ = ::mkdtemp(name);
  }
  ~Files() override { std::filesystem::remove_all(folder_); }
  std::vector<std::string> errors(const std::filesystem::path& file) { return lines(read_config(file).diagnostics); }

  std::filesystem::path folder_;
};

TEST_F(Files, What_is_no_readable_file_is_said) {
  EXPECT_THAT(errors(folder_ / "absent.xml"), ElementsAre(HasSubstr("no such file")));
  EXPECT_THAT(errors(folder_), ElementsAre(HasSubstr("is a directory")));
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  EXPECT_THAT(errors(folder_ / "pipe"), ElementsAre(HasSubstr("not an ordinary file")));
  std::ofstream(folder_ / "empty.xml").close();
  EXPECT_THAT(errors(folder_ / "empty.xml"), ElementsAre(HasSubstr("empty.xml:1:1: error: the file is empty")));
}

TEST_F(Files, No_permission_is_said) {
  std::ofstream(folder_ / "secret.xml") << "<root/>";
  ::chmod((folder_ / "secret.xml").c_str(), 0);
  ::chmod(folder_.c_str(), 0755);
  const test::WithoutRoot user;
  ASSERT_TRUE(user.held());
  EXPECT_THAT(errors(folder_ / "secret.xml"), ElementsAre(HasSubstr("not allowed to read")));
}

TEST_F(Files, Module_files_are_relative_to_the_configuration) {
  std::ofstream(folder_ / "m.xml") << root(periodic("./sub/../a.so", "1ms", 1) + periodic("/abs/b.so", "1ms", 2));
  const ReadResult sut = read_config(folder_ / "m.xml");
  ASSERT_TRUE(sut.ok());
  EXPECT_EQ(sut.config.modules[0].file, folder_ / "a.so");
  EXPECT_EQ(sut.config.modules[0].file_as_written, "./sub/../a.so");
  EXPECT_EQ(sut.config.modules[1].file, "/abs/b.so");
}

}  // namespace
}  // namespace indurop::config
