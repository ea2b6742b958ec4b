// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/web/open_browser.h"

#include <sys/stat.h>

#include <chrono>
#include <cstdlib>
#include <thread>

#include "calibration/files/whole_file.h"
#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

constexpr char kUrl[] = "http://127.0.0.1:8080/#token=0123&name=\"<x>\"";

// A machine whose xdg-open writes down what it is given.
class OpenBrowser : public testing::Test {
 protected:
  OpenBrowser() {
    const auto opener = folder_.Write("bin/xdg-open",
                                      "#!/bin/sh\nprintf '%s|' \"$@\" >\"$0.part\"\n"
                                      "mv \"$0.part\" \"$0.arguments\"\n");
    std::filesystem::permissions(opener, std::filesystem::perms::owner_all);
    arguments_ = opener.string() + ".arguments";
    std::filesystem::create_directories(folder_.path() / "runtime");
    setenv("PATH", (folder_.path() / "bin").string().append(":/usr/bin:/bin").c_str(), 1);
    setenv("XDG_RUNTIME_DIR", (folder_.path() / "runtime").c_str(), 1);
    setenv("DISPLAY", ":0", 1);
    unsetenv("WAYLAND_DISPLAY");
  }

  std::string Arguments() const {
    for (int i = 0; i < 500 && !std::filesystem::exists(arguments_); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return ReadWhole(arguments_);
  }

  bool HasFiles() const { return !std::filesystem::is_empty(folder_.path() / "runtime"); }

  ScratchFolder folder_;
  std::filesystem::path arguments_;
};

TEST_F(OpenBrowser, GivesAPrivateFileInsteadOfTheAddress) {
  {
    const OpenedPage page(kUrl);
    ASSERT_TRUE(page.is_opened());
    std::string file = Arguments();
    ASSERT_EQ(file.back(), '|');
    file.pop_back();
    EXPECT_EQ(file.find("0123"), std::string::npos);
    EXPECT_EQ(std::filesystem::path(file).parent_path(), folder_.path() / "runtime");
    EXPECT_TRUE(file.ends_with(".html"));
    struct stat status = {};
    ASSERT_EQ(stat(file.c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777, 0600u);
    EXPECT_NE(ReadWhole(file).find("content=\"0; url=http://127.0.0.1:8080/#token=0123&amp;name="
                                   "&quot;&lt;x&gt;&quot;\""),
              std::string::npos);
  }
  EXPECT_FALSE(HasFiles());
}

TEST_F(OpenBrowser, DoesNothingWithoutADisplay) {
  unsetenv("DISPLAY");
  const OpenedPage page(kUrl);
  EXPECT_FALSE(page.is_opened());
  EXPECT_FALSE(HasFiles());
}

TEST_F(OpenBrowser, DoesWithoutXdgOpen) {
  setenv("PATH", (folder_.path() / "runtime").c_str(), 1);
  EXPECT_FALSE(OpenedPage(kUrl).is_opened());
  EXPECT_FALSE(HasFiles());
}

TEST_F(OpenBrowser, DoesWithoutAFolderToWriteIn) {
  setenv("XDG_RUNTIME_DIR", (folder_.path() / "missing").c_str(), 1);
  EXPECT_FALSE(OpenedPage(kUrl).is_opened());
}

}  // namespace
}  // namespace insitu
