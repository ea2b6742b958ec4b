// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/files/csv_file.h"

#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

class CsvFile : public testing::Test {
 protected:
  std::vector<CsvRow> Read(const std::string& text) {
    return ReadCsv(folder_.Write("a.csv", text), {"name", "x"});
  }
  std::string ErrorOf(const std::string& text) {
    return InputErrorOf([&] {
      for (const CsvRow& row : Read(text)) row.Number("x");
    });
  }
  std::string At(int line) {
    return (folder_.path() / "a.csv").string() + ":" + std::to_string(line) + ": ";
  }
  ScratchFolder folder_;
};

TEST_F(CsvFile, ReadsWhatSpreadsheetsWrite) {
  const auto rows = Read("\xEF\xBB\xBFx, name ,note\r\n\r\n# remark\r\n 1.5 ,A 1,\r\n+2e3,B,b\r\n");
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].Text("name"), "A 1");
  EXPECT_EQ(rows[0].Number("x"), 1.5);
  EXPECT_EQ(rows[0].line, 4);
  EXPECT_EQ(rows[1].Number("x"), 2000);
  EXPECT_EQ(rows[1].Text("note"), "b");
}

TEST_F(CsvFile, NationalGridLosesNothing) {
  EXPECT_EQ(Read("name,x\nA,2600512.123456789\n")[0].Number("x"), 2600512.123456789);
}

TEST_F(CsvFile, NoRowsIsNoError) { EXPECT_TRUE(Read("name,x\n").empty()); }

TEST_F(CsvFile, BadNumbersNameTheLine) {
  for (const std::string text : {"1.5m", "nan", "inf", "1,5", "--1", "+-1", "1e999"}) {
    const std::string message = ErrorOf("name,x\nA,1\nB," + text + "\n");
    EXPECT_EQ(message.find(At(3)), 0u) << message;
  }
  EXPECT_EQ(ErrorOf("name,x\nA,1.5m\n"),
            At(2) + "\"1.5m\" in column \"x\", expected a finite number");
}

TEST_F(CsvFile, FaultsNameTheLine) {
  EXPECT_EQ(ErrorOf("name,x\nA\n"), At(2) + "1 cells, expected 2 (name,x)");
  EXPECT_EQ(ErrorOf("name,x\nA,1,2\n"), At(2) + "3 cells, expected 2 (name,x)");
  EXPECT_EQ(ErrorOf("name,x\nA, \n"), At(2) + "column \"x\" is empty");
  EXPECT_EQ(ErrorOf("# first\nname,y\n"),
            At(2) + "column \"x\" is missing, expected the header name,x");
  EXPECT_EQ(ErrorOf("name,x,x\n"), At(1) + "column \"x\" stands twice, expected the header name,x");
  EXPECT_EQ(InputErrorOf([&] { Read("name,x\nA,1\n")[0].Text("y"); }),
            At(2) + "column \"y\" is missing");
}

TEST_F(CsvFile, ReadsTablesOfEveryCountry) {
  for (const std::string text :
       {"\"name\",\"x\"\n\"A\",\"464999.762\"\n", "name;x\nA;464999,7620\n",
        "name\tx\nA\t464999,762\n", "sep=;\r\nname;x\r\nA;464999.762\r\n", "name,x\rA,464999.762\r",
        "name;x\nA;464'999.762\n", "name;x\nA;464.999,762\n", "name,x\nA,\"464,999.762\"\n",
        "name;x\nA;464 999,762\n", "name,x,,\nA,464999.762,,\n,,,\r\n",
        "name,x\nA,464999.762,,,\n"}) {
    const auto rows = Read(text);
    ASSERT_EQ(rows.size(), 1u) << text;
    EXPECT_EQ(rows[0].Text("name"), "A") << text;
    EXPECT_EQ(rows[0].Number("x"), 464999.762) << text;
  }
}

TEST_F(CsvFile, ReadsUtf16AndWindows1252) {
  const std::string utf8 =
      "name\tx\nS\xC3\xBC"
      "d\t1.5\n";
  std::string wide = "\xFF\xFE", wide_big = "\xFE\xFF",
              windows =
                  "name\tx\nS\xFC"
                  "d\t1.5\n";
  for (const char c : windows) {
    wide += {c, '\0'};
    wide_big += {'\0', c};
  }
  for (const std::string& text : {utf8, wide, wide_big, windows, wide.substr(2)}) {
    const auto rows = Read(text);
    ASSERT_EQ(rows.size(), 1u);
    EXPECT_EQ(rows[0].Text("name"),
              "S\xC3\xBC"
              "d");
    EXPECT_EQ(rows[0].Number("x"), 1.5);
  }
}

TEST_F(CsvFile, QuotedCellsHoldSeparatorsQuotesAndLineEnds) {
  const auto rows = Read("name,x\n\"a, \"\"b\"\"\nc\",1\n\"#5\",2\n# 3,x\n");
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].Text("name"), "a, \"b\"\nc");
  EXPECT_EQ(rows[1].Text("name"), "#5");
  EXPECT_EQ(rows[1].line, 4);
  EXPECT_EQ(ErrorOf("name,x\n\"a,1\n"), At(2) + "a quote \" is opened and never closed");
  EXPECT_NE(ErrorOf("name,x\n\"a\"b,1\n").find("more behind a cell in quotes"), std::string::npos);
}

// 1,234 alone may be either; its neighbours decide, and a contradiction is told.
TEST_F(CsvFile, ACommaIsWhatTheOtherNumbersMakeOfIt) {
  EXPECT_EQ(Read("name;x\nA;1,234\n")[0].Number("x"), 1.234);
  EXPECT_EQ(Read("name;x\nA;1,234\nB;12.5\n")[0].Number("x"), 1234);
  EXPECT_EQ(Read("name;x\nA;1.234\nB;12,5\n")[0].Number("x"), 1234);
  EXPECT_NE(ErrorOf("name;x\nA;1,5\nB;12.5\n").find("decimal commas"), std::string::npos);
}

TEST_F(CsvFile, EmptyOrMissing) {
  EXPECT_EQ(ErrorOf(""),
            (folder_.path() / "a.csv").string() + ": empty, expected the header name,x");
  EXPECT_EQ(InputErrorOf([] { ReadCsv("/nowhere/a.csv", {}); }), "/nowhere/a.csv: cannot be read");
}

}  // namespace
}  // namespace insitu
