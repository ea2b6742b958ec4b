// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "reconstruction/exchange/survey_file_formats.h"

namespace insitu {
namespace {

std::string Unquoted(const std::string& text) {  // MMVII writes names in quotes
  const bool is_quoted = text.size() >= 2 && text.front() == '"' && text.back() == '"';
  return is_quoted ? text.substr(1, text.size() - 2) : text;
}

std::vector<double> NumbersOf(const XmlNode& node, size_t count) {
  const std::vector<double> numbers = node.Numbers();
  if (numbers.size() != count) {
    throw node.Error(
        Sentence("xmlCount", "{count} numbers, expected {expected}",
                 {{"count", Json::UInt64(numbers.size())}, {"expected", Json::UInt64(count)}}));
  }
  return numbers;
}

// Its samples and converters write 1 for what nobody stated.
std::optional<Eigen::Vector3d> StatedSigma(const Eigen::Vector3d& sigma, const XmlNode& node,
                                           int* unstated) {
  if (!(sigma.minCoeff() > 0)) {
    throw node.Error(Sentence("xmlSigmas", "expected positive uncertainties"));
  }
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
    point.place = node.place();
    file->points.push_back(point);
  }
}

void ReadMicMacMarks(const XmlNode& root, SurveyFile* file) {
  for (const XmlNode& image : root.Children("MesureAppuiFlottant1Im")) {
    const std::string photo = PhotoName(image.At("NameIm").Text());
    for (const XmlNode& node : image.Children("OneMesureAF1I")) {
      file->marks.push_back({photo, node.At("NamePt").Text(),
                             Eigen::Vector2d(NumbersOf(node.At("PtIm"), 2).data()), std::nullopt,
                             node.place()});
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
    point.place = node.place();
    file->points.push_back(point);
  }
}

// Variances xx xy yy.
void ReadMmviiMarks(const XmlNode& set, SurveyFile* file, int* unstated) {
  const std::string photo = PhotoName(Unquoted(set.At("NameIm").Text()));
  for (const XmlNode& node : set.At("Measures").Children("el")) {
    SurveyedMark mark{photo, Unquoted(node.At("Name").Text()),
                      Eigen::Vector2d(NumbersOf(node.At("Pt"), 2).data()), std::nullopt,
                      node.place()};
    if (const auto variances = node.Find("Sigma2")) {
      const std::vector<double> v = NumbersOf(*variances, 3);
      const double sigma = std::sqrt((v[0] + v[2]) / 2);
      if (!(sigma > 0)) {
        throw variances->Error(Sentence("xmlVariances", "expected positive variances"));
      }
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
    throw root.Error(
        Sentence("xmlUnknown",
                 "is no survey that we know, expected XML of Metashape, MicMac, MMVII or DBAT"));
  }
  if (unstated) {
    file.remarks.push_back(Sentence(
        "remarkUnstated", "{count} uncertainties are 1, which MicMac writes when none was stated",
        {{"count", unstated}}));
  }
  return file;
}

}  // namespace insitu
