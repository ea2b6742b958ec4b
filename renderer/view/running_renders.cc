// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/view/running_renders.h"

#include <algorithm>
#include <opencv2/core.hpp>
#include <utility>

#include "calibration/color/srgb_table.h"
#include "calibration/photo/exif.h"
#include "calibration/photo/photograph.h"
#include "calibration/tiles/shown_image.h"

namespace insitu {
namespace {

int CountOf(const PartialHeader& header) { return TileCount(header.width, header.height); }

}  // namespace

UnfinishedPicture::UnfinishedPicture(PictureFile before, const PartialHeader& header)
    : before_(std::move(before)),
      header_(header),
      size_(before_.orientation >= 5 ? Eigen::Vector2i(header.height, header.width)
                                     : Eigen::Vector2i(header.width, header.height)) {}

PyramidSize UnfinishedPicture::Size() { return PyramidSizeOf(size_.x(), size_.y()); }

std::string UnfinishedPicture::Version() {
  return header_.inputs.substr(0, 16) + "-" + std::to_string(done());
}

int UnfinishedPicture::done() const {
  const std::lock_guard lock(mutex_);
  return static_cast<int>(tiles_.size());
}

int UnfinishedPicture::total() const { return CountOf(header_); }

void UnfinishedPicture::Add(std::vector<FinishedTile> tiles) {
  const std::lock_guard lock(mutex_);
  for (FinishedTile& tile : tiles) {
    if (!shown_.empty()) Put(tile);
    const int index = tile.index;
    tiles_[index] = std::move(tile);
  }
}

void UnfinishedPicture::Put(const FinishedTile& finished) {
  const auto tile = insitu::TileAt(header_.width, header_.height, finished.index);
  const float* rgb = finished.rgb.data();
  size_t i = 0;
  for (int y = tile.top; y < tile.bottom; ++y) {
    for (int x = tile.left; x < tile.right; ++x) {
      if (!finished.is_computed[i++]) continue;
      const Eigen::Vector2d at =
          UprightPixel(Eigen::Vector2d(x, y), header_.width, header_.height, before_.orientation);
      auto& pixel = shown_.at<cv::Vec3b>(static_cast<int>(at.y()), static_cast<int>(at.x()));
      for (int c = 0; c < 3; ++c) pixel[2 - c] = NearestSrgbCode(rgb[c]);
      rgb += 3;
    }
  }
}

// Upright pixels turned back, by the orientation that undoes this one.
int UnfinishedPicture::TileAtUpright(int x, int y) const {
  const int turned = before_.orientation;
  const int back = turned == 6 ? 8 : turned == 8 ? 6 : turned;
  const Eigen::Vector2d stored = UprightPixel(Eigen::Vector2d(x, y), size_.x(), size_.y(), back);
  const int columns = (header_.width + kRenderTile - 1) / kRenderTile;
  return static_cast<int>(stored.y()) / kRenderTile * columns +
         static_cast<int>(stored.x()) / kRenderTile;
}

WebResponse UnfinishedPicture::Tile(int level, int x, int y) {
  RequireTile(before_.path.string(), level, x, y);
  const std::lock_guard lock(mutex_);
  if (shown_.empty()) {
    RequirePhotographSize(before_.path, header_.width, header_.height);
    const cv::Mat photo = UprightImage(ReadShownPhotograph(before_.path), before_.orientation);
    shown_ = EightBit(photo, ReadPhotographColor(before_.path)).clone();
    for (const auto& [index, tile] : tiles_) Put(tile);
  }
  return HatchedTile(shown_, level, x, y,
                     [this](int u, int v) { return tiles_.contains(TileAtUpright(u, v)); });
}

Json::Value UnfinishedPicture::Value(int x, int y) {
  RequirePixel(before_.path.string(), x, y);
  {
    const std::lock_guard lock(mutex_);
    if (!tiles_.contains(TileAtUpright(x, y))) {
      Json::Value json;
      json["unfinished"] = true;
      return json;
    }
  }
  Tile(0, x / kTileSize, y / kTileSize);  // so that it is there
  const std::lock_guard lock(mutex_);
  return ValueJson(PixelValueAt(shown_, {}, x, y));
}

std::shared_ptr<UnfinishedPicture> RunningRenders::Of(const std::string& photo) const {
  const std::lock_guard lock(mutex_);
  const auto found = followed_.find(photo);
  return found == followed_.end() ? nullptr : found->second.picture;
}

Json::Value RunningRenders::StateOf(const std::string& photo) const {
  const std::lock_guard lock(mutex_);
  Json::Value json;
  const auto found = followed_.find(photo);
  json["state"] = found == followed_.end() ? "none" : found->second.state;
  if (found == followed_.end() || !found->second.picture) return json;
  json["done"] = found->second.picture->done();
  json["total"] = found->second.picture->total();
  json["frame"] = found->second.frame;
  return json;
}

Json::Value RunningRenders::Take(const std::filesystem::path& photograph, Followed* followed,
                                 PartialRenderReader::News news) {
  const std::string name = photograph.stem().string();
  if (news.is_anew) followed->picture.reset();
  if (!news.header) {
    followed->picture.reset();
  } else if (!followed->picture) {
    const auto before = news.header->frame == "pinhole" ? site_.input_image(name) : photograph;
    followed->picture = std::make_shared<UnfinishedPicture>(
        PictureFile{before, ReadOrientation(photograph)}, *news.header);
    followed->frame = news.header->frame;
  }
  Json::Value message;
  message["type"] = "render";
  message["photo"] = name;
  message["anew"] = news.is_anew;
  message["tiles"] = Json::Value(Json::arrayValue);
  if (!followed->picture) return message;
  const int orientation = ReadOrientation(photograph);
  for (const FinishedTile& tile : news.tiles) {
    const auto at = insitu::TileAt(news.header->width, news.header->height, tile.index);
    const auto corner = [&](int x, int y) {
      return UprightPixel(Eigen::Vector2d(x, y), news.header->width, news.header->height,
                          orientation);
    };
    const Eigen::Vector2d a = corner(at.left, at.top), b = corner(at.right - 1, at.bottom - 1);
    Json::Value box(Json::arrayValue);
    for (const double value : {std::min(a.x(), b.x()), std::min(a.y(), b.y()),
                               std::max(a.x(), b.x()) + 1, std::max(a.y(), b.y()) + 1}) {
      box.append(static_cast<int>(value));
    }
    message["tiles"].append(box);
  }
  followed->picture->Add(std::move(news.tiles));
  return message;
}

std::vector<Json::Value> RunningRenders::Poll(
    const std::vector<std::filesystem::path>& photographs) {
  std::vector<Json::Value> messages;
  for (const std::filesystem::path& photograph : photographs) {
    const std::string name = photograph.stem().string();
    const std::lock_guard lock(mutex_);
    Followed& followed = followed_[name];
    if (!followed.reader) {
      followed.reader = std::make_unique<PartialRenderReader>(site_.partial_render(name));
    }
    PartialRenderReader::News news = followed.reader->Read();
    const std::string state = !news.header ? "none" : news.is_running ? "running" : "waiting";
    const bool is_new = state != followed.state || news.is_anew || !news.tiles.empty();
    if (!is_new) continue;
    followed.state = state;
    Json::Value message = Take(photograph, &followed, std::move(news));
    message["state"] = state;
    if (followed.picture) {
      message["done"] = followed.picture->done();
      message["total"] = followed.picture->total();
    }
    messages.push_back(std::move(message));
  }
  return messages;
}

}  // namespace insitu
