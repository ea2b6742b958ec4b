// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/tiles/tile_stream.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>
#include <utility>

#include "calibration/color/srgb_table.h"
#include "calibration/files/error.h"
#include "calibration/photo/photograph.h"

namespace insitu {
namespace {

constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr int64_t kMostPixels = 536000000;
constexpr int kMostPhotoSide = 4096;

std::string Base64(const std::vector<uint8_t>& bytes) {
  std::string text;
  for (size_t i = 0; i < bytes.size(); i += 3) {
    uint32_t three = 0;
    for (size_t k = 0; k < 3; ++k) three = three << 8 | (i + k < bytes.size() ? bytes[i + k] : 0);
    for (size_t k = 0; k < 4; ++k) {
      text += i + k > bytes.size() ? '=' : kDigits[three >> (18 - 6 * k) & 63];
    }
  }
  return text;
}

// Empty: it is none.
std::vector<uint8_t> FromBase64(std::string_view text) {
  std::vector<uint8_t> bytes;
  if (text.size() % 4 != 0) return {};
  for (size_t i = 0; i < text.size(); i += 4) {
    uint32_t three = 0;
    int padding = 0;
    for (size_t k = 0; k < 4; ++k) {
      const char letter = text[i + k];
      const char* digit = std::find(kDigits, kDigits + 64, letter);
      if (letter == '=') ++padding;
      if (digit == kDigits + 64 && (letter != '=' || i + 4 != text.size() || k < 2)) return {};
      three = three << 6 | (letter == '=' ? 0 : static_cast<uint32_t>(digit - kDigits));
    }
    for (int k = 0; k < 3 - padding; ++k) {
      bytes.push_back(static_cast<uint8_t>(three >> (16 - 8 * k)));
    }
  }
  return bytes;
}

void AppendRows(const CodeImage& image, std::string* text) {
  for (int y = 0; y < image.height; ++y) {
    for (int i = 0; i < 3 * image.width; ++i) {
      if (i > 0) *text += ' ';
      *text += std::to_string(image.codes[static_cast<size_t>(y) * 3 * image.width + i]);
    }
    *text += '\n';
  }
}

std::vector<std::string> SplitAtBlanks(const std::string& line) {
  std::vector<std::string> words;
  for (size_t at = 0; at < line.size();) {
    const size_t end = std::min(line.find(' ', at), line.size());
    if (end > at) words.push_back(line.substr(at, end - at));
    at = end + 1;
  }
  return words;
}

// -1: it is no number of this range.
int NumberOf(std::string_view word, int most) {
  int value = -1;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size() && value <= most ? value : -1;
}

std::string Printable(std::string text) {
  for (char& letter : text) {
    if (static_cast<unsigned char>(letter) < ' ' || letter == '\x7f') letter = '?';
  }
  return text;
}

int ColumnsOf(int width) { return (width + kRenderTile - 1) / kRenderTile; }

}  // namespace

std::string StreamBegin() { return "insitu-stream 1\n"; }

std::string ImageStatement(const std::string& name, int width, int height) {
  return "image " + Printable(name) + " " + std::to_string(width) + " " + std::to_string(height) +
         " tile " + std::to_string(kRenderTile) + "\n";
}

std::string PhotoStatement(const CodeImage& reduced) {
  std::string text =
      "photo " + std::to_string(reduced.width) + " " + std::to_string(reduced.height) + "\n";
  AppendRows(reduced, &text);
  return text;
}

std::string ProgressStatement(int done, int total) {
  return "progress " + std::to_string(done) + " " + std::to_string(total) + "\n";
}

std::string EndStatement(bool is_whole) { return is_whole ? "end done\n" : "end stopped\n"; }

std::string TileStatement(int width, int height, int index, const std::vector<uint8_t>& codes,
                          StreamCoding coding) {
  const std::string place =
      std::to_string(index % ColumnsOf(width)) + " " + std::to_string(index / ColumnsOf(width));
  if (codes.empty()) return "same " + place + "\n";
  const Tile tile = TileAt(width, height, index);
  const CodeImage image = {tile.right - tile.left, tile.bottom - tile.top, codes};
  std::string text =
      "tile " + place + " " + std::to_string(image.width) + " " + std::to_string(image.height);
  if (coding == StreamCoding::kBase64) return text + " base64\n" + Base64(codes) + "\n";
  text += '\n';
  AppendRows(image, &text);
  return text;
}

std::vector<uint8_t> TileCodes(const FinishedTile& tile, const Raster& photo) {
  if (tile.rgb.empty()) return {};
  const Tile place = TileAt(photo.width, photo.height, tile.index);
  std::vector<uint8_t> codes;
  const float* computed = tile.rgb.data();
  size_t pixel = 0;
  for (int y = place.top; y < place.bottom; ++y) {
    for (int x = place.left; x < place.right; ++x) {
      const bool is_computed = tile.is_computed[pixel++] != 0;
      const float* rgb = is_computed ? computed : photo.At(x, y);
      for (int c = 0; c < 3; ++c) codes.push_back(NearestSrgbCode(rgb[c]));
      if (is_computed) computed += 3;
    }
  }
  return codes;
}

CodeImage Reduced(const Raster& photo, int most) {
  const int step = std::max(1, (std::max(photo.width, photo.height) + most - 1) / most);
  CodeImage image;
  image.width = (photo.width + step - 1) / step;
  image.height = (photo.height + step - 1) / step;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      int count = 0;
      for (int v = y * step; v < std::min((y + 1) * step, photo.height); ++v) {
        for (int u = x * step; u < std::min((x + 1) * step, photo.width); ++u, ++count) {
          sum += photo.Rgb(u, v);
        }
      }
      for (const double mean : sum / count) {
        image.codes.push_back(NearestSrgbCode(static_cast<float>(mean)));
      }
    }
  }
  return image;
}

