// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/program/site.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <set>

#include "calibration/files/error.h"
#include "calibration/files/raw_ending.h"

namespace insitu {
namespace fs = std::filesystem;

bool HasPhotographEnding(const fs::path& name) {
  if (HasRawEnding(name)) return true;
  static constexpr std::array kEndings = {".jpg", ".jpeg", ".jpe", ".png", ".tif", ".tiff", ".exr"};
  std::string ending = name.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::find(kEndings.begin(), kEndings.end(), ending) != kEndings.end();
}

bool IsPhotograph(const fs::path& path) {
  return HasPhotographEnding(path) && fs::is_regular_file(path) &&
         !path.filename().string().starts_with('.');
}

void RequireResult(const fs::path& result, const std::string& program) {
  if (!fs::exists(result)) {
    throw InputError(result, "is not there, expected the result of " + program + "; run it first");
  }
}

namespace {

// Folders in `folder` that are not hidden.
std::set<std::string> FoldersIn(const fs::path& folder) {
  std::set<std::string> names;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, none)) {
    const std::string name = entry.path().filename().string();
    if (entry.is_directory() && !name.starts_with('.')) names.insert(name);
  }
  return names;
}

// Throws InputError; `expected`: where there is none at all.
void RequireFolder(const fs::path& folder, const std::string& name, const std::string& expected) {
  const std::set<std::string> names = FoldersIn(folder);
  if (names.contains(name)) return;
  std::string known;
  for (const std::string& other : names) known += (known.empty() ? "" : ", ") + other;
  throw InputError(folder, "has no folder \"" + name + "\", expected " +
                               (known.empty() ? expected : "one of " + known));
}

}  // namespace

void RequireVariant(const SitePaths& site) {
  if (site.variant.empty()) return;
  RequireFolder(site.variants(), site.variant, "one, with the content of building/");
}

void RequireHour(const SitePaths& site) {
  if (site.hour.empty()) return;
  RequireFolder(site.hours(), site.hour, "one that insitu-relight has made");
}

std::vector<fs::path> ListPhotographs(const SitePaths& site) {
  if (!fs::is_directory(site.photos())) {
    throw InputError(site.photos(), "no such folder, expected the site's photographs in it");
  }
  std::map<std::string, fs::path> by_name;
  for (const fs::directory_entry& entry : fs::directory_iterator(site.photos())) {
    if (!IsPhotograph(entry.path())) continue;
    const auto [other, is_new] = by_name.emplace(entry.path().stem().string(), entry.path());
    if (is_new) continue;
    const bool is_raw = HasRawEnding(entry.path()), is_other_raw = HasRawEnding(other->second);
    if (is_raw == is_other_raw) {
      const auto [first, second] = std::minmax(other->second, entry.path());
      throw InputError(second, "has the same name as " + first.filename().string() +
                                   ", expected each photograph's name once");
    }
    if (is_other_raw) other->second = entry.path();
  }
  if (by_name.empty()) {
    throw InputError(site.photos(), "no photographs, expected JPEG, PNG, TIFF, EXR or raw files");
  }
  std::vector<fs::path> photos;
  photos.reserve(by_name.size());
  for (const auto& [name, path] : by_name) photos.push_back(path);
  return photos;
}

}  // namespace insitu
