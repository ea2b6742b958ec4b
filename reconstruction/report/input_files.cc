// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/report/input_files.h"

#include <algorithm>
#include <regex>
#include <set>

#include "calibration/files/error.h"
#include "calibration/files/sha256.h"
#include "calibration/files/whole_file.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;

// The first list after `start`, with its brackets; empty if it does not close.
std::string Bracketed(const std::string& text, size_t start) {
  int depth = 0;
  const size_t begin = std::min(text.find('[', start), text.size());
  for (size_t i = begin; i < text.size(); ++i) {
    depth += text[i] == '[' ? 1 : text[i] == ']' ? -1 : 0;
    if (depth == 0) return text.substr(begin, i + 1 - begin);
  }
  return "";
}

}  // namespace

std::vector<InputFile> HashInputs(const SitePaths& site, const std::vector<std::string>& cameras) {
  std::set<fs::path> candidates = {site.description(), site.tie_points()};
  for (const std::string& camera : cameras) {
    candidates.insert({site.camera(camera), site.calibration_report(camera)});
  }
  std::vector<fs::path> paths = ListPhotographs(site);
  std::copy_if(candidates.begin(), candidates.end(), std::back_inserter(paths),
               [](const fs::path& path) { return fs::is_regular_file(path); });
  if (fs::is_directory(site.survey())) {
    for (const fs::directory_entry& entry : fs::directory_iterator(site.survey())) {
      const bool is_hidden = entry.path().filename().string().starts_with('.');
      if (entry.is_regular_file() && !is_hidden) paths.push_back(entry.path());
    }
  }
  std::vector<InputFile> inputs;
  for (const fs::path& path : paths) {
    inputs.push_back({path.lexically_relative(site.root).generic_string(), Sha256(path)});
  }
  std::sort(inputs.begin(), inputs.end(),
            [](const InputFile& a, const InputFile& b) { return a.name < b.name; });
  return inputs;
}

std::vector<Eigen::Vector2d> ReadCalibratedRegion(const fs::path& camera) {
  const std::string text = ReadWhole(camera);
  const size_t key = text.find("valid_intrinsics_region");
  if (key == std::string::npos) return {};
  const std::string list = Bracketed(text, key);
  const std::string number = R"(\s*([-+0-9.eE]+)\s*)";
  const std::regex pair("\\[" + number + "," + number + ",?\\s*\\]");
  std::vector<Eigen::Vector2d> outline;
  for (std::sregex_iterator match(list.begin(), list.end(), pair), none; match != none; ++match) {
    outline.emplace_back(std::stod((*match)[1]), std::stod((*match)[2]));
  }
  return outline;
}

}  // namespace insitu