void StreamedPicture::Refuse(const std::string& what) const {
  throw InputError("stream", line_, what + ", expected what insitu render --stream writes");
}

void StreamedPicture::TakeLine(const std::string& line) {
  ++line_;
  if (!has_begun_) {
    if (line != "insitu-stream 1") Refuse("does not begin with insitu-stream 1");
    has_begun_ = true;
    return;
  }
  if (rows_left_ > 0) return TakeRow(line);
  const std::vector<std::string> words = SplitAtBlanks(line);
  const std::string kind = words.empty() ? "" : words[0];
  if (kind == "image") return Begin(words);
  if (!has_picture()) Refuse("has no image before " + Printable(line.substr(0, 40)));
  if (kind == "tile" || kind == "same" || kind == "photo") return Await(words);
  if (kind == "end" && words.size() == 2) {
    if (words[1] == "done" && done_ < total()) Refuse("ends as done with tiles missing");
    state_ = words[1] == "done" ? State::kDone : State::kStopped;
  } else if (kind != "progress") {
    Refuse("is no statement: " + Printable(line.substr(0, 40)));
  }
}

// The name may hold blanks.
void StreamedPicture::Begin(const std::vector<std::string>& words) {
  const size_t count = words.size();
  if (count < 6 || words[count - 2] != "tile") Refuse("is no image");
  const int width = NumberOf(words[count - 4], 1 << 20);
  const int height = NumberOf(words[count - 3], 1 << 20);
  if (width <= 0 || height <= 0 || int64_t{width} * height > kMostPixels) {
    Refuse("is an image of no size that a photograph has");
  }
  if (NumberOf(words.back(), 1 << 20) != kRenderTile) Refuse("has tiles of another size");
  name_.clear();
  for (size_t i = 1; i + 4 < count; ++i) name_ += (i > 1 ? " " : "") + Printable(words[i]);
  picture_ = {width, height, std::vector<uint8_t>(size_t{3} * width * height, 128)};
  photo_ = {};
  is_done_.assign(TileCount(width, height), 0);
  news_.clear();
  done_ = 0;
  ++pictures_;
  state_ = State::kRunning;
}

