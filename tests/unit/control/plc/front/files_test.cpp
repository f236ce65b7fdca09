// SPDX-License-Identifier: Apache-2.0
// Forms of files: TwinCAT's objects and projects, libraries, what editors bring along, C code that means something.

#include <gmock/gmock.h>

#include <map>

#include "control/plc/front/library_file.h"
#include "control/plc/front/reader.h"
#include "tests/unit/control/plc/front/compiled.h"

namespace indurop::plc {
namespace {

using testing::compiled;
using ::testing::HasSubstr;
using testing::messages;
using testing::wrong;

using Files = std::map<std::string, std::string>;

Compiled compiled_from(const Files& files, CompileOptions options) {
  options.name = "sut";
  return compile(options, [&](const std::string& name) {
    const auto found = files.find(name);
    return found == files.end() ? glb2idl::ReadResult{std::nullopt, name, "it is not there"}
                                : glb2idl::ReadResult{found->second, name, ""};
  });
}

std::string object(const std::string& inside) {
  return "\xEF\xBB\xBF<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<TcPlcObject Version=\"1.1.0.1\">\n" + inside +
         "\n</TcPlcObject>";
}

std::string code(const std::string& declaration, const std::string& statements) {
  return "<Declaration><![CDATA[" + declaration + "]]></Declaration><Implementation><ST><![CDATA[" + statements +
         "]]></ST></Implementation>";
}

Files twincat() {
  return {
      {"plant/plc.plcproj", R"(<Project><ItemGroup><Compile Include="POUs\MAIN.TcPOU"><SubType>Code</SubType></Compile>
<Compile Include="POUs\FB_Drive.TcPOU"/><Compile Include="ST_Set.TcDUT"/><Compile Include="GVL.TcGVL"/>
<Compile Include="I_Drive.TcIO"/><Compile Include="Fast.TcTTO"/><Compile Include="notes.txt"/></ItemGroup></Project>)"},
      {"plant/POUs/MAIN.TcPOU", object("<POU Name=\"MAIN\">" +
                                       code("PROGRAM MAIN\nVAR\n  drive : FB_Drive;\n  k : INT;\nEND_VAR",
                                            "drive(speed := GVL.wanted);\ndrive.Reset();\nk := drive.Twice;") +
                                       "</POU>")},
      {"plant/POUs/FB_Drive.TcPOU",
       object("<POU Name=\"FB_Drive\" SpecialFunc=\"None\">" +
              code("{attribute 'x'}\nFUNCTION_BLOCK FB_Drive IMPLEMENTS I_Drive\nVAR_INPUT\n  speed : INT;\nEND_VAR\n"
                   "VAR\n  set : ST_Set;\nEND_VAR",
                   "IF Start(speed) THEN\n  set.n := set.n + 1;\nEND_IF") +
              "<Folder Name=\"a\"/><Action Name=\"Reset\"><Implementation><ST><![CDATA[set.n := 0;]]></ST>"
              "</Implementation></Action><Method Name=\"Start\">" +
              code("METHOD PUBLIC Start : BOOL\nVAR_INPUT\n  v : INT;\nEND_VAR", "Start := v > 0;") +
              "</Method><Property Name=\"Twice\"><Declaration><![CDATA[PROPERTY Twice : INT]]></Declaration>"
              "<Get Name=\"Get\">" +
              code("VAR\nEND_VAR\n", "Twice := 2 * set.n;") + "</Get></Property></POU>")},
      {"plant/ST_Set.TcDUT",
       object("<DUT Name=\"ST_Set\"><Declaration><![CDATA[TYPE ST_Set :\nSTRUCT\n  n : INT;\nEND_STRUCT\nEND_TYPE]]>"
              "</Declaration></DUT>")},
      {"plant/GVL.TcGVL", object("<GVL Name=\"GVL\"><Declaration><![CDATA[{attribute 'qualified_only'}\nVAR_GLOBAL\n"
                                 "  wanted : INT := 3;\nEND_VAR]]></Declaration></GVL>")},
      {"plant/I_Drive.TcIO",
       object("<Itf Name=\"I_Drive\"><Declaration><![CDATA[INTERFACE I_Drive]]></Declaration><Method Name=\"Start\">"
              "<Declaration><![CDATA[METHOD Start : BOOL\nVAR_INPUT\n  v : INT;\nEND_VAR]]></Declaration></Method>"
              "</Itf>")},
      {"plant/Fast.TcTTO", object("<Task Name=\"Fast\"><CycleTime>2000</CycleTime><Priority>20</Priority><PouCall>"
                                  "<Name>MAIN</Name></PouCall></Task>")}};
}

// Bodies are translated when all files are read, whatever their order.
TEST(PlcFiles, What_charts_and_lists_name_may_stand_in_another_file) {
  const std::string valve =
      "FUNCTION_BLOCK Valve VAR_INPUT set : BOOL; END_VAR VAR_OUTPUT q : BOOL; END_VAR ACTION Open: q := TRUE; "
      "END_ACTION IF set THEN q := FALSE; END_IF; END_FUNCTION_BLOCK";
  const std::string chart =
      "PROGRAM Main VAR v : Valve; x : BOOL; END_VAR\nINITIAL_STEP A: v.Open(N); END_STEP STEP B: END_STEP\n"
      "TRANSITION FROM A TO B := x; END_TRANSITION TRANSITION FROM B TO A := v.q; END_TRANSITION END_PROGRAM";
  const std::string list =
      "PROGRAM Main VAR v : Valve; x : BOOL; END_VAR\nLD x\nset v\nLD v.q\nST x\nCAL v()\nEND_PROGRAM";
  for (const std::string& main : {chart, list}) {
    for (const std::vector<std::string>& order :
         {std::vector<std::string>{"valve.st", "main.st"}, std::vector<std::string>{"main.st", "valve.st"}}) {
      CompileOptions options;
      options.files = order;
      const Compiled sut = compiled_from({{"valve.st", valve}, {"main.st", main}}, options);
      EXPECT_TRUE(sut.ok) << order.front() << '\n' << messages(sut);
      EXPECT_THAT(messages(sut), ::testing::Not(HasSubstr("error")));
    }
  }
}

TEST(PlcFiles, A_project_of_TwinCAT_names_its_files) {
  CompileOptions options;
  options.files = {"plant/plc.plcproj"};
  const Compiled sut = compiled_from(twincat(), options);
  ASSERT_TRUE(sut.ok) << messages(sut);
  EXPECT_EQ(sut.modules.at(0).period_ns, 2'000'000);
  EXPECT_EQ(sut.dialect, Dialect::Codesys);
}

TEST(PlcFiles, A_project_of_TwinCAT_is_shown_as_it_is_written) {
  const Files files = twincat();
  const glb2idl::FileReader read = [&](const std::string& name) {
    return glb2idl::ReadResult{files.at(name), name, ""};
  };
  Diagnostics diagnostics;
  const plcopen::Document sut = read_document({"plant/plc.plcproj"}, {}, read, diagnostics);
  ASSERT_FALSE(diagnostics.failed()) << base::to_text(diagnostics.list(), "");
  ASSERT_EQ(sut.pous.size(), 3U);
  const plcopen::PouDocument& main = sut.pous.at(0);
  EXPECT_EQ(main.code.body.text, "drive(speed := GVL.wanted);\ndrive.Reset();\nk := drive.Twice;");
  const std::string& file = files.at("plant/POUs/MAIN.TcPOU");
  const auto begin = file.begin() + static_cast<std::ptrdiff_t>(file.find("drive(speed"));
  EXPECT_EQ(main.code.body.text_at.line, 1 + std::count(file.begin(), begin, '\n')) << "values are next to its lines";
  ASSERT_EQ(sut.pous.at(1).code.actions.size(), 1U);
  EXPECT_EQ(sut.pous.at(1).code.actions.at(0).name, "Reset");
  EXPECT_EQ(sut.pous.at(1).code.actions.at(0).body.text, "set.n := 0;");
}

TEST(PlcFiles, Errors_in_files_of_TwinCAT_have_their_line) {
  Files files = twincat();
  std::string& main = files.at("plant/POUs/MAIN.TcPOU");
  main.replace(main.find("drive.Reset"), 11, "drive.Rewind");
  CompileOptions options;
  options.files = {"plant/plc.plcproj"};
  EXPECT_THAT(messages(compiled_from(files, options)),
              HasSubstr("plant/POUs/MAIN.TcPOU:8:1: error: MAIN: FB_Drive has no method 'Rewind'"));
}

TEST(PlcFiles, What_is_drawn_in_TwinCAT_is_refused) {
  const std::string text = object(
      "<POU Name=\"P\"><Declaration><![CDATA[PROGRAM P]]></Declaration><Implementation><NWL/>"
      "</Implementation></POU>");
  EXPECT_THAT(wrong(text, "in.TcPOU"), HasSubstr("P is drawn in TwinCAT's own form"));
}

TEST(PlcFiles, A_library_is_used_with_its_version) {
  LibraryFile library;
  library.name = "motors";
  library.version = "1.2.0";
  library.sources = {{"motor.st", "FUNCTION Twice : INT VAR_INPUT x : INT; END_VAR Twice := 2 * x; END_FUNCTION\n"}};
  const Files files{{"main.st", "PROGRAM Main VAR k : INT; END_VAR k := Twice(k); END_PROGRAM"},
                    {"motors-1.2.0.plclib", to_text(library)},
                    {"other.plclib", "nothing"}};
  CompileOptions options;
  options.files = {"main.st"};
  for (const char* fine : {"motors-1.2.0.plclib", "motors-1.2.0.plclib@1", "motors-1.2.0.plclib@1.1.7"}) {
    options.libraries = {fine};
    const Compiled sut = compiled_from(files, options);
    EXPECT_TRUE(sut.ok) << messages(sut);
  }
  for (const auto& [choice, text] :
       {std::pair("motors-1.2.0.plclib@1.3", "this is motors 1.2.0, and 1.3 is wanted"),
        std::pair("motors-1.2.0.plclib@2", "this is motors 1.2.0, and 2 is wanted"),
        std::pair("other.plclib", "this is no library"), std::pair("missing.plclib", "cannot read the file")}) {
    options.libraries = {choice};
    EXPECT_THAT(messages(compiled_from(files, options)), HasSubstr(text));
  }
  options.libraries = {"motors-1.2.0.plclib", "motors-1.2.0.plclib"};
  EXPECT_THAT(messages(compiled_from(files, options)), HasSubstr("the library motors is given twice"));
}

TEST(PlcFiles, A_damaged_library_is_refused) {
  LibraryFile library;
  library.name = "motors";
  library.version = "1.2.0";
  library.sources = {{"a.st", "FUNCTION A : INT A := 1; END_FUNCTION\n"}, {"b.st", "\n\n"}};
  const std::string text = to_text(library);
  const auto back = read_library(text);
  ASSERT_TRUE(back) << back.error().text;
  EXPECT_EQ(to_text(*back), text);
  for (std::size_t length = 0; length + 1 < text.size(); ++length) {
    const auto cut = read_library(std::string_view(text).substr(0, length));
    EXPECT_TRUE(!cut || cut->sources.size() < 2) << length;
  }
  EXPECT_FALSE(is_version("1..2"));
  EXPECT_FALSE(is_version("1.2.3.4"));
  EXPECT_FALSE(is_version(""));
}

TEST(PlcFiles, LOGGER_and_the_types_of_SVGHMI_are_built_in) {
  const Compiled sut = compiled(R"(PROGRAM Main
VAR log : LOGGER; level : LOGLEVEL := WARNING; count : HMI_INT; name : HMI_STRING; END_VAR
  count := count + 1;
  log(TRIG := count > 3, MSG := 'many', LEVEL := level);
  log(TRIG := FALSE, MSG := name);
END_PROGRAM
)");
  ASSERT_TRUE(sut.ok) << messages(sut);
  EXPECT_THAT(sut.modules.at(0).cpp, HasSubstr("iec::log_message("));
}

TEST(PlcFiles, C_code_that_gives_the_time_is_compiled) {
  const Compiled sut = compiled(R"(FUNCTION T_MS : UDINT
VAR tx : UDINT; END_VAR
  tx := 0;
{extern unsigned long __tick;
extern unsigned long long common_ticktime__;
unsigned long long ticktime_ms = (common_ticktime__)/1000000;
UDINT plc_time = (UDINT)(ticktime_ms * (unsigned long long)__tick);
TX = plc_time}
  T_MS := tx;
END_FUNCTION
PROGRAM Main VAR k : UDINT; END_VAR k := T_MS(); END_PROGRAM
)");
  ASSERT_TRUE(sut.ok) << messages(sut);
  EXPECT_THAT(sut.modules.at(0).cpp, HasSubstr("tx = iec::ticks<std::uint32_t, iec::kMillisecond>();"));
}

TEST(PlcFiles, Other_C_code_is_left_out_and_named_where_it_is_missed) {
  const std::string block =
      "FUNCTION_BLOCK Eval\nVAR x : INT; END_VAR\n{extern void go(int); go(1);}\nx := 1;\n"
      "END_FUNCTION_BLOCK\n";
  EXPECT_THAT(messages(compiled(block + "PROGRAM Main VAR k : INT; END_VAR k := 1; END_PROGRAM")),
              HasSubstr("in.st:3:1: warning: Eval is left out, because C code in { } is not supported"));
  EXPECT_THAT(wrong(block + "PROGRAM Main VAR e : Eval; END_VAR e(); END_PROGRAM"),
              HasSubstr("it was left out because of C code, see in.st:3:1"));
}

TEST(PlcFiles, What_needs_C_code_is_left_out_too) {
  const std::string blocks =
      "FUNCTION_BLOCK Eval\nVAR x : INT; END_VAR\n{extern void go(int); go(1);}\nEND_FUNCTION_BLOCK\n"
      "FUNCTION_BLOCK Gear\nVAR e : ARRAY[1..2] OF Eval; END_VAR\ne[1]();\nEND_FUNCTION_BLOCK\n";
  const Compiled sut = compiled(blocks + "PROGRAM Main VAR k : INT; END_VAR k := 1; END_PROGRAM");
  EXPECT_TRUE(sut.ok);
  EXPECT_THAT(messages(sut), HasSubstr("in.st:6:5: warning: Gear is left out too"));
  EXPECT_THAT(wrong(blocks + "PROGRAM Main VAR g : Gear; END_VAR g(); END_PROGRAM"),
              HasSubstr("left out because of C code, see in.st:6:5"));
}

TEST(PlcFiles, Methods_and_properties_of_CODESYS_exports_are_read) {
  const std::string text = R"(<?xml version="1.0" encoding="utf-8"?>
<project xmlns="http://www.plcopen.org/xml/tc6_0200"><types><dataTypes>
<dataType name="Base"><baseType><struct><variable name="a"><type><INT/></type></variable></struct></baseType></dataType>
<dataType name="Wide"><baseType><struct><variable name="b"><type><INT/></type></variable></struct></baseType><addData>
<data name="http://www.3s-software.com/plcopenxml/datatypeinheritance"><Inheritance><Extends>Base</Extends></Inheritance>
</data></addData></dataType></dataTypes><pous>
<pou name="Drive" pouType="functionBlock"><interface><localVars><variable name="n"><type><INT/></type></variable>
</localVars><addData><data name="http://www.3s-software.com/plcopenxml/pouinheritance"><Inheritance>
<Implements>I_Go</Implements></Inheritance></data></addData></interface><body><ST><xhtml/></ST></body><addData>
<data name="http://www.3s-software.com/plcopenxml/method"><Method name="Go"><interface><returnType><BOOL/></returnType>
<inputVars><variable name="amount"><type><INT/></type></variable></inputVars></interface><body><ST>
<xhtml xmlns="http://www.w3.org/1999/xhtml">n := n + amount; Go := n &gt; 3;</xhtml></ST></body></Method></data>
<data name="http://www.3s-software.com/plcopenxml/property"><Property name="Count"><interface><Attributes><Attribute Name="monitoring" Value="call"/></Attributes><returnType><INT/>
</returnType></interface><GetAccessor><interface/><body><ST><xhtml>Count := n;</xhtml></ST></body></GetAccessor>
<SetAccessor><interface/><body><ST><xhtml>n := Count;</xhtml></ST></body></SetAccessor></Property></data>
</addData></pou>
<pou name="Main" pouType="program"><interface><localVars><variable name="d"><type><derived name="Drive"/></type></variable>
<variable name="i"><type><derived name="I_Go"/></type></variable>
<variable name="w"><type><derived name="Wide"/></type></variable></localVars></interface><body><ST>
<xhtml>i := d; IF i.Go(amount := w.a) THEN d.Count := d.Count + w.b; END_IF</xhtml></ST></body></pou></pous></types>
<instances><configurations/></instances><addData>
<data name="http://www.3s-software.com/plcopenxml/interface"><Interface name="I_Go"><Methods><Method name="Go"><interface>
<returnType><BOOL/></returnType><inputVars><variable name="amount"><type><INT/></type></variable></inputVars></interface>
</Method></Methods></Interface></data></addData></project>)";
  const Compiled sut = compiled(text, "in.xml");
  ASSERT_TRUE(sut.ok) << messages(sut);
  EXPECT_THAT(sut.modules.at(0).cpp, HasSubstr("Drive::setter_COUNT("));
}

}  // namespace
}  // namespace indurop::plc
