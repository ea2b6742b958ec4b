// SPDX-License-Identifier: GPL-3.0-or-later
// One reader a format, in the source named after whom it reads; ReadSurveyFile chooses. Each throws
// InputError at the offending line.
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

// Whether a word names a photograph: as site.h has it, or a raw .dng, which other programs take as
// it is and whose developed photograph, of the same name, is ours.
bool IsPhotoFileName(const std::string& text);

// survey_lists.cc; of what format a text is tell its first lines.
bool IsOdmList(const SurveyText& text);
SurveyFile ReadOdmList(const SurveyText& text);  // gcp_list.txt of OpenDroneMap and OpenSfM
bool HasMarksBelowSystem(
    const SurveyText& text);  // the same below words for a system that name none of its own
bool IsAicon(const SurveyText& text);
SurveyFile ReadAicon(const SurveyText& text);  // .obc, .phc (with its .ior beside it)
bool IsMarkList(const SurveyText& text);
SurveyFile ReadMarkList(const SurveyText& text);  // Pix4D: image,point,x,y; MicMac: point image x y
bool IsPointList(const SurveyText& text);
SurveyFile ReadPointList(const SurveyText& text);  // Pix4D, JAG3D, COLMAP: name x y z [sigmas]

// survey_header_table.cc
bool IsHeaderTable(const SurveyText& text, const SurveyReading& reading);
SurveyFile ReadHeaderTable(const SurveyText& text,  // Metashape's reference CSV, any with names
                           const SurveyReading& reading);
std::optional<Sentence> FaultOfHeader(
    const SurveyText& text);  // what a header of no such table lacks

// opensfm_survey.cc
SurveyFile ReadOpenSfmJson(const std::filesystem::path& path, const PhotoSize& photo_size);

// metashape_survey.cc
SurveyFile ReadMetashapeXml(const XmlNode& document);

// micmac_survey.cc
SurveyFile ReadMicMacXml(const XmlNode& root);  // both kinds of MicMac, both kinds of MMVII

// dbat_survey.cc
SurveyFile ReadDbatSurvey(const std::filesystem::path& script);

}  // namespace insitu
