// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/foreground_matte.h"

#include <algorithm>
#include <limits>
#include <set>

#include "calibration/files/error.h"
#include "calibration/files/json_file.h"
#include "calibration/photo/photograph.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;

// One kind of such pictures.
struct Drawing {
  const char* folder;   // in survey/
  const char* meaning;  // of its greys
};
constexpr Drawing kForeground = {
    "foreground", "white where something stands in front of the building, black elsewhere"};
constexpr Drawing kShadows = {
    "shadows",
    "black where something that no polygon stands for keeps the sun away, white elsewhere"};

constexpr Drawing kMasks = {
    "", "white where the photograph shows the polygon, black where something stands before it"};

constexpr Drawing kTrimaps = {
    "trimaps",
    "black what is behind, white what is in front, any grey what is to be found between them"};

// Coverage is a share of the pixel, so codes are linear in it.
template <typename Code>
Raster SharesOf(const fs::path& path, const std::vector<Code>& codes, int width, int height,
                const Drawing& drawing) {
  Raster share(width, height, 1);
  for (size_t i = 0; i < share.data.size(); ++i) {
    const Code* rgb = &codes[3 * i];
    if (rgb[0] != rgb[1] || rgb[0] != rgb[2]) {
      throw InputError(path,
                       std::string("is coloured, expected a grey picture: ") + drawing.meaning);
    }
    share.data[i] = static_cast<float>(rgb[0]) / std::numeric_limits<Code>::max();
  }
  return share;
}

fs::path FileOf(const SitePaths& site, const Drawing& drawing, const std::string& photo) {
  return site.survey() / drawing.folder / (photo + ".png");
}

Raster ReadGrey(const fs::path& path, const Drawing& drawing, int width, int height) {
  const CodedPhotograph coded = ReadCodedPhotograph(path);
  if (coded.width != width || coded.height != height) {
    throw InputError(path,
                     "is " + SizeText(coded.width, coded.height) + ", expected " +
                         SizeText(width, height) +
                         " as its photograph is: draw it on the photograph itself, uncropped");
  }
  if (const auto* bytes = std::get_if<std::vector<uint8_t>>(&coded.samples)) {
    return SharesOf(path, *bytes, width, height, drawing);
  }
  if (const auto* words = std::get_if<std::vector<uint16_t>>(&coded.samples)) {
    return SharesOf(path, *words, width, height, drawing);
  }
  throw InputError(path, "has fractional numbers, expected a PNG of 8 or 16 bits");
}

std::optional<Raster> ReadDrawing(const SitePaths& site, const Drawing& drawing,
                                  const std::string& photo, int width, int height) {
  const fs::path path = FileOf(site, drawing, photo);
  if (!fs::exists(path)) return std::nullopt;
  return ReadGrey(path, drawing, width, height);
}

void AddUnread(const SitePaths& site, const Drawing& drawing, std::vector<std::string>* unread) {
  std::set<std::string> expected;
  for (const fs::path& photo : ListPhotographs(site)) {
    expected.insert(photo.stem().string() + ".png");
  }
  const fs::path folder = site.survey() / drawing.folder;
  if (!fs::is_directory(folder)) return;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with('.') || expected.contains(name)) continue;
    const std::string text = "is not read: expected the name of a photograph and .png, as in ";
    unread->push_back(InputError(entry.path(), text + *expected.begin()).what());
  }
}

}  // namespace

fs::path ForegroundMatteFile(const SitePaths& site, const std::string& photo) {
  return FileOf(site, kForeground, photo);
}

std::optional<Raster> ReadForegroundMatte(const SitePaths& site, const std::string& photo,
                                          int width, int height) {
  return ReadDrawing(site, kForeground, photo, width, height);
}

std::optional<Raster> ReadShadowPicture(const SitePaths& site, const std::string& photo, int width,
                                        int height) {
  return ReadDrawing(site, kShadows, photo, width, height);
}

std::optional<Raster> ReadTrimap(const SitePaths& site, const std::string& photo, int width,
                                 int height) {
  return ReadDrawing(site, kTrimaps, photo, width, height);
}

Raster ReadPolygonMask(const SitePaths& site, const std::string& file, int width, int height) {
  return ReadGrey(site.survey() / file, kMasks, width, height);
}

std::map<std::string, std::string> PolygonMasks(const SitePaths& site) {
  std::map<std::string, std::string> masks;
  const fs::path path = site.survey() / "polygons.json";
  if (!fs::exists(path)) return masks;
  for (const JsonNode& polygon : JsonNode::Load(path).At("polygons").Items()) {
    if (const auto mask = polygon.Find("mask")) masks[polygon.At("name").Text()] = mask->Text();
  }
  return masks;
}

std::vector<std::string> UnreadDrawings(const SitePaths& site) {
  std::vector<std::string> unread;
  for (const Drawing& drawing : {kForeground, kShadows, kTrimaps})
    AddUnread(site, drawing, &unread);
  std::ranges::sort(unread);
  return unread;
}

}  // namespace insitu
