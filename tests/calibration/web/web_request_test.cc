// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/web/web_request.h"

#include <gmock/gmock.h>

#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

TEST(ParseTarget, TellsPathAndQuery) {
  const auto request = ParseTarget("/api/tile?photo=3&level=0&name=a%20b+c%2fd&empty=&flag");
  ASSERT_TRUE(request);
  EXPECT_EQ(request->path, "/api/tile");
  EXPECT_EQ(request->query,
            (std::map<std::string, std::string>{
                {"photo", "3"}, {"level", "0"}, {"name", "a b c/d"}, {"empty", ""}, {"flag", ""}}));
  EXPECT_EQ(ParseTarget("/")->path, "/");
  EXPECT_TRUE(ParseTarget("/page/tile_view.js")->query.empty());
}

TEST(ParseTarget, RefusesWhatLeadsElsewhere) {
  for (const char* target : {"",
                             "*",
                             "page.js",
                             "/../etc/passwd",
                             "/page/../../x",
                             "/page/..",
                             "/./x",
                             "//evil.example/",
                             "/page//x",
                             "/%2e%2e/x",
                             "/page%00.js",
                             "/a\\b",
                             "/.git/config",
                             "http://evil.example/",
                             "/a b",
                             "/x?a=%",
                             "/x?a=%2",
                             "/x?a=%zz",
                             "/x?a=%00",
                             "/x?a=1&a=2",
                             "/caf\xc3\xa9"}) {
    EXPECT_FALSE(ParseTarget(target)) << target;
  }
}

TEST(QueryInteger, IsAWholeNumberOrAnError) {
  const WebRequest request = *ParseTarget("/api/tile?x=12&y=-3&z=1.5&w=99999999999&e=");
  EXPECT_EQ(QueryInteger(request, "x"), 12);
  EXPECT_EQ(QueryInteger(request, "y"), -3);
  for (const char* name : {"z", "w", "e", "missing"}) {
    EXPECT_NE(
        InputErrorOf([&] { QueryInteger(request, name); }).find(std::string("'") + name + "'"),
        std::string::npos);
  }
}

TEST(ErrorResponse, IsJson) {
  const WebResponse response = ErrorResponse(400, "a \"b\"\n");
  EXPECT_EQ(response.status, 400);
  EXPECT_EQ(response.type, "application/json");
  EXPECT_EQ(response.body, "{\"error\":\"a \\\"b\\\"\\n\"}");
}

TEST(ErrorResponse, NamesTheKeyByWhichPagesWordIt) {
  EXPECT_THAT(ErrorResponse(400, Sentence("cut", "{photo} is cut", {{"photo", "A"}})).body,
              testing::HasSubstr("\"key\":\"cut\""));
}

}  // namespace
}  // namespace insitu
