// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <map>

#include "reconstruction/exchange/dbat_script.h"
#include "reconstruction/exchange/survey_file_formats.h"

namespace insitu {
namespace {

constexpr double kMetashapeFirstPixelCenter = 0.5;  // "Camera models" of its manual

std::string Unquoted(const std::string& text) {  // MMVII writes names in quotes
  const bool is_quoted = text.size() >= 2 && text.front() == '"' && text.back() == '"';
  return is_quoted ? text.substr(1, text.size() - 2) : text;
}

std::vector<double> NumbersOf(const XmlNode& node, size_t count) {
  const std::vector<double> numbers = node.Numbers();
  if (numbers.size() != count) {
    throw node.Error(std::to_string(numbers.size()) + " numbers, expected " +
                     std::to_string(count));
  }
  return numbers;
}

FilePlace PlaceOf(const XmlNode& node) { return {node.path(), node.line()}; }

// ---- Metashape -----------------------------------------------------------------------------

// sxyz, sxy or sx, sy, sz [m], as older and newer versions write them.
std::optional<Eigen::Vector3d> MetashapeSigma(const XmlNode& reference) {
  std::optional<Eigen::Vector3d> sigma;
  const auto set = [&](const char* name, int first, int count) {
    if (!reference.Attribute(name)) return;
    if (!sigma) sigma = Eigen::Vector3d::Zero();
    sigma->segment(first, count).setConstant(reference.NumberAttribute(name));
  };
  set("sxyz", 0, 3);
  set("sxy", 0, 2);
  set("sx", 0, 1);
  set("sy", 1, 1);
  set("sz", 2, 1);
  if (sigma && !(sigma->minCoeff() > 0)) {
    throw reference.Error("expected a positive accuracy of every axis");
  }
  return sigma;
}

std::map<std::string, std::string> MetashapeLabels(const XmlNode& parent,
                                                   const std::string& element) {
  std::map<std::string, std::string> labels;
  for (const XmlNode& list : parent.Children(element + "s")) {
    for (const XmlNode& node : list.Descendants(element)) {
      labels[node.RequiredAttribute("id")] = node.RequiredAttribute("label");
    }
  }
  return labels;
}

void ReadMetashapePoints(const XmlNode& chunk, SurveyFile* file) {
  for (const XmlNode& list : chunk.Children("markers")) {
    for (const XmlNode& marker : list.Descendants("marker")) {
      const auto reference = marker.Find("reference");
      if (!reference || !reference->Attribute("x")) continue;
      SurveyedPoint point;
      point.name = marker.RequiredAttribute("label");
      point.position = {reference->NumberAttribute("x"), reference->NumberAttribute("y"),
                        reference->NumberAttribute("z")};
      point.sigma = MetashapeSigma(*reference);
      const std::string enabled = reference->Attribute("enabled").value_or("true");
      if (enabled == "false" || enabled == "0") point.role = ControlRole::kCheck;
      point.place = PlaceOf(marker);
      file->points.push_back(point);
    }
  }
}

void ReadMetashapeMarks(const XmlNode& chunk, SurveyFile* file) {
  const auto markers = MetashapeLabels(chunk, "marker");
  const auto cameras = MetashapeLabels(chunk, "camera");
  int unpinned = 0;
  const auto frames = chunk.Find("frames");
  for (const XmlNode& marker : frames ? frames->Descendants("marker") : std::vector<XmlNode>()) {
    const auto label = markers.find(marker.RequiredAttribute("marker_id"));
    if (label == markers.end()) throw marker.Error("a marker_id that no marker has");
    for (const XmlNode& location : marker.Children("location")) {
      const std::string pinned = location.Attribute("pinned").value_or("false");
      if (pinned != "true" && pinned != "1" && ++unpinned) continue;
      const auto camera = cameras.find(location.RequiredAttribute("camera_id"));
      if (camera == cameras.end()) throw location.Error("a camera_id that no camera has");
      const Eigen::Vector2d corner(location.NumberAttribute("x"), location.NumberAttribute("y"));
      file->marks.push_back({PhotoName(camera->second), label->second,
                             corner.array() - kMetashapeFirstPixelCenter, std::nullopt,
                             PlaceOf(location)});
    }
  }
  if (unpinned) {
    file->remarks.push_back(std::to_string(unpinned) +
                            " projections are not pinned, only predicted, and are left out");
  }
}

// ---- MicMac --------------------------------------------------------------------------------

// Its samples and converters write 1 for what nobody stated.
std::optional<Eigen::Vector3d> StatedSigma(const Eigen::Vector3d& sigma, const XmlNode& node,
                                           int* unstated) {
  if (!(sigma.minCoeff() > 0)) throw node.Error("expected positive uncertainties");
  if (sigma == Eigen::Vector3d::Ones() && ++*unstated) return std::nullopt;
  return sigma;
}

void ReadMicMacPoints(const XmlNode& root, SurveyFile* file, int* unstated) {
  for (const XmlNode& node : root.Children("OneAppuisDAF")) {
    SurveyedPoint point;
    point.name = node.At("NamePt").Text();
    point.position = Eigen::Vector3d(NumbersOf(node.At("Pt"), 3).data());
    if (const auto sigma = node.Find("Incertitude")) {
      point.sigma = StatedSigma(Eigen::Vector3d(NumbersOf(*sigma, 3).data()), *sigma, unstated);
    }
    point.place = PlaceOf(node);
    file->points.push_back(point);
  }
}

void ReadMicMacMarks(const XmlNode& root, SurveyFile* file) {
  for (const XmlNode& image : root.Children("MesureAppuiFlottant1Im")) {
    const std::string photo = PhotoName(image.At("NameIm").Text());
    for (const XmlNode& node : image.Children("OneMesureAF1I")) {
      file->marks.push_back({photo, node.At("NamePt").Text(),
                             Eigen::Vector2d(NumbersOf(node.At("PtIm"), 2).data()), std::nullopt,
                             PlaceOf(node)});
    }
  }
}

// Variances, the upper triangle row by row: xx xy xz yy yz zz.
void ReadMmviiPoints(const XmlNode& set, SurveyFile* file, int* unstated) {
  for (const XmlNode& node : set.At("Measures").Children("el")) {
    SurveyedPoint point;
    point.name = Unquoted(node.At("Name").Text());
    point.position = Eigen::Vector3d(NumbersOf(node.At("Pt"), 3).data());
    if (const auto variances = node.Find("__Opt__Sigma2")) {
      const std::vector<double> v = NumbersOf(*variances, 6);
      point.sigma =
          StatedSigma(Eigen::Vector3d(v[0], v[3], v[5]).cwiseSqrt(), *variances, unstated);
    }
    point.place = PlaceOf(node);
    file->points.push_back(point);
  }
}

// Variances xx xy yy.
void ReadMmviiMarks(const XmlNode& set, SurveyFile* file, int* unstated) {
  const std::string photo = PhotoName(Unquoted(set.At("NameIm").Text()));
  for (const XmlNode& node : set.At("Measures").Children("el")) {
    SurveyedMark mark{photo, Unquoted(node.At("Name").Text()),
                      Eigen::Vector2d(NumbersOf(node.At("Pt"), 2).data()), std::nullopt,
                      PlaceOf(node)};
    if (const auto variances = node.Find("Sigma2")) {
      const std::vector<double> v = NumbersOf(*variances, 3);
      const double sigma = std::sqrt((v[0] + v[2]) / 2);
      if (!(sigma > 0)) throw variances->Error("expected positive variances");
      if (sigma == 1) {
        ++*unstated;
      } else {
        mark.sigma_px = sigma;
      }
    }
    file->marks.push_back(mark);
  }
}

}  // namespace

SurveyFile ReadMetashapeXml(const XmlNode& document) {
  if (!document.Find("chunk")) {
    throw document.Error(
        "is neither a chunk of Metashape nor a script of DBAT, expected of Metashape the exported "
        "markers, of DBAT the script, which names its other files");
  }
  SurveyFile file;
  file.format = "markers of Metashape (XML)";
  const XmlNode chunk = document.At("chunk");
  if (const auto reference = chunk.Find("reference"); reference && !reference->Text().empty()) {
    file.crs = reference->Text();
  }
  ReadMetashapePoints(chunk, &file);
  ReadMetashapeMarks(chunk, &file);
  return file;
}

SurveyFile ReadMicMacXml(const XmlNode& given) {
  // Some of MicMac's companions write <Global> around what they hold.
  const auto parts = given.Children();
  const XmlNode root = given.Name() == "Global" && !parts.empty() ? parts.front() : given;
  SurveyFile file;
  int unstated = 0;
  if (root.Name() == "DicoAppuisFlottant") {
    file.format = "points of MicMac (DicoAppuisFlottant)";
    ReadMicMacPoints(root, &file, &unstated);
  } else if (root.Name() == "SetOfMesureAppuisFlottants") {
    file.format = "marks of MicMac (SetOfMesureAppuisFlottants)";
    ReadMicMacMarks(root, &file);
  } else if (root.Name() == "Root" && root.Find("Data")) {
    file.format = "MMVII";
    const XmlNode data = root.At("Data");
    if (const auto set = data.Find("SetGCP")) ReadMmviiPoints(*set, &file, &unstated);
    if (const auto set = data.Find("SetMesIm")) ReadMmviiMarks(*set, &file, &unstated);
  } else {
    throw root.Error("is no survey that we know, expected XML of Metashape, MicMac, MMVII or DBAT");
  }
  if (unstated) {
    file.remarks.push_back(std::to_string(unstated) +
                           " uncertainties are 1, which MicMac writes when none was stated");
  }
  return file;
}

SurveyFile ReadDbatSurvey(const std::filesystem::path& path) {
  const DbatScript script = ReadDbatScript(path);
  SurveyFile file;
  file.format = "script of DBAT with its tables";
  int fixed = 0;
  const auto add = [&](const DbatControlPoint& stated, ControlRole role) {
    SurveyedPoint point{stated.id, script.metres_per_unit * stated.position, std::nullopt, role,
                        stated.place};
    if (stated.sigma.isZero(0)) {
      ++fixed;
    } else {
      point.sigma = script.metres_per_unit * stated.sigma;
    }
    file.points.push_back(point);
  };
  for (const DbatControlPoint& point : script.control) add(point, ControlRole::kControl);
  for (const DbatControlPoint& point : script.check) add(point, ControlRole::kCheck);
  std::map<std::string, std::string> photos;
  for (const DbatImage& image : script.images) photos[image.id] = image.photo;
  for (const DbatMark& mark : script.marks) {
    const auto photo = photos.find(mark.image);
    if (photo == photos.end()) {
      throw InputError(mark.place.path, mark.place.line,
                       "image \"" + mark.image + "\" is not in the list of images");
    }
    file.marks.push_back({photo->second, mark.point, mark.pixel.array() - kDbatFirstPixelCenter,
                          mark.sigma_px, mark.place});
  }
  if (fixed)
    file.remarks.push_back(std::to_string(fixed) + " points are fixed there, without sigma");
  return file;
}

}  // namespace insitu
