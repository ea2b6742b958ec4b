// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/site_mattes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "calibration/files/error.h"
#include "calibration/foreground_matte.h"
#include "calibration/photo/matting.h"
#include "calibration/photo/photograph.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;

fs::path DrawingOf(const SitePaths& site, const std::string& photo) {
  return site.survey() / "trimaps" / (photo + ".png");
}

bool IsBetween(float share) { return share > 0 && share < 1; }

double ShareBetween(const Raster& shares) {
  return static_cast<double>(std::ranges::count_if(shares.data, IsBetween)) /
         static_cast<double>(shares.data.size());
}

void WriteShares(const fs::path& path, const Raster& shares) {
  std::vector<uint16_t> codes;
  codes.reserve(3 * shares.data.size());
  for (const float share : shares.data) {
    codes.insert(codes.end(), 3, static_cast<uint16_t>(std::lround(share * 65535)));
  }
  fs::create_directories(path.parent_path());
  WriteCodes(path, {shares.width, shares.height, std::move(codes)});
}

MadeMatte MakeMatte(const SitePaths& site, const fs::path& photograph, bool replace) {
  const std::string photo = photograph.stem().string();
  MadeMatte made{site.survey() / "foreground" / (photo + ".png")};
  if (fs::exists(made.file) && !replace) {
    throw InputError(made.file, "is there already, expected --replace to make it anew");
  }
  const Raster linear = ReadPhotograph(photograph).linear;
  Raster trimap = *ReadTrimap(site, photo, linear.width, linear.height);
  made.open = ShareBetween(trimap);
  if (made.open == 0) {
    throw InputError(DrawingOf(site, photo),
                     "leaves nothing to be found, expected grey where leaves and sky mix");
  }
  const Raster matte = EstimateMatte(linear, std::move(trimap));
  made.fraction = ShareBetween(matte) / made.open;
  WriteShares(made.file, matte);
  return made;
}

}  // namespace

std::vector<MadeMatte> MakeMattes(const SitePaths& site, const std::vector<std::string>& photos,
                                  bool replace) {
  const std::vector<fs::path> all = ListPhotographs(site);
  for (const std::string& name : photos) {
    const auto is_named = [&](const fs::path& path) { return path.stem() == name; };
    if (std::ranges::none_of(all, is_named)) {
      throw InputError(site.photos(), "no photograph is named " + name);
    }
    if (!fs::exists(DrawingOf(site, name))) {
      throw InputError(DrawingOf(site, name),
                       "is not there, expected black behind, white in front and grey between");
    }
  }
  std::vector<MadeMatte> made;
  for (const fs::path& photograph : all) {
    const std::string name = photograph.stem().string();
    const bool is_wanted = photos.empty() ? fs::exists(DrawingOf(site, name))
                                          : std::ranges::find(photos, name) != photos.end();
    if (is_wanted) made.push_back(MakeMatte(site, photograph, replace));
  }
  if (made.empty()) {
    throw InputError(site.survey() / "trimaps", "holds no drawing of a photograph's name and .png");
  }
  return made;
}

}  // namespace insitu
