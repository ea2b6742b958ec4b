// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/exchange/read_survey_file.h"

#include "calibration/files/error_at.h"
#include "calibration/files/plain_text.h"
#include "reconstruction/exchange/survey_file_formats.h"

namespace insitu {
namespace {

SurveyFile ReadXml(const std::filesystem::path& path) {
  const XmlNode root = XmlNode::Load(path);
  if (root.Attribute("dbat_script_version")) return ReadDbatSurvey(path);
  if (root.Name() == "document") return ReadMetashapeXml(root);
  return ReadMicMacXml(root);
}

SurveyFile ReadText(const SurveyText& text, const SurveyReading& reading) {
  if (text.rows.empty()) throw ErrorAt({text.path}, Sentence("fileEmpty", "is empty"));
  if (IsOdmList(text)) return ReadOdmList(text);
  if (IsHeaderTable(text, reading)) return ReadHeaderTable(text, reading);
  if (HasMarksBelowSystem(text)) return ReadOdmList(text);
  if (IsAicon(text)) return ReadAicon(text);
  if (IsMarkList(text)) return ReadMarkList(text);
  if (IsPointList(text)) return ReadPointList(text);
  if (const auto fault = FaultOfHeader(text)) throw ErrorAt(text.rows[0].place(), *fault);
  throw ErrorAt(
      text.rows[0].place(),
      Sentence(
          "formatUnknown",
          "is of no format that we know, expected for example a coordinate system and lines "
          "\"X Y Z px py image name\" (OpenDroneMap), a header \"name,x,y,z\", lines \"name X Y "
          "Z\", lines \"image,point,x,y\" (Pix4D), XML of Metashape, MicMac or DBAT, JSON of "
          "OpenSfM"));
}

}  // namespace

SurveyFile ReadSurveyFile(const std::filesystem::path& path, const PhotoSize& photo_size,
                          const SurveyReading& reading) {
  const std::string content = ReadPlainText(path);
  const std::string_view start = TrimmedView(content);
  SurveyFile file;
  if (start.starts_with("<")) {
    file = ReadXml(path);
  } else if (start.starts_with("{")) {
    file = ReadOpenSfmJson(path, photo_size);
  } else {
    file = ReadText({path, content, SplitTextRows(path, content, WordSeparator::kGuess)}, reading);
  }
  file.path = path;
  if (file.points.empty() && file.marks.empty() && file.centers.empty()) {
    throw ErrorAt({path},
                  Sentence("surveyNothing", "holds neither points nor marks (read as {format})",
                           {{"format", file.format}}));
  }
  return file;
}

}  // namespace insitu
