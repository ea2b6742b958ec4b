// SPDX-License-Identifier: GPL-3.0-or-later
// Programs of this project as children of another: their output line by line, their end with ours.
#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace insitu {

struct ChildProcess {
  std::vector<std::string> command;      // path of the program, then its arguments
  std::vector<std::string> environment;  // NAME=VALUE, besides our own
  // Receive each line without its end, while the child runs.
  std::function<void(const std::string&line)> on_output, on_error;
  std::stop_token stop = {};  // ends the child and its group by SIGTERM
};

// Addresses of the texts, and null: how exec takes arguments and environment. The texts must stay.
std::vector<char*> Pointers(std::vector<std::string>& texts);

// Runs to the end, in a process group of its own and without standard input. The child's exit
// status, or 128 + N if signal N ended it; 127: it cannot be run. Of several threads each may run
// one.
int RunChild(const ChildProcess& child);

// From now on SIGINT, SIGTERM and SIGHUP end the groups of all children instead of this process,
// which learns it from ReceivedSignal. Children end with this process even when it is killed.
void ForwardSignalsToChildren();
std::optional<int> ReceivedSignal();

}  // namespace insitu
