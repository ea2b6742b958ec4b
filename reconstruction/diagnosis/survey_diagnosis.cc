// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/diagnosis/survey_diagnosis.h"

#include <algorithm>
#include <iterator>

#include "calibration/files/error.h"
#include "reconstruction/diagnosis/control_fit.h"
#include "reconstruction/diagnosis/diagnose_axes.h"
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

bool IsOnPhotographs(const Survey& survey, const std::string& photo, const Camera& camera) {
  return std::all_of(survey.observations.begin(), survey.observations.end(), [&](const auto& mark) {
    return mark.photo != photo || camera.Sees(mark.pixel);
  });
}

}  // namespace

std::vector<Diagnosis> Diagnose(const Survey& survey, const std::vector<std::string>& photos,
                                const std::vector<Camera>& cameras) {
  INSITU_CHECK(photos.size() == cameras.size());
  const DiagnosisInput input{survey, photos, cameras};
  std::vector<Diagnosis> all = DiagnoseRows(survey);
  const bool is_hopeless = std::any_of(all.begin(), all.end(), IsFault);
  if (is_hopeless) return all;  // nothing can fit
  std::vector<ControlFit> fits;
  std::vector<size_t> bad;
  for (size_t photo = 0; photo < photos.size(); ++photo) {
    if (ControlMarksOn(survey, photos[photo]).size() < 4) continue;
    const auto fit = FitControl(survey, photos, cameras, photo);
    const bool is_good = fit && fit->rms_over_sigma < kBadFit;
    if (is_good) fits.push_back(*fit);
    if (!is_good || !IsOnPhotographs(survey, photos[photo], cameras[photo])) bad.push_back(photo);
  }
  std::vector<Diagnosis> of_fit;
  if (!bad.empty()) of_fit = DiagnoseAxes(input, bad);
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
