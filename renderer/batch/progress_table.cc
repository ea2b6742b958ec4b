// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/batch/progress_table.h"

#include <unistd.h>

#include <algorithm>
#include <iostream>

namespace insitu {
namespace {

constexpr size_t kWidestName = 48;

}  // namespace

ProgressTable::ProgressTable(std::vector<std::string> names)
    : names_(std::move(names)), on_terminal_(isatty(STDOUT_FILENO) == 1) {
  for (const std::string& name : names_) width_ = std::max(width_, name.size());
  width_ = std::min(width_, kWidestName);
}

void ProgressTable::Run(size_t job, const std::string& how_far) {
  const std::lock_guard lock(mutex_);
  running_[job] = how_far;
  if (!on_terminal_) return;
  Erase();
  Draw();
}

void ProgressTable::End(size_t job, const std::string& how, bool is_failed) {
  const std::lock_guard lock(mutex_);
  running_.erase(job);
  ++ended_;
  failed_ += is_failed;
  Erase();
  std::cout << Row(job, how) << std::endl;
  Draw();
}

std::string ProgressTable::Row(size_t job, const std::string& text) const {
  const std::string count = std::to_string(names_.size());
  std::string number = std::to_string(job + 1);
  number.insert(0, count.size() - std::min(count.size(), number.size()), ' ');
  std::string name = names_[job];
  name.resize(std::max(name.size(), width_), ' ');
  return "[" + number + "/" + count + "] " + name + "  " + text;
}

void ProgressTable::Erase() {
  if (drawn_ > 0) std::cout << "\033[" << drawn_ << "F\033[J" << std::flush;
  drawn_ = 0;
}

void ProgressTable::Draw() {
  if (!on_terminal_ || ended_ == names_.size()) return;
  for (const auto& [job, how_far] : running_) std::cout << Row(job, how_far) << "\n";
  std::cout << ended_ << " of " << names_.size() << " done";
  if (failed_ > 0) std::cout << ", " << failed_ << " failed";
  std::cout << ", " << names_.size() - ended_ - running_.size() << " waiting\n" << std::flush;
  drawn_ = running_.size() + 1;
}

}  // namespace insitu
