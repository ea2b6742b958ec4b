// SPDX-License-Identifier: GPL-3.0-or-later
// What is known of a site's scanned film while its certificate is typed and its marks are placed.
#pragma once

#include <json/value.h>

#include <Eigen/Core>
#include <map>
#include <string>

#include "calibration/files/sentence.h"
#include "calibration/program/site.h"

namespace insitu {

// Whether an operation on this table changes what FilmMessage says.
bool IsOfFilm(const std::string& table);

// {type: film, folder, missing: [{text}], faults: [{text}], photos: {NAME: {needed, placed, usable,
// unplaced: [mark], kind, redundancy, sigma_px, sigma_mm (null: cannot be checked), px_per_mm,
// turn_deg (null: no map), marks: [{mark, vx, vy, vx_mm, vy_mm, r, w, off_px}] worst first,
// predicted: {MARK: [x, y]}, suspicions: [{text}]}}}; null where the site has no film. `tables` as
// SiteEdit has them, `sizes` of the photographs [px]. Photos are those with marks, of a site
// without other cameras all; marks switched off count as neither placed nor unplaced.
Json::Value FilmMessage(const SitePaths& site, const Json::Value& tables,
                        const std::map<std::string, Eigen::Vector2i>& sizes);

// Why film cannot be put into the site as it is; empty if it can.
Sentence RefusalOfFilm(const SitePaths& site);

}  // namespace insitu
