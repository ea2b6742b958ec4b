// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/program/program_options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace insitu {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// Its status, nullopt where the program goes on, and what it printed.
struct Parsed {
  std::optional<int> status;
  std::string out, err;
};

Parsed Parse(ProgramOptions* program, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "insitu-nothing");
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  Parsed parsed{program->Parse(static_cast<int>(argv.size()), argv.data()), "", ""};
  parsed.out = testing::internal::GetCapturedStdout();
  parsed.err = testing::internal::GetCapturedStderr();
  return parsed;
}

ProgramOptions Nothing() { return {"does nothing", "insitu-nothing"}; }

TEST(ProgramOptions, ValuesOfEveryKind) {
  ProgramOptions program = Nothing();
  int count = 1, unset = 7;
  double sigma = 1;
  std::optional<double> most;
  std::optional<int> none;
  std::vector<std::string> photos;
  std::set<std::string> points;
  bool is_hard = false, searches = true;
  program.Value("--count", &count, "");
  program.Value("--unset", &unset, "");
  program.Value("--sigma", &sigma, "");
  program.Value("--most", &most, "");
  program.Value("--none", &none, "");
  program.Value("--photo", &photos, "");
  program.Value("--check", &points, "");
  program.Flag("--hard", &is_hard, "");
  program.Flag("!--no-search", &searches, "");
  const Parsed parsed =
      Parse(&program, {"--count", "3", "--sigma=0.5", "--most", "2", "--photo", "b", "--photo", "a",
                       "--check", "p2", "--check", "p1", "--hard", "--no-search"});
  EXPECT_EQ(parsed.status, std::nullopt) << parsed.err;
  EXPECT_EQ(count, 3);
  EXPECT_EQ(unset, 7);
  EXPECT_EQ(sigma, 0.5);
  EXPECT_EQ(most, 2.0);
  EXPECT_EQ(none, std::nullopt);
  EXPECT_THAT(photos, ElementsAre("b", "a"));
  EXPECT_THAT(points, ElementsAre("p1", "p2"));
  EXPECT_TRUE(is_hard);
  EXPECT_FALSE(searches);
}

// What is refused, each by one line with the option's name and status 2.
TEST(ProgramOptions, RulesAreKept) {
  const auto refused = [](const OptionRules& rules, const std::string& text) {
    ProgramOptions program = Nothing();
    double value = 0;
    program.Value("--value", &value, "", rules);
    const Parsed parsed = Parse(&program, {"--value", text});
    EXPECT_EQ(parsed.status.value_or(0) == 2, !parsed.err.empty());
    if (parsed.status) {
      EXPECT_THAT(parsed.err, HasSubstr("--value"));
    }
    return parsed.status == 2;
  };
  EXPECT_TRUE(refused({}, "much"));
  EXPECT_TRUE(refused({.check = OptionCheck::kPositive}, "0"));
  EXPECT_FALSE(refused({.check = OptionCheck::kNonNegative}, "0"));
  EXPECT_TRUE(refused({.check = OptionCheck::kNonNegative}, "-1"));
  EXPECT_TRUE(refused({.range = {{0, 0.5}}}, "0.51"));
  EXPECT_FALSE(refused({.range = {{0, 0.5}}}, "0.5"));
  EXPECT_TRUE(refused({.one_of = {"4", "8"}}, "5"));
  EXPECT_FALSE(refused({.one_of = {"4", "8"}}, "8"));
  EXPECT_TRUE(refused({.fault = [](const std::string&) { return "is odd"; }}, "3"));
  EXPECT_TRUE(refused({.check = OptionCheck::kFile}, testing::TempDir()));
}

TEST(ProgramOptions, SiteIsAFolderThatIsThere) {
  const auto parse = [](std::vector<std::string> arguments, std::filesystem::path* root) {
    ProgramOptions program = Nothing();
    SitePaths site;
    program.Site(&site);
    const Parsed parsed = Parse(&program, std::move(arguments));
    *root = site.root;
    return parsed;
  };
  const std::filesystem::path folder = testing::TempDir();
  std::filesystem::path root;
  EXPECT_EQ(parse({folder.string()}, &root).status, std::nullopt);
  EXPECT_EQ(root, folder);
  EXPECT_EQ(parse({(folder / "no_such_site").string()}, &root).status, 2);
  EXPECT_EQ(parse({}, &root).err, "insitu-nothing: SITE is required (see --help)\n");
}

TEST(ProgramOptions, SomeExcludeEachOther) {
  ProgramOptions program = Nothing();
  int bounces = 0;
  bool is_paper = false;
  program.Value("--bounces", &bounces, "");
  program.Flag("--paper", &is_paper, "", "--bounces");
  EXPECT_EQ(Parse(&program, {"--paper", "--bounces", "2"}).status, 2);
}

TEST(ProgramOptions, HelpTellsDefaultsAndList) {
  const auto program = [] {
    static double sigma = 0.25;
    static bool is_hard = false;
    ProgramOptions options = Nothing();
    options.Value("--sigma", &sigma, "of marks", {.shows_default = true});
    options.Flag("--hard", &is_hard, "planes");
    return options;
  };
  ProgramOptions helping = program(), listing = program();
  const Parsed help = Parse(&helping, {"--help"});
  EXPECT_EQ(help.status, 0);
  EXPECT_THAT(help.out, HasSubstr("--sigma FLOAT=0.25"));
  const Parsed list = Parse(&listing, {kListOptions});
  EXPECT_EQ(list.status, 0);
  EXPECT_EQ(list.out, "--help\n--sigma VALUE\n--hard\n--version\n");
}

TEST(ProgramOptions, CommandLineSaysWhatWasAskedForWithoutFolders) {
  ProgramOptions program = Nothing();
  std::string site, start;
  double sigma = 1, unused = 2;
  bool is_hard = false;
  program.Value("SITE", &site, "", {.is_required = true});
  program.Value("--sigma", &sigma, "");
  program.Value("--unused", &unused, "");
  program.Value("--start", &start, "");
  program.Flag("--hard", &is_hard, "");
  Parse(&program, {"/home/me/site", "--sigma", "0.5", "--hard", "--start", "/home/me/start.json"});
  EXPECT_EQ(program.CommandLine(), "insitu-nothing SITE --sigma 0.5 --start start.json --hard");
}

}  // namespace
}  // namespace insitu
