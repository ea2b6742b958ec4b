// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures that a person draws over a photograph: survey/foreground/<photo>.png, which part of each
// pixel something in front of the building covers, and survey/shadows/<photo>.png, which part of
// the sun reaches what is seen there.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "calibration/photo/raster.h"
#include "calibration/program/site.h"

namespace insitu {

// Where the first is, if there is one.
std::filesystem::path ForegroundMatteFile(const SitePaths& site, const std::string& photo);

// The share 0..1 of each pixel (code 255, or 65535 of 16 bits, is 1) in the photograph's frame, one
// channel; nullopt: no such file. Throws InputError: not grey, of another size, not 8 or 16 bits.
std::optional<Raster> ReadForegroundMatte(const SitePaths& site, const std::string& photo,
                                          int width, int height);

// The same of survey/shadows/: 0 where something that no polygon stands for keeps the sun away, 1
// where nothing does.
std::optional<Raster> ReadShadowPicture(const SitePaths& site, const std::string& photo, int width,
                                        int height);

// What insitu-matte makes the first of, survey/trimaps/<photo>.png: 0 behind, 1 in front, what is
// between is to be found.
std::optional<Raster> ReadTrimap(const SitePaths& site, const std::string& photo, int width,
                                 int height);

// The mask of a polygon, survey/FILE: the share of each pixel in which its photograph shows it.
// Throws InputError as ReadForegroundMatte, and where it is not there.
Raster ReadPolygonMask(const SitePaths& site, const std::string& file, int width, int height);

// The files of such masks by the name of their polygon, as survey/polygons.json has them; empty
// without that file. Throws InputError: it cannot be read.
std::map<std::string, std::string> PolygonMasks(const SitePaths& site);

// Files in these folders that belong to no photograph, a line each.
std::vector<std::string> UnreadDrawings(const SitePaths& site);

}  // namespace insitu
