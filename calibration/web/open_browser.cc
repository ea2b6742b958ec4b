// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/web/open_browser.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <system_error>
#include <vector>

#include "calibration/program/child_process.h"
#include "calibration/program/html_text.h"

namespace insitu {
namespace {

bool IsSet(const char* variable) {
  const char* const value = std::getenv(variable);
  return value && *value;
}

std::string LeadingPage(const std::string& url) {
  const std::string address = HtmlText(url);
  return "<!DOCTYPE html>\n<meta charset=\"utf-8\">\n<meta name=\"referrer\" "
         "content=\"no-referrer\">\n<meta http-equiv=\"refresh\" content=\"0; url=" +
         address + "\">\n<title>insitu</title>\n<a href=\"" + address + "\">insitu</a>\n";
}

// Empty: cannot be written. mkstemps makes it readable by its owner only.
std::filesystem::path WritePrivately(const std::string& text) {
  std::error_code error;
  const std::filesystem::path folder = IsSet("XDG_RUNTIME_DIR")
                                           ? std::filesystem::path(std::getenv("XDG_RUNTIME_DIR"))
                                           : std::filesystem::temp_directory_path(error);
  std::string name = (folder / "insitu-XXXXXX.html").string();
  const int file = mkstemps(name.data(), 5);
  if (file < 0) return {};
  const bool is_written =
      write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  close(file);
  if (is_written) return name;
  std::filesystem::remove(name, error);
  return {};
}

// In a group of its own, so that Ctrl+C ends us and not the browser. 0: cannot be run.
pid_t StartSilently(std::vector<std::string> command) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    posix_spawn_file_actions_addopen(&actions, descriptor, "/dev/null", O_RDWR, 0);
  }
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t none, all;
  sigemptyset(&none);
  sigfillset(&all);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setsigdefault(&attributes, &all);
  posix_spawnattr_setpgroup(&attributes, 0);
  posix_spawnattr_setflags(&attributes,
                           POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  pid_t process = 0;
  const int failure = posix_spawnp(&process, command[0].c_str(), &actions, &attributes,
                                   Pointers(command).data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  return failure == 0 ? process : 0;
}

}  // namespace

OpenedPage::OpenedPage(const std::string& url) {
  if (!IsSet("DISPLAY") && !IsSet("WAYLAND_DISPLAY")) return;
  file_ = WritePrivately(LeadingPage(url));
  if (!file_.empty()) opener_ = StartSilently({"xdg-open", file_.string()});
}

OpenedPage::~OpenedPage() {
  std::error_code error;
  if (!file_.empty()) std::filesystem::remove(file_, error);
  if (opener_ > 0) waitpid(opener_, nullptr, WNOHANG);
}

}  // namespace insitu
