// SPDX-License-Identifier: GPL-3.0-or-later
// Files of surveys and marks of other programs, their formats recognised by content.
//
// Where a pixel counts from, by format:
//   ours              the centre of the top-left pixel is (0, 0)
//   OpenSfM, ODM      the same ("origin at the center of the top-left pixel", doc/geometry.rst);
//                     in JSON from the middle of the picture, over its larger side
//   MicMac            the same: its images have their pixels' values at whole coordinates
//   Metashape         (0.5, 0.5) (its manual, "Camera models")
//   Pix4D             from the upper left corner (help 360035474951): (0.5, 0.5)
//   DBAT              (0.5, 0.5), see dbat_camera.h
//   AICON             mm from the middle of the picture, y up
//   tables with header  not stated: taken as ours, which the report says
#pragma once

#include <filesystem>

#include "reconstruction/exchange/survey_file.h"

namespace insitu {

// Throws InputError at the offending line: unreadable, of no known format, cut short, senseless, or
// a table whose titles leave open what is meant and `reading` does not say.
SurveyFile ReadSurveyFile(const std::filesystem::path& path, const PhotoSize& photo_size,
                          const SurveyReading& reading = {});

}  // namespace insitu
