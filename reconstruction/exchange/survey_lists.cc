// SPDX-License-Identifier: GPL-3.0-or-later
// Tables without a header: OpenDroneMap, Pix4D, JAG3D, COLMAP, MicMac, AICON.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <sstream>

#include "calibration/camera_files/aicon_camera.h"
#include "calibration/files/error_at.h"
#include "reconstruction/exchange/survey_file_formats.h"

namespace insitu {
namespace {

constexpr double kPix4dFirstPixelCenter = 0.5;
constexpr double kMetresPerMm = 1e-3;

bool IsNumber(const TextRow& row, size_t index) {
  return index < row.words.size() && ParseNumber(row.words[index]).has_value();
}

bool AreNumbers(const TextRow& row, size_t first, size_t last) {
  for (size_t i = first; i <= last; ++i) {
    if (!IsNumber(row, i)) return false;
  }
  return true;
}

bool IsPhotoAt(const TextRow& row, size_t index) {
  return index < row.words.size() && IsPhotoFileName(row.words[index]);
}

Eigen::Vector3d Position(const TextRow& row, size_t first) {
  return {row.Number(first, "x"), row.Number(first + 1, "y"), row.Number(first + 2, "z")};
}

double Sigma(const TextRow& row, size_t index) {
  const double sigma = row.Number(index, "accuracy");
  if (!(sigma > 0))
    throw ErrorAt(row.place(),
                  Sentence("accuracyNotPositive", "the accuracy is {text}, expected more than 0",
                           {{"text", row.words[index]}}));
  return sigma;
}

bool HasCommas(const SurveyText& text) { return text.content.find(',') != std::string::npos; }

// ---- OpenDroneMap, OpenSfM -----------------------------------------------------------------

constexpr size_t kOdmPhoto = 5;  // the column of the photo's name

void JoinPhotoName(TextRow* row) {
  const auto first = row->words.begin() + kOdmPhoto;
  const auto end =
      std::find_if(first, row->words.end(), [](const auto& word) { return IsPhotoFileName(word); });
  if (end == row->words.end() || end == first) return;
  for (auto word = first + 1; word <= end; ++word) *first += " " + *word;
  row->words.erase(first + 1, end + 1);
}

bool IsOdmMark(const TextRow& row) {
  return row.words.size() > kOdmPhoto && AreNumbers(row, 0, 1) && AreNumbers(row, 3, 4) &&
         IsPhotoAt(row, kOdmPhoto);
}

// Points without a name are those of one place; they are named gcp_1, gcp_2 ... in their order.
class OdmPoints {
 public:
  explicit OdmPoints(SurveyFile* file) : file_(file) {}

  // nullopt: of unknown height.
  std::optional<std::string> Add(const TextRow& row, const std::string& name) {
    const double x = row.Number(0, "X"), y = row.Number(1, "Y");
    std::string z_text = row.Text(2, "Z");
    for (char& letter : z_text) letter = static_cast<char>(std::tolower(letter));
    if (z_text == "nan") {
      ++without_height_;
      return std::nullopt;
    }
    const std::array<double, 3> place = {x, y, row.Number(2, "Z")};
    const auto [named, is_new] =
        names_.emplace(place, name.empty() ? "gcp_" + std::to_string(names_.size() + 1) : name);
    if (!name.empty() && named->second != name) {
      throw ErrorAt(row.place(), Sentence("pointsOnePlace",
                                          "point \"{point}\" stands at the place of \"{other}\"",
                                          {{"point", name}, {"other", named->second}}));
    }
    if (is_new) {
      file_->points.push_back({named->second, Eigen::Vector3d(place.data()), std::nullopt,
                               ControlRole::kControl, row.place()});
    }
    return named->second;
  }

  void Finish() const {
    if (!without_height_) return;
    file_->remarks.push_back(Sentence("remarkNoHeight",
                                      "{count} marks are of points without height and are left out",
                                      {{"count", without_height_}}));
  }

