// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/program/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <stdexcept>
#include <string_view>

#include "calibration/files/error.h"

namespace insitu {
namespace {

constexpr int kMostChildren = 64;
constexpr int kCannotBeRun = 127;
constexpr std::array kForwarded = {SIGINT, SIGTERM, SIGHUP};

// Written by the threads, read by the signal handler: 0 is a free place.
std::array<std::atomic<pid_t>, kMostChildren> running_children;
std::atomic<int> received_signal = 0;

void ForwardSignal(int signal) {
  received_signal = signal;
  for (const std::atomic<pid_t>& child : running_children) {
    if (const pid_t process = child) kill(-process, signal);
  }
}

// While it lives the signals that are forwarded wait, so that none falls between a child's birth
// and its registration, or on our handler in a child that is no program of its own yet.
class SignalsWait {
 public:
  SignalsWait() {
    sigset_t forwarded;
    sigemptyset(&forwarded);
    for (const int signal : kForwarded) sigaddset(&forwarded, signal);
    pthread_sigmask(SIG_BLOCK, &forwarded, &before_);
  }
  ~SignalsWait() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  SignalsWait(const SignalsWait&) = delete;
  SignalsWait& operator=(const SignalsWait&) = delete;
  const sigset_t& before() const { return before_; }

 private:
  sigset_t before_;
};

// A child's place among those that signals are forwarded to.
class Registration {
 public:
  explicit Registration(pid_t child) {
    for (place_ = 0; place_ < kMostChildren; ++place_) {
      pid_t free_place = 0;
      if (running_children[place_].compare_exchange_strong(free_place, child)) break;
    }
    INSITU_CHECK(place_ < kMostChildren);
    if (received_signal != 0) kill(-child, received_signal);  // another thread took it meanwhile
  }
  ~Registration() { running_children[place_] = 0; }
  Registration(const Registration&) = delete;
  Registration& operator=(const Registration&) = delete;

 private:
  int place_ = 0;
};

// The reading end of a pipe, and the line that has not ended yet.
class LineReader {
 public:
  explicit LineReader(const std::function<void(const std::string&)>& on_line) : on_line_(on_line) {
    std::array<int, 2> ends = {-1, -1};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe can be made");
    read_end_ = ends[0];
    write_end_ = ends[1];
  }
  ~LineReader() {
    CloseWriteEnd();
    close(read_end_);
  }
  LineReader(const LineReader&) = delete;
  LineReader& operator=(const LineReader&) = delete;

  int read_end() const { return read_end_; }
  int write_end() const { return write_end_; }
  void CloseWriteEnd() {
    if (write_end_ >= 0) close(write_end_);
    write_end_ = -1;
  }

  // False at the end of the stream.
  bool Read() {
    std::array<char, 4096> bytes;
    const ssize_t count = read(read_end_, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) return true;
    if (count <= 0) {
      if (!line_.empty()) on_line_(line_);
      return false;
    }
    for (const char byte : std::string_view(bytes.data(), static_cast<size_t>(count))) {
      if (byte != '\n') {
        line_ += byte;
        continue;
      }
      on_line_(line_);
      line_.clear();
    }
    return true;
  }

 private:
  const std::function<void(const std::string&)>& on_line_;
  int read_end_ = -1, write_end_ = -1;
  std::string line_;
};

std::vector<std::string> EnvironmentWith(std::vector<std::string> additions) {
  for (char** entry = environ; *entry; ++entry) additions.emplace_back(*entry);
  return additions;  // of two settings the first one counts
}

void Unblock(int signal) {
  sigset_t one;
  sigemptyset(&one);
  sigaddset(&one, signal);
  sigprocmask(SIG_UNBLOCK, &one, nullptr);
}

// What the child does between fork and exec: only what is safe when other threads were running.
[[noreturn]] void BecomeProgram(pid_t parent, int out, int err, char* const* arguments,
                                char* const* environment, const sigset_t& mask) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(kCannotBeRun);
  for (const int signal : kForwarded) ::signal(signal, SIG_DFL);
  sigprocmask(SIG_SETMASK, &mask, nullptr);
  for (const int signal : kForwarded) Unblock(signal);  // our own threads may wait for them
  const int nothing = open("/dev/null", O_RDONLY);
  dup2(nothing, STDIN_FILENO);
  dup2(out, STDOUT_FILENO);
  dup2(err, STDERR_FILENO);
  execve(arguments[0], arguments, environment);
  _exit(kCannotBeRun);
}

void ReadToTheEnd(LineReader& out, LineReader& err) {
  std::array<pollfd, 2> ends = {pollfd{out.read_end(), POLLIN, 0},
                                pollfd{err.read_end(), POLLIN, 0}};
  const std::array<LineReader*, 2> readers = {&out, &err};
  while (ends[0].fd >= 0 || ends[1].fd >= 0) {
    if (poll(ends.data(), ends.size(), -1) < 0 && errno != EINTR) return;
    for (size_t i = 0; i < ends.size(); ++i) {
      if (ends[i].fd >= 0 && ends[i].revents != 0 && !readers[i]->Read()) ends[i].fd = -1;
    }
  }
}

int WaitFor(pid_t process) {
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

std::vector<char*> Pointers(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  pointers.reserve(texts.size() + 1);
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

int RunChild(const ChildProcess& child) {
  INSITU_CHECK(!child.command.empty());
  if (const std::optional<int> signal = ReceivedSignal()) return 128 + *signal;
  std::vector<std::string> command = child.command;
  std::vector<std::string> environment = EnvironmentWith(child.environment);
  const std::vector<char*> arguments = Pointers(command);
  const std::vector<char*> variables = Pointers(environment);
  LineReader out(child.on_output), err(child.on_error);
  const pid_t parent = getpid();
  std::optional<SignalsWait> signals_wait(std::in_place);
  const pid_t process = fork();
  if (process < 0) throw std::runtime_error(command[0] + ": no process can be made");
  if (process == 0) {
    BecomeProgram(parent, out.write_end(), err.write_end(), arguments.data(), variables.data(),
                  signals_wait->before());
  }
  setpgid(process, process);  // whichever of the two comes first
  out.CloseWriteEnd();
  err.CloseWriteEnd();
  const Registration registration(process);
  signals_wait.reset();
  const std::stop_callback on_stop(child.stop, [&] { kill(-process, SIGTERM); });
  ReadToTheEnd(out, err);
  return WaitFor(process);
}

void ForwardSignalsToChildren() {
  struct sigaction action = {};
  action.sa_handler = ForwardSignal;
  action.sa_flags = SA_RESTART;
  for (const int signal : kForwarded) sigaction(signal, &action, nullptr);
}

std::optional<int> ReceivedSignal() {
  const int signal = received_signal;
  return signal == 0 ? std::nullopt : std::optional(signal);
}

}  // namespace insitu
