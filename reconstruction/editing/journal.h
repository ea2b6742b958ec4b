// SPDX-License-Identifier: GPL-3.0-or-later
// What was done, an entry a line, on disk before anybody is told that it is done.
#pragma once

#include <json/value.h>
#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <vector>

#include "calibration/files/sentence.h"

namespace insitu {

class Journal {
 public:
  // Makes the file and its folder where they are missing. A last line that a power failure tore is
  // cut off. Throws InputError: cannot be read or written, a line before the last is no entry.
  explicit Journal(std::filesystem::path path);
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  // What stood in the file when it was opened, in order.
  const std::vector<Json::Value>& entries() const { return entries_; }

  // What was cut off, for people; nullopt: nothing.
  const std::optional<Sentence>& remark() const { return remark_; }

  // On return the entry is on disk. Throws InputError: it is not, and the file is as it was.
  void Append(const Json::Value& entry);

  // Puts these in the place of all entries: whoever is killed meanwhile leaves the old ones or the
  // new ones, whole. Throws InputError: the file is as it was.
  void Replace(const std::vector<Json::Value>& entries);

 private:
  void Read();
  void SyncName();

  std::filesystem::path path_;
  int descriptor_ = -1;
  off_t size_ = 0;
  bool is_name_on_disk_ = true;  // else a power failure would bring back what was replaced
  std::vector<Json::Value> entries_;
  std::optional<Sentence> remark_;
};

// Puts a file or folder on disk, names and all. Throws InputError.
void SyncToDisk(const std::filesystem::path& path);

}  // namespace insitu
