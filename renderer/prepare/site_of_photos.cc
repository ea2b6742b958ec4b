// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/prepare/site_of_photos.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <vector>

#include "calibration/files/error.h"
#include "calibration/photo/photograph.h"
#include "reconstruction/editing/edited_tables.h"
#include "reconstruction/editing/site_edit.h"
#include "renderer/prepare/merge_conflicts.h"

namespace insitu {

std::vector<std::string> PhotoNames(const SitePaths& site) {
  std::vector<std::string> names;
  for (const auto& path : ListPhotographs(site)) names.push_back(path.stem().string());
  return names;
}

std::map<std::string, Eigen::Vector2i> PhotoSizes(const SitePaths& site) {
  std::map<std::string, Eigen::Vector2i> sizes;
  for (const auto& path : ListPhotographs(site)) {
    try {
      sizes[path.stem().string()] = ReadPhotographSize(path);
    } catch (const InputError&) {  // the page shows that it cannot be shown
    }
  }
  return sizes;
}

int MakeSiteOfPhotographs(const SitePaths& site) {
  namespace fs = std::filesystem;
  if (fs::exists(site.photos())) return 0;
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(site.root)) {
    if (IsPhotograph(entry.path())) found.push_back(entry.path());
  }
  if (found.empty()) {
    throw InputError(site.root, "neither a folder photos nor photographs, expected one of them");
  }
  std::sort(found.begin(), found.end());
  fs::create_directory(site.photos());
  for (const fs::path& photo : found) {
    const fs::path link = site.photos() / photo.filename();
    std::error_code no_links;
    fs::create_hard_link(photo, link, no_links);
    if (no_links) fs::copy_file(photo, link);
  }
  return static_cast<int>(found.size());
}

std::string MergeColleague(const SitePaths& site, const SitePaths& colleague) {
  SiteEdit edit(site, PhotoNames(site));
  const std::string id = "merge-" + std::to_string(edit.revision());
  const SiteEdit::MergeReport report = edit.Merge(colleague, id);
  const size_t rows = report.outcome.operation ? report.outcome.operation->edits.size() : 0;
  std::string text = std::to_string(rows) + " rows taken in, " +
                     std::to_string(report.conflicts.size()) +
                     " differ and stay as they are here\n";
  for (const RowConflict& conflict : report.conflicts) {
    text += conflict.table + ": here " + OneLineJson(conflict.current) + ", there " +
            OneLineJson(conflict.after) + "\n";
  }
  for (const Sentence& remark : report.remarks) text += remark.text() + "\n";
  if (!report.conflicts.empty()) {
    text += "insitu prepare " + site.root.string() +
            " shows them side by side, for somebody to decide\n";
  }
  if (!report.outcome.refused.empty()) {
    throw InputError(colleague.root, report.outcome.refused.text());
  }
  for (const FileFault& fault : edit.Save().faults) {
    throw InputError(site.root / fault.file, fault.line, fault.text.text());
  }
  KeepMergeConflicts(site, colleague, report.conflicts);
  return text;
}

}  // namespace insitu
