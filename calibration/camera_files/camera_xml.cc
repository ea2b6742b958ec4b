// SPDX-License-Identifier: GPL-3.0-or-later
#include <tinyxml2.h>

#include <cmath>
#include <sstream>

#include "calibration/camera_files/camera_file_formats.h"
#include "calibration/files/whole_file.h"

namespace insitu {
namespace fs = std::filesystem;
namespace {

using tinyxml2::XMLElement;

const XMLElement* Find(const XMLElement& camera, const char* name) {
  return camera.FirstChildElement(name);
}

const XMLElement& At(const fs::path& path, const XMLElement& camera, const char* name) {
  const XMLElement* found = Find(camera, name);
  if (found && found->GetText()) return *found;
  throw InputError(path, camera.GetLineNum(), std::string("<") + name + "> is missing");
}

// `count` numbers between commas; fewer only if `may_be_fewer`, the missing ones are 0.
std::vector<double> Numbers(const fs::path& path, const XMLElement& element, size_t count,
                            bool may_be_fewer = false) {
  std::istringstream stream(element.GetText() ? element.GetText() : "");
  std::vector<double> numbers;
  for (std::string cell; std::getline(stream, cell, ',');) {
    std::istringstream text(cell);
    double number = 0;
    if (!(text >> number) || !(text >> std::ws).eof() || !std::isfinite(number)) {
      throw InputError(path, element.GetLineNum(),
                       "\"" + cell + "\" in <" + element.Name() + ">, expected a finite number");
    }
    numbers.push_back(number);
  }
  if (numbers.size() > count || (numbers.size() < count && !may_be_fewer)) {
    throw InputError(path, element.GetLineNum(),
                     std::to_string(numbers.size()) + " numbers in <" + element.Name() +
                         ">, expected " + std::to_string(count));
  }
  numbers.resize(count, 0);
  return numbers;
}

double NumberOr(const fs::path& path, const XMLElement& camera, const char* name, double other) {
  const XMLElement* found = Find(camera, name);
  return found ? Numbers(path, *found, 1)[0] : other;
}

// "width,height" [mm] of the sensor; "auto,height" gives square pixels. DBAT writes the width of an
// adjusted camera as its own aspect has stretched it, and the aspect beside it as 1 - parameter.
Eigen::Vector2d PixelMm(const fs::path& path, const XMLElement& camera,
                        const Eigen::Vector2d& image, double aspect) {
  const XMLElement& sensor = At(path, camera, "sensor");
  const std::string text = sensor.GetText();
  if (text.starts_with("auto,")) {
    std::istringstream height(text.substr(5));
    double height_mm = 0;
    if (height >> height_mm && height_mm > 0) {
      return Eigen::Vector2d::Constant(height_mm / image.y());
    }
  } else {
    const std::vector<double> size = Numbers(path, sensor, 2);
    if (size[0] > 0 && size[1] > 0) {
      return {size[0] / (1 + aspect) / image.x(), size[1] / image.y()};
    }
  }
  throw InputError(path, sensor.GetLineNum(), "\"" + text + "\" in <sensor>, expected millimetres");
}

MetricCamera DbatCamera(const fs::path& path, const XMLElement& xml) {
  const double model = Numbers(path, At(path, xml, "model"), 1)[0];
  const double aspect = 1 - NumberOr(path, xml, "aspect", 1), skew = NumberOr(path, xml, "skew", 0);
  const bool is_read = model == 3 || ((model == 1 || model == 2) && aspect == 0 && skew == 0);
  if (!is_read) {
    throw InputError(path, At(path, xml, "model").GetLineNum(),
                     "a lens model that is not read, expected DBAT's backward model 3 (or 1 or 2 "
                     "with aspect 1 and skew 0)");
  }
  const std::vector<double> image = Numbers(path, At(path, xml, "image"), 2);
  const double c = Numbers(path, At(path, xml, "cc"), 1)[0];
  if (!(c > 0 && image[0] > 0 && image[1] > 0)) {
    throw InputError(path, xml.GetLineNum(),
                     "<cc> or <image> is not positive, expected a "
                     "calibrated camera");
  }
  const std::vector<double> pp = Numbers(path, At(path, xml, "pp"), 2);
  const std::vector<double> k = Numbers(path, At(path, xml, "K"), 3, true);
  const std::vector<double> p = Numbers(path, At(path, xml, "P"), 2, true);
  MetricCamera camera;
  camera.width = static_cast<int>(image[0]);
  camera.height = static_cast<int>(image[1]);
  camera.pixel_mm = PixelMm(path, xml, {image[0], image[1]}, aspect);
  camera.origin_px = {-0.5, -0.5};  // the top left pixel's corner, see the README
  // DBAT gives the principal point with y down, we all positions with y up.
  camera.parameters = {c, pp[0], -pp[1], k[0], k[1], k[2], p[0], p[1], aspect, skew};
  return camera;
}

}  // namespace

CameraFile ReadDbatCamera(const fs::path& path, const CameraFileOptions& options) {
  const std::string text = ReadWhole(path);
  tinyxml2::XMLDocument document;
  if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
    throw InputError(path, document.ErrorLineNum(), "not a complete XML file");
  }
  const XMLElement* root = document.RootElement();
  const XMLElement* cameras = root ? root->FirstChildElement("cameras") : nullptr;
  if (!cameras || !cameras->FirstChildElement("camera")) {
    throw InputError(path, "no camera in it, expected DBAT's <document><cameras><camera>");
  }
  const XMLElement* first = cameras->FirstChildElement("camera");
  for (const XMLElement* xml = first; xml; xml = xml->NextSiblingElement("camera")) {
    const bool is_only = first->NextSiblingElement("camera") == nullptr;
    const XMLElement* id = Find(*xml, "id");
    if (!is_only && !(id && id->GetText() && id->GetText() == options.camera)) continue;
    return MetricCameraFile(path, xml->GetLineNum(), "DBAT XML", DbatCamera(path, *xml));
  }
  throw InputError(path,
                   "holds several cameras, expected one, or to stand in a folder named "
                   "after its <id>");
}

}  // namespace insitu
