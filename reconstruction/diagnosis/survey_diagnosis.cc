// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/diagnosis/survey_diagnosis.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <unordered_map>
#include <unordered_set>

#include "calibration/files/error.h"
#include "reconstruction/diagnosis/control_fit.h"
#include "reconstruction/diagnosis/diagnose_axes.h"
#include "reconstruction/diagnosis/diagnose_copies.h"
#include "reconstruction/diagnosis/diagnose_names.h"
#include "reconstruction/diagnosis/diagnose_positions.h"
#include "reconstruction/diagnosis/diagnose_rows.h"
#include "reconstruction/diagnosis/diagnose_scale.h"

namespace insitu {
namespace {

constexpr double kBadFit = 5;  // [sigma], far beyond chance and beyond sigmas that flatter

bool IsFault(const Diagnosis& diagnosis) { return diagnosis.kind == Diagnosis::Kind::kFault; }

InputError ErrorOf(const Diagnosis& diagnosis) {
  return InputError(diagnosis.place.path, diagnosis.place.line, diagnosis.message.text());
}

void Append(std::vector<Diagnosis> more, std::vector<Diagnosis>* all) {
  std::move(more.begin(), more.end(), std::back_inserter(*all));
}

// The control points and their marks alone: a million other marks need not be looked through for
// every photo.
Survey ControlOf(const Survey& survey) {
  std::unordered_set<std::string> names;
  for (const ControlPoint& point : survey.control_points) names.insert(point.name);
  Survey control;
  control.control_points = survey.control_points;
  for (const ImageObservation& mark : survey.observations) {
    if (names.contains(mark.point)) control.observations.push_back(mark);
  }
  return control;
}

// Marks in millimetres or shares of the sides crowd into the frame's corner, where some far pose
// fits them.
bool AreTiny(const std::vector<ControlMark>& marks, const Camera& camera) {
  constexpr double kTinyShare = 0.06;  // of the frame's longer side
  const double limit = kTinyShare * std::max(camera.width(), camera.height());
  return marks.size() >= 5 && std::all_of(marks.begin(), marks.end(), [&](const ControlMark& mark) {
           return mark.mark->pixel.maxCoeff() < limit;
         });
}

// The photos of which a good part of the marks lies outside: those of another copy. A few are gross
// errors.
std::set<std::string> OverMarkedPhotos(const Survey& survey, const std::vector<std::string>& photos,
                                       const std::vector<Camera>& cameras) {
  constexpr size_t kShare = 10;  // one in so many
  struct Counts {
    const Camera* camera = nullptr;
    size_t marks = 0, outside = 0;
  };
  std::unordered_map<std::string, Counts> counts_of;
  for (size_t i = 0; i < photos.size(); ++i) counts_of[photos[i]].camera = &cameras[i];
  for (const ImageObservation& mark : survey.observations) {
    const auto counts = counts_of.find(mark.photo);
    if (counts == counts_of.end()) continue;
    ++counts->second.marks;
    counts->second.outside += !counts->second.camera->Sees(mark.pixel);
  }
  std::set<std::string> over_marked;
  for (const auto& [photo, counts] : counts_of) {
    if (counts.outside > 0 && kShare * counts.outside >= counts.marks) over_marked.insert(photo);
  }
  return over_marked;
}

}  // namespace

std::vector<Diagnosis> Diagnose(const Survey& survey, const std::vector<std::string>& photos,
                                const std::vector<Camera>& cameras) {
  INSITU_CHECK(photos.size() == cameras.size());
  const DiagnosisInput input{survey, photos, cameras};
  std::vector<Diagnosis> all = DiagnoseRows(survey);
  const bool is_hopeless = std::any_of(all.begin(), all.end(), IsFault);
  if (is_hopeless) return all;  // nothing can fit
  const Survey control = ControlOf(survey);
  const DiagnosisInput of_control{control, photos, cameras};
  const std::set<std::string> over_marked = OverMarkedPhotos(survey, photos, cameras);
  std::vector<ControlFit> fits;
  std::vector<size_t> bad;
  for (size_t photo = 0; photo < photos.size(); ++photo) {
    if (ControlMarksOn(control, photos[photo]).size() < 4) continue;
    const auto fit = FitControl(control, photos, cameras, photo);
    const bool is_good = fit && fit->rms_over_sigma < kBadFit;
    if (is_good) fits.push_back(*fit);
    if (!is_good || AreTiny(ControlMarksOn(control, photos[photo]), cameras[photo]) ||
        over_marked.contains(photos[photo]))
      bad.push_back(photo);
  }
  std::vector<Diagnosis> of_fit;
  if (!bad.empty()) of_fit = DiagnoseAxes(of_control, bad);
  if (!bad.empty() && of_fit.empty()) of_fit = DiagnoseCopies(of_control, bad);
  if (!bad.empty() && of_fit.empty()) of_fit = DiagnoseNames(input, bad);
  Append(DiagnosePositions(input, fits), &of_fit);
  Append(DiagnoseScale(input, fits), &of_fit);
  Append(std::move(all), &of_fit);
  std::stable_sort(of_fit.begin(), of_fit.end(),
                   [](const auto& a, const auto& b) { return a.kind < b.kind; });
  return of_fit;
}

std::vector<Diagnosis> RequireSound(const Survey& survey, const std::vector<std::string>& photos,
                                    const std::vector<Camera>& cameras) {
  std::vector<Diagnosis> diagnoses = Diagnose(survey, photos, cameras);
  for (const Diagnosis& diagnosis : diagnoses) {
    if (IsFault(diagnosis)) throw ErrorOf(diagnosis);
  }
  return diagnoses;
}

void ThrowDiagnosed(const std::vector<Diagnosis>& diagnoses, const InputError& symptom) {
  for (const Diagnosis& diagnosis : diagnoses) {
    if (diagnosis.kind == Diagnosis::Kind::kMisfit) throw ErrorOf(diagnosis);
  }
  throw symptom;
}

}  // namespace insitu
