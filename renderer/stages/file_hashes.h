// SPDX-License-Identifier: GPL-3.0-or-later
// Hashes of a site's files, of which those that did not change need not be read again.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <string>

namespace insitu {

// Thread-safe. What the file system tells of a file (size, times, inode) only decides whether it is
// read again, as in git's index: never on a file that changed within two seconds of being read,
// since file systems' clocks are coarse.
class FileHashes {
 public:
  // Reads the hashes that an earlier run kept in `store`; whatever is wrong with it, it is left
  // aside.
  explicit FileHashes(std::filesystem::path store);

  // SHA-256, hexadecimal; "" where there is no such file. Throws InputError if it cannot be read.
  std::string Hash(const std::filesystem::path& path);

  void Save() const;

 private:
  struct Entry {
    int64_t size = 0, inode = 0, modified_ns = 0, changed_ns = 0, read_ns = 0;
    std::string hash;
  };
  static bool IsSame(const Entry& kept, const Entry& now);

  const std::filesystem::path store_;
  mutable std::mutex mutex_;
  std::map<std::string, Entry> entries_;  // by absolute path
};

}  // namespace insitu
