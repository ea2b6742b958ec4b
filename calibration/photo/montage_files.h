// SPDX-License-Identifier: GPL-3.0-or-later
// The delivered files of a montage, each as the photograph is.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "calibration/photo/copy_metadata.h"
#include "calibration/photo/photograph.h"

namespace insitu {

struct MontagePicture {
  Raster linear;                 // the montage
  Photograph photo;              // what it was made from, in the same frame
  std::filesystem::path source;  // the photograph's file
  bool is_photo_frame = true;    // else `photo` was resampled
  MontageStatement statement;
  bool wants_tiff = false;  // of 16 bits, whatever the photograph is
  bool is_quick = false;    // packed little, to be there soon
};

// A photograph's codes where the montage is bit for bit the photograph, else the nearest ones.
// `original`: the photograph's; null: it was resampled.
CodedPhotograph MontageCodes(const MontagePicture& montage, const CodedPhotograph* original,
                             Encoding encoding, const ColorSpace& color);

// Turned and mirrored so that it stands upright without EXIF's `orientation` (1 to 8).
CodedPhotograph Upright(CodedPhotograph picture, int orientation);

// Writes `stem` + .exr, .png and .jpg, and .tif of a TIFF, of a raw or where it is wanted (else one
// that an earlier run has left goes): in the photograph's colour space,
// of a raw in sRGB, with its profile and metadata, and the statement. The EXR of a photograph that
// is no EXR is linear Rec. 709. The blocks of a JPEG that is a JPEG's montage are the photograph's
// where nothing changed. JPEG, TIFF and a PNG of a PNG keep the photograph's orientation; other PNG
// and EXR are turned upright, since viewers heed no tag in them. Returns remarks, a sentence each:
// what could not be kept.
std::vector<std::string> WriteMontageFiles(const std::filesystem::path& stem,
                                           const MontagePicture& montage);

}  // namespace insitu
