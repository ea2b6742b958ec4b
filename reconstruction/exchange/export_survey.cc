// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/exchange/export_survey.h"

#include <map>

#include "calibration/camera_files/dbat_camera.h"
#include "calibration/files/text_table.h"
#include "calibration/files/whole_file.h"
#include "calibration/files/wording.h"
#include "reconstruction/exchange/fit_brown.h"
#include "reconstruction/geometry/coordinate_system.h"

namespace insitu {
namespace {

std::string DigitsOf(const Eigen::Vector3d& v, const std::string& separator) {
  return Digits(v.x()) + separator + Digits(v.y()) + separator + Digits(v.z());
}

// ---- DBAT ----------------------------------------------------------------------------------

// Running numbers from 1, in the order of control points, then of marks.
using Numbers = std::map<std::string, int>;

int NumberOf(const std::string& name, Numbers* numbers) {
  return numbers->emplace(name, static_cast<int>(numbers->size()) + 1).first->second;
}

std::string ControlTable(const Survey& survey, ControlRole role, Numbers* points) {
  std::string table = "# id, label, x, y, z, sx, sy, sz [m]\n";
  for (const ControlPoint& point : survey.control_points) {
    if (point.role != role) continue;
    table += std::to_string(NumberOf(point.name, points)) + "," + point.name + "," +
             DigitsOf(point.position, ",") + "," + DigitsOf(point.sigma, ",") + "\n";
  }
  return table;
}

std::string MarksTable(const Survey& survey, const Numbers& images, Numbers* points) {
  std::string table = "# image, point, x, y, sxy [px, the top-left corner is (0, 0)]\n";
  for (const ImageObservation& mark : survey.observations) {
    const Eigen::Vector2d corner = mark.pixel.array() + kDbatFirstPixelCenter;
    table += std::to_string(images.at(mark.photo)) + "," +
             std::to_string(NumberOf(mark.point, points)) + "," + Digits(corner.x()) + "," +
             Digits(corner.y()) + "," + Digits(mark.sigma_px) + "\n";
  }
  return table;
}

bool AreSame(const Camera& a, const Camera& b) {
  return a.lens_model() == b.lens_model() && a.intrinsics() == b.intrinsics() &&
         a.width() == b.width() && a.height() == b.height();
}

// The distinct cameras, and of each photograph its number from 1.
struct NumberedCameras {
  std::vector<Camera> cameras;
  std::vector<size_t> of_photo;
};

NumberedCameras Numbered(const std::vector<Camera>& of_photo) {
  NumberedCameras numbered;
  for (const Camera& camera : of_photo) {
    size_t i = 0;
    while (i < numbered.cameras.size() && !AreSame(numbered.cameras[i], camera)) ++i;
    if (i == numbered.cameras.size()) numbered.cameras.push_back(camera);
    numbered.of_photo.push_back(i + 1);
  }
  return numbered;
}

std::string ImagesTable(const std::vector<std::filesystem::path>& photographs,
                        const NumberedCameras& cameras, Numbers* images) {
  const bool has_cameras = cameras.cameras.size() > 1;
  std::string table = has_cameras ? "# id, path, camera\n" : "# id, path\n";
  for (size_t i = 0; i < photographs.size(); ++i) {
    const int number = NumberOf(photographs[i].stem().string(), images);
    table += std::to_string(number) + "," + photographs[i].filename().string() +
             (has_cameras ? "," + std::to_string(cameras.of_photo[i]) : "") + "\n";
  }
  return table;
}

std::string CameraXml(const DbatCamera& camera, size_t number) {
  const auto pair = [](double a, double b) { return Digits(a) + "," + Digits(b); };
  return "<camera>\n<id>" + std::to_string(number) +
         "</id>\n<name>insitu</name>\n<unit>mm</unit>\n<sensor>auto," +
         Digits(camera.sensor_mm.y()) + "</sensor>\n<image>" + std::to_string(camera.width) + "," +
         std::to_string(camera.height) + "</image>\n<aspect>" + Digits(camera.aspect) +
         "</aspect>\n<focal>" + Digits(camera.focal_mm) +
         "</focal>\n<model>3</model>\n<nK>3</nK>\n<nP>2</nP>\n<cc>" + Digits(camera.cc_mm) +
         "</cc>\n<pp>" + pair(camera.pp_mm.x(), camera.pp_mm.y()) + "</pp>\n<skew>0</skew>\n<K>" +
         Digits(camera.K[0]) + "," + Digits(camera.K[1]) + "," + Digits(camera.K[2]) + "</K>\n<P>" +
         pair(camera.P[0], camera.P[1]) + "</P>\n</camera>\n";
}

std::string CamerasXml(const std::vector<Camera>& cameras, const std::filesystem::path& folder,
                       std::vector<std::string>* report) {
  std::string xml =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<document "
      "dbat_camera_version=\"1.0\">\n<cameras>\n";
  for (size_t i = 0; i < cameras.size(); ++i) {
    const auto fit = FitBrown(cameras[i]);
    if (!fit) throw InputError(folder, "no lens model of DBAT's comes near the camera's");
    xml += CameraXml(DbatFromMetric(fit->lens), i + 1);
    report->push_back("camera " + std::to_string(i + 1) +
                      Formatted(" is approximated by DBAT's model 3: RMS %.3f px, at most %.3f px "
                                "over the frame",
                                fit->rms_px, fit->largest_px));
  }
  return xml + "</cameras>\n</document>\n";
}

std::string ScriptXml(bool has_check_points, bool has_cameras) {
  const std::string format = "<file format=\"id,label,x,y,z,sx,sy,sz\">";
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<document dbat_script_version=\"1.0\">\n"
         "<meta><name>insitu</name><project_unit>m</project_unit></meta>\n"
         "<input base_dir=\"$HERE\">\n<ctrl_pts>" +
         format + "control.txt</file></ctrl_pts>\n" +
         (has_check_points ? "<check_pts>" + format + "check.txt</file></check_pts>\n" : "") +
         "<images image_base_dir=\"$HERE\"><file format=\"id,path" + (has_cameras ? ",cam" : "") +
         "\">images.txt</file></images>\n"
         "<image_pts><file format=\"im,id,x,y,sxy\">marks.txt</file></image_pts>\n"
         "<cameras><file>cameras.xml</file></cameras>\n</input>\n"
         "<operations>\n<operation min_rays=\"2\">check_ray_count</operation>\n"
         "<operation><set_initial_values><io>loaded</io><op>loaded</op></set_initial_values>"
         "</operation>\n"
         "<operation><set_bundle_estimate_params><io>false</io><eo><all>true</all></eo>"
         "<op><all>default</all></op></set_bundle_estimate_params></operation>\n"
         "<operation>spatial_resection</operation>\n<operation>forward_intersection</operation>\n"
         "<operation>bundle_adjustment</operation>\n</operations>\n"
         "<output><files base_dir=\"$HERE\"><report><file>report.txt</file></report></files>"
         "</output>\n</document>\n";
}

bool HasCheckPoints(const Survey& survey) {
  for (const ControlPoint& point : survey.control_points) {
    if (point.role == ControlRole::kCheck) return true;
  }
  return false;
}

void Write(const std::filesystem::path& path, const std::string& content, SurveyExport* done) {
  WriteWhole(path, content);
  done->written.push_back(path);
}

}  // namespace

SurveyExport ExportDbat(const Survey& survey, const std::vector<Camera>& cameras,
                        const std::vector<std::filesystem::path>& photographs,
                        const std::filesystem::path& folder) {
  INSITU_CHECK(cameras.size() == photographs.size());
  if (survey.observations.empty()) throw InputError(folder, "there are no marks to export");
  SurveyExport done;
  const NumberedCameras numbered = Numbered(cameras);
  const std::string cameras_xml = CamerasXml(numbered.cameras, folder, &done.report);
  Numbers points, images;
  const bool has_check_points = HasCheckPoints(survey);
  const std::string control = ControlTable(survey, ControlRole::kControl, &points);
  const std::string check = ControlTable(survey, ControlRole::kCheck, &points);
  Write(folder / "control.txt", control, &done);
  if (has_check_points) Write(folder / "check.txt", check, &done);
  Write(folder / "images.txt", ImagesTable(photographs, numbered, &images), &done);
  Write(folder / "marks.txt", MarksTable(survey, images, &points), &done);
  Write(folder / "cameras.xml", cameras_xml, &done);
  Write(folder / "script.xml", ScriptXml(has_check_points, numbered.cameras.size() > 1), &done);
  done.report.push_back(
      "its millimetres are those of a frame 24 mm high; only the scale of the camera's own values "
      "depends on that");
  return done;
}

SurveyExport ExportOdm(const Survey& survey, const std::vector<std::filesystem::path>& photographs,
                       const std::string& crs, const std::filesystem::path& folder) {
  const auto system = CoordinateSystem::FromText(crs);
  if (!system || system->is_local()) {
    throw InputError("--crs", "\"" + crs +
                                  "\" is no coordinate system on the earth, expected for "
                                  "example EPSG:2056");
  }
  std::map<std::string, std::string> files;
  for (const auto& photograph : photographs) {
    files[photograph.stem().string()] = photograph.filename().string();
  }
  std::map<std::string, const ControlPoint*> control;
  for (const ControlPoint& point : survey.control_points) {
    if (point.role == ControlRole::kControl) control[point.name] = &point;
  }
  std::string list = crs + "\n";
  size_t left_out = 0;
  for (const ImageObservation& mark : survey.observations) {
    const auto point = control.find(mark.point);
    if (point == control.end() && ++left_out) continue;
    list += DigitsOf(point->second->position, " ") + " " + Digits(mark.pixel.x()) + " " +
            Digits(mark.pixel.y()) + " " + files.at(mark.photo) + " " + mark.point + "\n";
  }
  if (left_out == survey.observations.size()) {
    throw InputError(folder, "there are no marks of control points to export");
  }
  SurveyExport done;
  Write(folder / "gcp_list.txt", list, &done);
  done.report.push_back("sigmas are left out: the format has no place for them");
  if (left_out) {
    done.report.push_back(std::to_string(left_out) +
                          " marks of check points and of points without coordinates are left out");
  }
  return done;
}

}  // namespace insitu
