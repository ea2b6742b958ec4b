// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/program/external_program.h"

#include "calibration/files/whole_file.h"
#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

ExternalProgram Shell(const ScratchFolder& folder, const std::string& script) {
  return {.command = {"sh", "-c", script},
          .package = "dash",
          .folder = folder.path(),
          .output = folder.path() / "out",
          .log = folder.path() / "log"};
}

TEST(ExternalProgram, RunsInItsFolderAndKeepsBothStreams) {
  const ScratchFolder folder;
  RunExternal(Shell(folder, "pwd; echo warned >&2; echo $OMP_NUM_THREADS"));
  EXPECT_EQ(ReadWhole(folder.path() / "out"), folder.path().string() + "\n1\n");
  EXPECT_EQ(ReadWhole(folder.path() / "log"), "warned\n");
}

TEST(ExternalProgram, ArgumentsMeetNoShell) {
  const ScratchFolder folder;
  ExternalProgram program = Shell(folder, "");
  program.command = {"printf", "%s", "$HOME * ; `id`"};
  RunExternal(program);
  EXPECT_EQ(ReadWhole(folder.path() / "out"), "$HOME * ; `id`");
}

TEST(ExternalProgram, BothStreamsMayShareOneFile) {
  const ScratchFolder folder;
  ExternalProgram program = Shell(folder, "echo one; echo two >&2; echo three");
  program.output = program.log;
  RunExternal(program);
  EXPECT_EQ(ReadWhole(folder.path() / "log"), "one\ntwo\nthree\n");
}

TEST(ExternalProgram, TellsThatItIsRunning) {
  const ScratchFolder folder;
  int calls = 0;
  ExternalProgram program = Shell(folder, "sleep 0.3; exit 3");
  program.while_running = [&] { ++calls; };
  EXPECT_NE(InputErrorOf([&] { RunExternal(program); }).find("status 3"), std::string::npos);
  EXPECT_GE(calls, 2);
}

TEST(ExternalProgram, FailureNamesTheLogAndItsLastLine) {
  const ScratchFolder folder;
  const auto program = Shell(folder, "echo first >&2; echo too few boards >&2; echo >&2; exit 3");
  EXPECT_EQ(InputErrorOf([&] { RunExternal(program); }),
            program.log.string() + ": the program failed with status 3: too few boards");
}

TEST(ExternalProgram, DeathBySignalIsAFailure) {
  const ScratchFolder folder;
  EXPECT_NE(InputErrorOf([&] { RunExternal(Shell(folder, "kill -9 $$")); }).find("status 137"),
            std::string::npos);
}

TEST(ExternalProgram, MissingProgramNamesItsPackage) {
  const ScratchFolder folder;
  ExternalProgram program = Shell(folder, "");
  program.command = {"insitu-not-there"};
  EXPECT_EQ(InputErrorOf([&] { RunExternal(program); }),
            "insitu-not-there: cannot be run, expected the Debian package dash");
}

}  // namespace
}  // namespace insitu