 private:
  SurveyFile* file_;
  std::map<std::array<double, 3>, std::string> names_;
  int without_height_ = 0;
};

// Between tabulators where a line has any, since names may hold blanks; else between blanks. The
// words of a photo's name are put together again: it ends where its ending stands.
std::vector<TextRow> OdmRows(const SurveyText& text) {
  std::vector<TextRow> rows = SplitTextRows(text.path, text.content, WordSeparator::kBlanks);
  std::istringstream stream(text.content);
  std::string line;
  int number = 0;
  for (TextRow& row : rows) {
    while (number < row.line && std::getline(stream, line)) ++number;
    const std::vector<std::string> cells = SplitAt(line, '\t');
    if (cells.size() >= kOdmPhoto + 1) {
      row.words = cells;
    } else if (row.words.size() > kOdmPhoto) {
      JoinPhotoName(&row);
    }
  }
  return rows;
}

std::string Joined(const std::vector<std::string>& words) {
  std::string joined;
  for (const std::string& word : words) joined += (joined.empty() ? "" : " ") + word;
  return joined;
}

// ---- AICON ---------------------------------------------------------------------------------

constexpr size_t kAiconColumns = 11;

bool IsWhole(const std::string& word) {
  return word.find('.') == std::string::npos && ParseNumber(word).has_value();
}

// photo point x y ...; .obc has coordinates in the second column
bool IsAiconMarks(const TextRow& row) { return IsWhole(row.words[0]) && IsWhole(row.words[1]); }

void ReadAiconMarks(const SurveyText& text, SurveyFile* file) {
  const std::filesystem::path ior = std::filesystem::path(text.path).replace_extension(".ior");
  if (!std::filesystem::exists(ior)) {
    throw ErrorAt({text.path},
                  Sentence("aiconCamera", "marks in mm need the camera beside them, \"{file}\"",
                           {{"file", ior.filename().string()}}));
  }
  const std::vector<AiconCamera> cameras = ReadAiconCameras(ior);
  if (cameras.size() != 1) {
    throw ErrorAt({ior},
                  Sentence("aiconOneCamera", "expected one camera for the marks of all photos"));
  }
  int flagged = 0;
  for (const TextRow& row : text.rows) {
    const Eigen::Vector2d mm(row.Number(2, "x"), row.Number(3, "y"));
    if (row.Integer(9, "flag") == 0 && ++flagged) continue;
    file->marks.push_back({row.Text(0, "photo"), row.Text(1, "point"),
                           AiconPixel(cameras[0].lens, mm), std::nullopt, row.place()});
  }
  if (flagged) {
    file->remarks.push_back(
        Sentence("remarkUnusedMarks", "{count} marks are flagged as unused", {{"count", flagged}}));
  }
}

void ReadAiconPoints(const SurveyText& text, SurveyFile* file) {
  int unused = 0;
  for (const TextRow& row : text.rows) {
    if (row.Integer(8, "flag") == 0 && ++unused) continue;
    const Eigen::Vector3d sigma(Sigma(row, 4), Sigma(row, 5), Sigma(row, 6));
    file->points.push_back({row.Text(0, "point"), kMetresPerMm * Position(row, 1),
                            kMetresPerMm * sigma, ControlRole::kControl, row.place()});
  }
  if (unused) {
    file->remarks.push_back(Sentence("remarkUnusedPoints", "{count} points are flagged as unused",
                                     {{"count", unused}}));
  }
}

// ---- lists ---------------------------------------------------------------------------------

// name x y z, with accuracies of plan and height or of each axis.
SurveyedPoint ReadPoint(const TextRow& row) {
  SurveyedPoint point;
  point.name = row.Text(0, "name");
  point.position = Position(row, 1);
  point.place = row.place();
  if (row.words.size() == 6) point.sigma = {Sigma(row, 4), Sigma(row, 4), Sigma(row, 5)};
  if (row.words.size() == 7) point.sigma = {Sigma(row, 4), Sigma(row, 5), Sigma(row, 6)};
  if (row.words.size() == 5 || row.words.size() > 7) {
    throw ErrorAt(
        row.place(),
        Sentence("listValues",
                 "{count} values, expected name x y z, then nothing, or accuracies of plan "
                 "and height, or of x, y and z",
                 {{"count", int(row.words.size())}}));
  }
  return point;
}

}  // namespace

bool IsOdmList(const SurveyText& text) {
  const std::vector<TextRow> rows = OdmRows(text);
  static const std::array<std::string, 6> kStarts = {"EPSG:", "epsg:", "+proj",
                                                     "+init", "WGS84", "NONE"};
  const std::string& first = rows[0].words[0];
  const bool names_system = std::any_of(
      kStarts.begin(), kStarts.end(), [&](const auto& start) { return first.starts_with(start); });
  return names_system && (rows.size() == 1 || rows[1].words.size() >= 4);
}

bool HasMarksBelowSystem(const SurveyText& text) {
  const std::vector<TextRow> rows = OdmRows(text);
  return rows.size() > 1 && !IsOdmMark(rows[0]) &&
         std::all_of(rows.begin() + 1, rows.end(), IsOdmMark);
}

SurveyFile ReadOdmList(const SurveyText& text) {
  SurveyFile file;
  file.format = "gcp_list.txt of OpenDroneMap or OpenSfM";
  const std::vector<TextRow> rows = OdmRows(text);
  if (rows[0].words.size() > kOdmPhoto && AreNumbers(rows[0], 1, 4)) {
    throw ErrorAt(rows[0].place(),
                  Sentence("odmOneLine",
                           "the coordinate system and the first point stand in one line "
                           "({begin}...), expected a line end behind the system's code",
                           {{"begin", rows[0].words[0].substr(0, 20)}}));
  }
  if (rows[0].words[0] != "NONE") file.crs = Joined(rows[0].words);
  OdmPoints points(&file);
  for (size_t i = 1; i < rows.size(); ++i) {
    const TextRow& row = rows[i];
    if (row.words.size() == 4) {  // POSM's list of points: name X Y Z
      file.points.push_back(ReadPoint(row));
      continue;
    }
    const std::string& photo = row.Text(5, "the image's name");
    const Eigen::Vector2d pixel(row.Number(3, "px"), row.Number(4, "py"));
    const auto name = points.Add(row, row.words.size() > 6 ? row.words[6] : "");
    if (!name) continue;
    file.marks.push_back({PhotoName(photo), *name, pixel, std::nullopt, row.place()});
  }
  points.Finish();
  return file;
}

bool IsAicon(const SurveyText& text) {
  const TextRow& row = text.rows[0];
  return row.words.size() == kAiconColumns && !HasCommas(text) &&
         AreNumbers(row, 0, kAiconColumns - 1);
}

SurveyFile ReadAicon(const SurveyText& text) {
  SurveyFile file;
  for (const TextRow& row : text.rows) {
    if (row.words.size() == kAiconColumns) continue;
    throw row.Error(std::to_string(row.words.size()) + " values, expected 11 as in the first line");
  }
  const bool has_marks = IsAiconMarks(text.rows[0]);
  file.format = has_marks ? "image coordinates of AICON (.phc, mm)" : "points of AICON (.obc, mm)";
  if (has_marks) {
    ReadAiconMarks(text, &file);
  } else {
    ReadAiconPoints(text, &file);
  }
  return file;
}

bool IsMarkList(const SurveyText& text) {
  const TextRow& row = text.rows[0];
  if (!AreNumbers(row, 2, 3)) return false;
  return IsPhotoAt(row, 1) || (IsPhotoAt(row, 0) && (HasCommas(text) || !IsNumber(row, 1)));
}

SurveyFile ReadMarkList(const SurveyText& text) {
  SurveyFile file;
  const bool is_pix4d = IsPhotoAt(text.rows[0], 0);
  file.format = is_pix4d ? "marks of Pix4D" : "marks of MicMac (text)";
  const double shift = is_pix4d ? kPix4dFirstPixelCenter : 0;
  for (const TextRow& row : text.rows) {
    const size_t photo = is_pix4d ? 0 : 1;
    SurveyedMark mark{PhotoName(row.Text(photo, "the image's name")),
                      row.Text(1 - photo, "the point's name"),
                      {row.Number(2, "x") - shift, row.Number(3, "y") - shift},
                      std::nullopt,
                      row.place()};
    file.marks.push_back(mark);
  }
  if (is_pix4d && text.rows[0].words.size() > 4) {
    file.remarks.push_back(
        Sentence("remarkFifthColumn",
                 "its fifth column (zoom or accuracy, by version) is not taken for sigma"));
  }
  return file;
}

bool IsPointList(const SurveyText& text) {
  return AreNumbers(text.rows[0], 1, 3) && !text.rows[0].words[0].empty();
}

SurveyFile ReadPointList(const SurveyText& text) {
  SurveyFile file;
  file.has_axes_of_crs = HasCommas(text);
  file.format = file.has_axes_of_crs ? "points of Pix4D (name, coordinates in the order of their "
                                       "system's axes)"
                                     : "list of points (name X Y Z)";
  for (const TextRow& row : text.rows) {
    SurveyedPoint point = ReadPoint(row);
    if (IsPhotoFileName(point.name)) {  // as COLMAP's model_aligner takes them
      point.name = PhotoName(point.name);
      file.centers.push_back(point);
    } else {
      file.points.push_back(point);
    }
  }
  if (!file.centers.empty()) file.format = "list of camera positions (photo X Y Z, as for COLMAP)";
  return file;
}

}  // namespace insitu
