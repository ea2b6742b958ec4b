// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/tiles/overview_files.h"

#include <exception>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <system_error>
#include <vector>

#include "calibration/files/whole_file.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;

// "IMG_1.png_": what is kept of a photograph begins so;
std::string StemOf(const fs::path& photo) { return photo.filename().string() + "_"; }

// and goes on with the size and the time of the file that it was made from.
std::string NameOf(const fs::path& photo) {
  const auto time = fs::last_write_time(photo).time_since_epoch().count();
  return StemOf(photo) + std::to_string(fs::file_size(photo)) + "_" + std::to_string(time) + ".png";
}

void RemoveOlder(const fs::path& folder, const fs::path& photo) {
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().filename().string().starts_with(StemOf(photo))) fs::remove(entry.path());
  }
}

}  // namespace

cv::Mat OverviewFiles::Read(const fs::path& photo) const {
  if (folder_.empty()) return {};
  try {
    const fs::path kept = folder_ / NameOf(photo);
    if (!fs::exists(kept)) return {};
    return cv::imread(kept.string(), cv::IMREAD_COLOR | cv::IMREAD_ANYDEPTH);
  } catch (const std::exception&) {  // as if it were not there: it is made anew
    return {};
  }
}

void OverviewFiles::Keep(const fs::path& photo, const cv::Mat& overview) const {
  if (folder_.empty() || overview.depth() == CV_32F) return;
  try {
    std::vector<unsigned char> bytes;
    cv::imencode(".png", overview, bytes, {cv::IMWRITE_PNG_COMPRESSION, 1});
    fs::create_directories(folder_);
    RemoveOlder(folder_, photo);
    WriteWhole(folder_ / NameOf(photo), std::string(bytes.begin(), bytes.end()));
  } catch (const std::exception&) {  // a full disk: the next opening waits again
  }
}

}  // namespace insitu
