// SPDX-License-Identifier: GPL-3.0-or-later
// One reader a format; ReadSurveyFile chooses. Each throws InputError at the offending line.
#pragma once

#include "calibration/files/text_table.h"
#include "calibration/files/xml_file.h"
#include "reconstruction/exchange/survey_file.h"

namespace insitu {

struct SurveyText {
  std::filesystem::path path;
  std::string content;
  std::vector<TextRow> rows;  // without comments
};

// The photo's name in a path: without folders and ending.
std::string PhotoName(const std::string& path);
bool IsPhotoFileName(const std::string& text);

// Tells whether a text is of a format, by its first lines.
bool IsOdmList(const SurveyText& text);
bool IsHeaderTable(const SurveyText& text);
bool IsAicon(const SurveyText& text);
bool IsMarkList(const SurveyText& text);
bool IsPointList(const SurveyText& text);

SurveyFile ReadOdmList(const SurveyText& text);      // gcp_list.txt of OpenDroneMap and OpenSfM
SurveyFile ReadHeaderTable(const SurveyText& text);  // Metashape's reference CSV, any with names
SurveyFile ReadAicon(const SurveyText& text);        // .obc, .phc (with its .ior beside it)
SurveyFile ReadMarkList(const SurveyText& text);  // Pix4D: image,point,x,y; MicMac: point image x y
SurveyFile ReadPointList(const SurveyText& text);  // Pix4D, JAG3D, COLMAP: name x y z [sigmas]

SurveyFile ReadOpenSfmJson(const std::filesystem::path& path, const PhotoSize& photo_size);

SurveyFile ReadMetashapeXml(const XmlNode& document);
SurveyFile ReadMicMacXml(const XmlNode& root);  // both kinds of MicMac, both kinds of MMVII
SurveyFile ReadDbatSurvey(const std::filesystem::path& script);

}  // namespace insitu
