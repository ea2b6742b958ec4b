// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/stages/file_states.h"

#include <algorithm>

namespace insitu {
namespace {

namespace fs = std::filesystem;

constexpr size_t kMostReasons = 4;

// The files that paths stand for, of folders all below them but hidden ones.
std::vector<fs::path> FilesOf(const std::vector<fs::path>& paths) {
  std::vector<fs::path> files;
  for (const fs::path& path : paths) {
    if (!fs::is_directory(path)) {
      files.push_back(path);
      continue;
    }
    for (const fs::directory_entry& entry :
         fs::recursive_directory_iterator(path, fs::directory_options::follow_directory_symlink)) {
      const bool is_hidden = entry.path().filename().string().starts_with('.');
      if (!entry.is_directory() && !is_hidden) files.push_back(entry.path());
    }
  }
  return files;
}

std::string NameInRecord(const SitePaths& site, const fs::path& file) {
  const fs::path relative = file.lexically_relative(site.root);
  const bool is_outside = relative.empty() || *relative.begin() == "..";
  return (is_outside ? fs::absolute(file).lexically_normal() : relative).generic_string();
}

}  // namespace

FileStates StatesOf(const SitePaths& site, const std::vector<fs::path>& paths, FileHashes* hashes) {
  FileStates states;
  for (const fs::path& file : FilesOf(paths)) {
    states[NameInRecord(site, file)] = hashes->Hash(file);
  }
  return states;
}

std::string ReasonText(const std::vector<std::string>& reasons) {
  std::string text;
  for (size_t i = 0; i < std::min(reasons.size(), kMostReasons); ++i) {
    text += (i == 0 ? "" : "; ") + reasons[i];
  }
  if (reasons.size() > kMostReasons) {
    text += "; and " + std::to_string(reasons.size() - kMostReasons) + " more";
  }
  return text;
}

}  // namespace insitu
