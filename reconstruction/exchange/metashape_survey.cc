// SPDX-License-Identifier: GPL-3.0-or-later
#include <map>

#include "reconstruction/exchange/survey_file_formats.h"

namespace insitu {
namespace {

constexpr double kFirstPixelCenter = 0.5;  // "Camera models" of its manual

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
    throw reference.Error(Sentence("xmlAccuracy", "expected a positive accuracy of every axis"));
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
      point.place = marker.place();
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
    if (label == markers.end()) {
      throw marker.Error(Sentence("xmlNoMarker", "a marker_id that no marker has"));
    }
    for (const XmlNode& location : marker.Children("location")) {
      const std::string pinned = location.Attribute("pinned").value_or("false");
      if (pinned != "true" && pinned != "1" && ++unpinned) continue;
      const auto camera = cameras.find(location.RequiredAttribute("camera_id"));
      if (camera == cameras.end()) {
        throw location.Error(Sentence("xmlNoCamera", "a camera_id that no camera has"));
      }
      const Eigen::Vector2d corner(location.NumberAttribute("x"), location.NumberAttribute("y"));
      file->marks.push_back({PhotoName(camera->second), label->second,
                             corner.array() - kFirstPixelCenter, std::nullopt, location.place()});
    }
  }
  if (unpinned) {
    file->remarks.push_back(Sentence(
        "remarkUnpinned", "{count} projections are not pinned, only predicted, and are left out",
        {{"count", unpinned}}));
  }
}

}  // namespace

SurveyFile ReadMetashapeXml(const XmlNode& document) {
  if (!document.Find("chunk")) {
    throw document.Error(
        Sentence("xmlNoChunk",
                 "is neither a chunk of Metashape nor a script of DBAT, expected of Metashape the "
                 "exported markers, of DBAT the script, which names its other files"));
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

}  // namespace insitu
