// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/prepare/relit_photos.h"

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <thread>
#include <utility>

#include "calibration/files/error.h"
#include "calibration/files/sentence.h"
#include "calibration/photo/photograph.h"
#include "radiometry/natural_environment.h"
#include "renderer/live/relit_photo.h"

namespace insitu {
namespace {

constexpr int kLongestSide = 800;  // [px]
constexpr double kMostExposure = 16;
constexpr double kGreyLevel = 0.25;  // of pixels that nothing is known of, in linear light
constexpr size_t kMostKept = 12;     // photographs made smaller, 8 MB each at most
constexpr int kRelitQuality = 90;
const Eigen::Vector3d kLuminanceOfRgb(0.2126, 0.7152, 0.0722);  // Rec. 709

// The mean over the pixels of each new one, in linear light.
Raster MadeSmaller(const Raster& photo) {
  const int longest = std::max(photo.width, photo.height);
  if (longest <= kLongestSide) return photo;
  const double scale = double(kLongestSide) / longest;
  Raster small(std::max(1, int(std::lround(scale * photo.width))),
               std::max(1, int(std::lround(scale * photo.height))));
  const cv::Mat whole(photo.height, photo.width, CV_32FC3, const_cast<float*>(photo.data.data()));
  cv::Mat made(small.height, small.width, CV_32FC3, small.data.data());
  cv::resize(whole, made, made.size(), 0, 0, cv::INTER_AREA);
  return small;
}

// What a picture of one light needs.
struct Exposed {
  std::string jpeg;
  double exposure = 1, share = 0;
};

// As bright as the photograph where it is relit, for the eye; elsewhere grey and dark.
Exposed Expose(const Raster& photo, const Raster& relit, const std::vector<bool>& is_relit) {
  Exposed exposed;
  double before = 0, after = 0;
  for (size_t i = 0; i < is_relit.size(); ++i) {
    if (!is_relit[i]) continue;
    const int x = int(i) % photo.width, y = int(i) / photo.width;
    before += kLuminanceOfRgb.dot(photo.Rgb(x, y));
    after += kLuminanceOfRgb.dot(relit.Rgb(x, y));
    exposed.share += 1. / double(is_relit.size());
  }
  if (after > 0) exposed.exposure = std::clamp(before / after, 1., kMostExposure);
  cv::Mat picture(photo.height, photo.width, CV_8UC3);
  for (int y = 0; y < photo.height; ++y) {
    for (int x = 0; x < photo.width; ++x) {
      const Eigen::Vector3d rgb =
          is_relit[size_t(y) * photo.width + x]
              ? Eigen::Vector3d(exposed.exposure * relit.Rgb(x, y))
              : Eigen::Vector3d::Constant(kGreyLevel * kLuminanceOfRgb.dot(photo.Rgb(x, y)));
      for (int c = 0; c < 3; ++c) {
        picture.at<cv::Vec3b>(y, x)[2 - c] =
            cv::saturate_cast<uint8_t>(255 * SrgbFromLinear(std::clamp(rgb[c], 0., 1.)));
      }
    }
  }
  std::vector<uint8_t> bytes;
  INSITU_CHECK(cv::imencode(".jpg", picture, bytes, {cv::IMWRITE_JPEG_QUALITY, kRelitQuality}));
  exposed.jpeg.assign(bytes.begin(), bytes.end());
  return exposed;
}

RelitPhotos::Answer Refused(int status, const Sentence& why) {
  RelitPhotos::Answer answer;
  answer.status = status;
  why.SayIn(&answer.body, "error");
  return answer;
}

}  // namespace

struct RelitPhotos::Parts {
  using Lights = std::map<std::string, Answer>;  // by "none", "sun"; a fault by both

  explicit Parts(std::vector<std::filesystem::path> paths,
                 std::function<std::shared_ptr<const LiveState>()> newest)
      : photos(std::move(paths)), live(std::move(newest)) {}

  // The index among the scene's cameras.
  std::optional<int> CameraOf(int photo, const NaturalEnvironment& by) const {
    const auto& cameras = by.scene.cameras;
    for (size_t i = 0; i < cameras.size(); ++i) {
      if (photos[photo].stem() == cameras[i].photo) return static_cast<int>(i);
    }
    return std::nullopt;
  }

  // Why there is no light to relight by; its status is 202 while there may be one soon.
  static Answer NoLight(const LiveState& state) {
    if (!state.is_lit() && state.result.scene) return Soon();
    const Json::Value& measured = state.appearance.light;
    if (measured["failed"].isString()) {
      return Refused(409, Sentence("relitFailed", "the light is not measured: {why}",
                                   {{"why", Sentence::SaidIn(measured, "failed").ToJson()}}));
    }
    return Refused(409, Sentence("relitNoLight",
                                 "no light is measured yet: it needs oriented photographs, "
                                 "polygons and samples"));
  }

