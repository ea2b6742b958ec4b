// SPDX-License-Identifier: GPL-3.0-or-later
// How far the jobs of a batch are: a line each that has ended, and on a terminal below them those
// that run and a count.
#pragma once

#include <map>
#include <mutex>
#include <string>
#include <vector>

namespace insitu {

// Thread-safe.
class ProgressTable {
 public:
  // `names` of all jobs, in their order.
  explicit ProgressTable(std::vector<std::string> names);

  void Run(size_t job, const std::string& how_far);  // shown on a terminal only
  void End(size_t job, const std::string& how, bool is_failed);

 private:
  std::string Row(size_t job, const std::string& text) const;
  void Erase();  // the lines below
  void Draw();

  const std::vector<std::string> names_;
  size_t width_ = 0;
  const bool on_terminal_;
  std::mutex mutex_;
  std::map<size_t, std::string> running_;
  size_t ended_ = 0, failed_ = 0, drawn_ = 0;  // drawn: lines below
};

}  // namespace insitu
