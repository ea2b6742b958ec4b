// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/program/external_program.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <sstream>
#include <thread>

#include "calibration/files/error.h"
#include "calibration/files/whole_file.h"
#include "calibration/program/child_process.h"

namespace insitu {
namespace {

class FileActions {
 public:
  explicit FileActions(const ExternalProgram& program) {
    posix_spawn_file_actions_init(&actions_);
    Open(STDIN_FILENO, "/dev/null", O_RDONLY);
    Open(STDERR_FILENO, program.log, O_WRONLY | O_CREAT | O_TRUNC);
    if (program.output == program.log) {
      posix_spawn_file_actions_adddup2(&actions_, STDERR_FILENO, STDOUT_FILENO);
    } else {
      Open(STDOUT_FILENO, program.output, O_WRONLY | O_CREAT | O_TRUNC);
    }
    posix_spawn_file_actions_addchdir_np(&actions_, program.folder.c_str());
  }
  ~FileActions() { posix_spawn_file_actions_destroy(&actions_); }
  FileActions(const FileActions&) = delete;
  FileActions& operator=(const FileActions&) = delete;
  const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  void Open(int descriptor, const std::filesystem::path& path, int flags) {
    posix_spawn_file_actions_addopen(&actions_, descriptor, path.c_str(), flags, 0666);
  }
  posix_spawn_file_actions_t actions_;
};

std::vector<std::string> SingleThreadedEnvironment() {
  std::vector<std::string> environment = {"OPENBLAS_NUM_THREADS=1", "OMP_NUM_THREADS=1"};
  for (char** entry = environ; *entry; ++entry) {  // of two settings the first one counts
    environment.emplace_back(*entry);
  }
  return environment;
}

std::string LastLine(const std::filesystem::path& log) {
  std::istringstream stream(ReadWhole(log));
  std::string line, last;
  while (std::getline(stream, line)) {
    if (line.find_first_not_of(" \t") != std::string::npos) last = line;
  }
  return last;
}

// Nonzero if the program failed or died of a signal.
int PollUntilEnd(pid_t process, const std::function<void()>& while_running) {
  constexpr auto kPause = std::chrono::milliseconds(20);
  int status = 0;
  while (while_running && waitpid(process, &status, WNOHANG) == 0) {
    while_running();
    std::this_thread::sleep_for(kPause);
  }
  while (!while_running && waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

void RunExternal(const ExternalProgram& program) {
  INSITU_CHECK(!program.command.empty());
  std::vector<std::string> command = program.command;
  std::vector<std::string> environment = SingleThreadedEnvironment();
  const FileActions actions(program);
  pid_t process = 0;
  const int failure = posix_spawnp(&process, command[0].c_str(), actions.get(), nullptr,
                                   Pointers(command).data(), Pointers(environment).data());
  if (failure == ENOENT) {
    throw InputError(command[0], "cannot be run, expected the Debian package " + program.package);
  }
  if (failure != 0) throw InputError(command[0], "cannot be run");
  const int status = PollUntilEnd(process, program.while_running);
  if (status == 0) return;
  throw InputError(program.log, "the program failed with status " + std::to_string(status) + ": " +
                                    LastLine(program.log));
}

}  // namespace insitu