  static Answer Soon() {
    Answer answer;
    answer.status = 202;
    answer.body = Json::Value(Json::objectValue);
    return answer;
  }

  Answer Ask(int photo, const std::string& light) {
    const std::shared_ptr<const LiveState> state = live();
    const std::shared_ptr<const NaturalEnvironment>& newest = state->appearance.environment;
    if (!newest) return NoLight(*state);
    if (!CameraOf(photo, *newest)) {
      return Refused(409, Sentence("relitNotOriented", "the photograph is not oriented yet"));
    }
    const std::lock_guard lock(mutex);
    if (environment != newest) {
      environment = newest;
      revision = state->appearance.light["revision"];
      made.clear();
      wanted.clear();
    }
    if (const auto found = made.find(photo); found != made.end()) return found->second.at(light);
    if (std::find(wanted.begin(), wanted.end(), photo) == wanted.end()) wanted.push_back(photo);
    asked.notify_one();
    return Soon();
  }

  // By the thread alone.
  const Raster& SmallPhoto(int photo, const PosedCamera& posed) {
    if (const auto found = small.find(photo); found != small.end()) return found->second;
    if (small.size() >= kMostKept) small.clear();
    RequirePhotographSize(photos[photo], posed.camera.width(), posed.camera.height());
    return small[photo] = MadeSmaller(ReadPhotograph(photos[photo]).linear);
  }

  static Answer Made(const std::string& light, const Exposed& exposed) {
    Answer answer;
    answer.body["light"] = light;
    answer.body["exposure"] = exposed.exposure;
    answer.body["share"] = exposed.share;
    answer.jpeg = std::make_shared<const std::string>(exposed.jpeg);
    return answer;
  }

  // Empty: not wanted any more.
  Lights Make(const NaturalEnvironment& of, int photo, const std::function<bool()>& is_stopped) {
    Lights lights;
    try {
      const int camera = CameraOf(photo, of).value();
      const Raster& before = SmallPhoto(photo, of.scene.cameras[camera]);
      const auto relit = RelightPhoto(of, camera, before, is_stopped);
      if (!relit) return lights;
      lights["none"] = Made("none", Expose(before, relit->without_sun, relit->is_relit));
      lights["sun"] = Made("sun", Expose(before, relit->sun_alone, relit->is_relit));
    } catch (const std::exception& error) {
      lights["none"] = lights["sun"] = Refused(409, SentenceOf(error));
    }
    return lights;
  }

  void Work(const std::stop_token& stop) {
    std::unique_lock lock(mutex);
    while (asked.wait(lock, stop, [&] { return !wanted.empty(); })) {
      const int photo = wanted.front();
      const std::shared_ptr<const NaturalEnvironment> by = environment;
      lock.unlock();
      Lights lights = Make(*by, photo, [&] {
        return stop.stop_requested() || live()->appearance.environment != by;
      });
      lock.lock();
      if (environment != by) continue;
      if (!wanted.empty() && wanted.front() == photo) wanted.pop_front();
      if (lights.empty()) continue;
      for (auto& [light, answer] : lights) {
        answer.body["photo"] = photos[photo].stem().string();
        answer.body["revision"] = revision;
      }
      made[photo] = std::move(lights);
    }
  }

  const std::vector<std::filesystem::path> photos;
  const std::function<std::shared_ptr<const LiveState>()> live;
  std::map<int, Raster> small;

  std::mutex mutex;  // of all below
  std::condition_variable_any asked;
  std::shared_ptr<const NaturalEnvironment> environment;  // what is made, is made by
  Json::Value revision;                                   // of this
  std::deque<int> wanted;
  std::map<int, Lights> made;
  std::jthread thread;
};

RelitPhotos::RelitPhotos(std::vector<std::filesystem::path> photos,
                         std::function<std::shared_ptr<const LiveState>()> live)
    : parts_(std::make_unique<Parts>(std::move(photos), std::move(live))) {
  Parts& parts = *parts_;
  parts.thread = std::jthread([&parts](const std::stop_token& stop) { parts.Work(stop); });
}

RelitPhotos::~RelitPhotos() { Stop(); }

void RelitPhotos::Stop() {
  if (!parts_->thread.joinable()) return;
  parts_->thread.request_stop();
  parts_->thread.join();
}

RelitPhotos::Answer RelitPhotos::Ask(int photo, const std::string& light) {
  const bool is_there = photo >= 0 && photo < static_cast<int>(parts_->photos.size());
  if (!is_there || (light != "none" && light != "sun")) {
    return Refused(404, Sentence::Verbatim("no such photograph or light"));
  }
  return parts_->Ask(photo, light);
}

}  // namespace insitu
