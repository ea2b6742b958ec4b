// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/foreground_matte.h"

#include <algorithm>
#include <limits>
#include <set>

#include "calibration/files/error.h"
#include "calibration/photo/photograph.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;

fs::path FolderOf(const SitePaths& site) { return site.survey() / "foreground"; }

// Coverage is a share of the pixel, so codes are linear in it.
template <typename Code>
Raster SharesOf(const fs::path& path, const std::vector<Code>& codes, int width, int height) {
  Raster share(width, height, 1);
  for (size_t i = 0; i < share.data.size(); ++i) {
    const Code* rgb = &codes[3 * i];
    if (rgb[0] != rgb[1] || rgb[0] != rgb[2]) {
      throw InputError(path,
                       "is coloured, expected a grey picture: white where something stands in "
                       "front of the building, black elsewhere");
    }
    share.data[i] = static_cast<float>(rgb[0]) / std::numeric_limits<Code>::max();
  }
  return share;
}

}  // namespace

std::optional<Raster> ReadForegroundMatte(const SitePaths& site, const std::string& photo,
                                          int width, int height) {
  const fs::path path = FolderOf(site) / (photo + ".png");
  if (!fs::exists(path)) return std::nullopt;
  const CodedPhotograph coded = ReadCodedPhotograph(path);
  if (coded.width != width || coded.height != height) {
    throw InputError(path,
                     "is " + SizeText(coded.width, coded.height) + ", expected " +
                         SizeText(width, height) +
                         " as its photograph is: draw it on the photograph itself, uncropped");
  }
  if (const auto* bytes = std::get_if<std::vector<uint8_t>>(&coded.samples)) {
    return SharesOf(path, *bytes, width, height);
  }
  if (const auto* words = std::get_if<std::vector<uint16_t>>(&coded.samples)) {
    return SharesOf(path, *words, width, height);
  }
  throw InputError(path, "has fractional numbers, expected a PNG of 8 or 16 bits");
}

std::vector<std::string> UnreadForegroundFiles(const SitePaths& site) {
  std::set<std::string> expected;
  for (const fs::path& photo : ListPhotographs(site)) {
    expected.insert(photo.stem().string() + ".png");
  }
  std::vector<std::string> unread;
  if (!fs::is_directory(FolderOf(site))) return unread;
  for (const fs::directory_entry& entry : fs::directory_iterator(FolderOf(site))) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with('.') || expected.contains(name)) continue;
    const std::string text = "is not read: expected the name of a photograph and .png, as in ";
    unread.push_back(InputError(entry.path(), text + *expected.begin()).what());
  }
  std::ranges::sort(unread);
  return unread;
}

}  // namespace insitu