void StreamedPicture::Await(const std::vector<std::string>& words) {
  const bool is_photo = words[0] == "photo";
  is_base64_ = words.back() == "base64";
  const size_t expected = words[0] == "tile" ? 5 + is_base64_ : 3;
  if (words.size() != expected) Refuse("is no whole statement: " + words[0]);
  const int a = NumberOf(words[1], 1 << 20), b = NumberOf(words[2], 1 << 20);
  if (is_photo) {
    if (a <= 0 || b <= 0 || a > kMostPhotoSide || b > kMostPhotoSide) Refuse("is no photo");
    block_ = {a, b, {}};
    awaited_ = -1;
    rows_left_ = b;
    return;
  }
  const int columns = ColumnsOf(picture_.width);
  if (a < 0 || b < 0 || a >= columns || b >= total() / columns)
    Refuse("is a tile beyond the image");
  awaited_ = b * columns + a;
  if (words[0] == "same") {
    block_ = {};
    return Finish();
  }
  const Tile tile = TileAt(picture_.width, picture_.height, awaited_);
  block_ = {tile.right - tile.left, tile.bottom - tile.top, {}};
  if (NumberOf(words[3], 1 << 20) != block_.width || NumberOf(words[4], 1 << 20) != block_.height) {
    Refuse("is a tile of another size");
  }
  rows_left_ = is_base64_ ? 1 : block_.height;
}

void StreamedPicture::TakeRow(const std::string& line) {
  --rows_left_;
  if (is_base64_) {
    block_.codes = FromBase64(line);
  } else {
    const size_t before = block_.codes.size();
    for (const std::string& word : SplitAtBlanks(line)) {
      const int code = NumberOf(word, 255);
      if (code < 0) Refuse("holds what is no code of 0 to 255");
      block_.codes.push_back(static_cast<uint8_t>(code));
    }
    if (block_.codes.size() - before != size_t{3} * block_.width)
      Refuse("is a row of another length");
  }
  if (rows_left_ > 0) return;
  if (block_.codes.size() != size_t{3} * block_.width * block_.height) {
    Refuse("is a tile of another length");
  }
  is_base64_ = false;
  Finish();
}

// A tile, or the photograph, is all there.
void StreamedPicture::Finish() {
  if (awaited_ < 0) {
    photo_ = std::exchange(block_, {});
    ShowPhoto();
    return;
  }
  if (!is_done_[awaited_]) ++done_;
  is_done_[awaited_] = 1;
  news_.push_back(awaited_);
  if (block_.codes.empty()) return;  // the photograph's, which is shown
  const Tile tile = TileAt(picture_.width, picture_.height, awaited_);
  for (int y = 0; y < block_.height; ++y) {
    std::copy_n(block_.codes.begin() + static_cast<std::ptrdiff_t>(y) * 3 * block_.width,
                3 * block_.width,
                picture_.codes.begin() +
                    (static_cast<std::ptrdiff_t>(tile.top + y) * picture_.width + tile.left) * 3);
  }
}

void StreamedPicture::ShowPhoto() {
  for (int y = 0; y < picture_.height; ++y) {
    for (int x = 0; x < picture_.width; ++x) {
      const int64_t u = int64_t{x} * photo_.width / picture_.width;
      const int64_t v = int64_t{y} * photo_.height / picture_.height;
      std::copy_n(photo_.codes.begin() + 3 * (v * photo_.width + u), 3,
                  picture_.codes.begin() + 3 * (static_cast<int64_t>(y) * picture_.width + x));
    }
  }
}

std::vector<int> StreamedPicture::TakeNews() { return std::exchange(news_, {}); }

}  // namespace insitu
