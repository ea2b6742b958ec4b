// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/program/unread_files.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <string_view>

#include "calibration/files/raw_ending.h"

namespace insitu {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kOther =
    " .avif .bmp .gif .heic .heics .heif .hif .insp .j2k .jp2 .jpf .jxl .mpo .pdf .psb .psd .tga "
    ".webp ";

std::string LowerEndingOf(const fs::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return ending;
}

bool IsAmong(const std::string& ending, std::string_view endings) {
  return !ending.empty() && endings.find(" " + ending + " ") != std::string_view::npos;
}

// The files of a folder that are not hidden, sorted.
std::vector<fs::path> VisibleFiles(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const bool is_hidden = entry.path().filename().string().starts_with('.');
    if (entry.is_regular_file() && !is_hidden) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

// "photos/a.heic is", or of several "photos/a.heic and 3 other .heic files are".
std::string Subject(const std::vector<fs::path>& files, const std::string& kind) {
  const std::string first = files.front().string();
  if (files.size() == 1) return first + " is";
  return first + " and " + std::to_string(files.size() - 1) + " other " + kind +
         (files.size() == 2 ? " file are" : " files are");
}

void AddStrangeFormats(const std::vector<fs::path>& files, std::vector<std::string>* unread) {
  std::map<std::string, std::vector<fs::path>> by_ending;
  for (const fs::path& file : files) by_ending[LowerEndingOf(file)].push_back(file);
  for (const auto& [ending, of_ending] : by_ending) {
    if (!IsAmong(ending, kOther)) continue;
    unread->push_back(Subject(of_ending, ending) +
                      " not read, expected JPEG, PNG, TIFF, EXR or raw; export it as JPEG or TIFF "
                      "in full size");
  }
}

// Marks are pixels of the camera's picture, which may be another part of what the sensor saw.
void AddRawBesideOthers(const std::vector<fs::path>& files, std::vector<std::string>* unread) {
  std::set<std::string> names;
  for (const fs::path& file : files) {
    if (IsPhotograph(file) && !HasRawEnding(file)) names.insert(file.stem().string());
  }
  std::map<std::string, std::vector<fs::path>> by_ending;
  for (const fs::path& file : files) {
    const bool is_beside = HasRawEnding(file) && names.contains(file.stem().string());
    if (is_beside) by_ending[LowerEndingOf(file)].push_back(file);
  }
  for (const auto& [ending, of_ending] : by_ending) {
    unread->push_back(Subject(of_ending, ending) +
                      " not read beside the picture of the same name; to measure light in the raw, "
                      "move the picture away and mark its points on the raw");
  }
}

void AddUnnamedBoards(const std::vector<fs::path>& files, std::vector<std::string>* unread) {
  std::vector<fs::path> unnamed;
  std::copy_if(files.begin(), files.end(), std::back_inserter(unnamed), [](const fs::path& file) {
    return IsPhotograph(file) && !file.filename().string().starts_with("board_");
  });
  if (unnamed.empty()) return;
  unread->push_back(Subject(unnamed, "picture") +
                    " not named board_*, so not read; name photographs of the board "
                    "board_1.jpg, board_2.jpg and so on");
}

}  // namespace

std::vector<std::string> UnreadFiles(const SitePaths& site) {
  std::vector<std::string> unread;
  if (fs::is_directory(site.photos())) {
    const std::vector<fs::path> photos = VisibleFiles(site.photos());
    AddRawBesideOthers(photos, &unread);
    AddStrangeFormats(photos, &unread);
  }
  if (!fs::is_directory(site.boards())) return unread;
  std::vector<fs::path> folders = {site.boards()};
  for (const fs::directory_entry& entry : fs::directory_iterator(site.boards())) {
    const bool is_hidden = entry.path().filename().string().starts_with('.');
    if (entry.is_directory() && !is_hidden) folders.push_back(entry.path());
  }
  std::sort(folders.begin(), folders.end());
  for (const fs::path& folder : folders) {
    const std::vector<fs::path> files = VisibleFiles(folder);
    AddStrangeFormats(files, &unread);
    AddUnnamedBoards(files, &unread);
  }
  return unread;
}

}  // namespace insitu
