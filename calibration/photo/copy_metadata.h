// SPDX-License-Identifier: GPL-3.0-or-later
// What a photograph states of itself, in the pictures made from it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace insitu {

// What a delivered picture states of itself, in XMP beside what the photograph states.
struct MontageStatement {
  std::string program;            // "insitu 0.1.0"
  bool is_composite = false;      // something in it was computed
  std::string computed;           // what
  std::string photograph_sha256;  // of the files; empty: there is none
  std::string model_sha256, survey_sha256;
  std::string simulation = {};  // whose light it is, where it is not the photograph's; else empty
  std::string quality = {};     // "draft"; empty: final
  std::string parameters = {};  // all options that decide on the pixels
};

// What is copied of it.
struct CopiedMetadata {
  bool with_profile = true;                     // else the target's own stays
  std::string profile = {};                     // ICC, where the source's cannot be read
  bool with_orientation = true;                 // else the target is upright: 1
  const MontageStatement* statement = nullptr;  // none: nothing is added
};

// EXIF (without the thumbnail, which shows the photograph before the montage), XMP, IPTC and ICC
// from a JPEG, PNG or TIFF into another; none from what holds none, such as an EXR. Of raw, without
// the maker's notes and what speaks of the sensor, as of sRGB. What does not fit into the target's
// format is left out and named in what is returned, a sentence each. Throws InputError: no such
// file.
std::vector<std::string> CopyMetadata(const std::filesystem::path& source,
                                      const std::filesystem::path& target,
                                      const CopiedMetadata& copied = {});

}  // namespace insitu
