// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/photo/photograph.h"

#include <OpenImageIO/imageio.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <exiv2/exiv2.hpp>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "calibration/files/error.h"
#include "calibration/files/whole_file.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;
using OIIO::ImageInput;
using OIIO::ImageOutput;
using OIIO::ImageSpec;
using OIIO::TypeDesc;

std::string FirstLine(const std::string& text) { return text.substr(0, text.find('\n')); }

std::unique_ptr<ImageInput> Open(const fs::path& path) {
  if (!fs::is_regular_file(path)) throw InputError(path, "no such file, expected a photograph");
  ImageSpec config;
  config.attribute("oiio:RawColor", 1);           // the codes as they stand in the file,
  config.attribute("oiio:UnassociatedAlpha", 1);  // not multiplied by alpha
  auto input = ImageInput::open(path.string(), &config);
  if (!input) throw InputError(path, "not a readable image: " + FirstLine(OIIO::geterror()));
  return input;
}

Encoding EncodingOf(const ImageSpec& spec, const fs::path& path) {
  switch (spec.format.basetype) {
    case TypeDesc::UINT8:
      return Encoding::kSrgb8;
    case TypeDesc::UINT16:
      return Encoding::kSrgb16;
    case TypeDesc::HALF:
    case TypeDesc::FLOAT:
      return Encoding::kLinear;
    default:
      throw InputError(path, std::string("pixels of type ") + spec.format.c_str() +
                                 ", expected 8 or 16 bits, half or float");
  }
}

// All channels, interleaved. Decoders may only warn of a file cut short: a message is a failure.
template <typename Sample>
std::vector<Sample> ReadSamples(ImageInput& input, const fs::path& path) {
  const ImageSpec& spec = input.spec();
  std::vector<Sample> samples(static_cast<size_t>(spec.width) * spec.height * spec.nchannels);
  const bool complete =
      input.read_image(0, 0, 0, spec.nchannels, OIIO::BaseTypeFromC<Sample>::value, samples.data());
  if (!complete || input.has_error()) {
    throw InputError(path, "cut short or damaged: " + FirstLine(input.geterror()));
  }
  return samples;
}

// The first three channels; one or two channels are grey (and alpha).
template <typename Sample>
std::vector<Sample> ReadThreeChannels(ImageInput& input, const fs::path& path) {
  std::vector<Sample> samples = ReadSamples<Sample>(input, path);
  const int channels = input.spec().nchannels;
  if (channels == 3) return samples;
  const bool is_grey = channels < 3;
  std::vector<Sample> three(samples.size() / channels * 3);
  for (size_t i = 0; i * 3 < three.size(); ++i) {
    for (int c = 0; c < 3; ++c) three[3 * i + c] = samples[i * channels + (is_grey ? 0 : c)];
  }
  return three;
}

// The same through `decode`.
template <typename Sample, typename Decode>
Raster Decoded(ImageInput& input, const fs::path& path, const Decode& decode) {
  const std::vector<Sample> samples = ReadThreeChannels<Sample>(input, path);
  Raster raster(input.spec().width, input.spec().height);
  std::transform(samples.begin(), samples.end(), raster.data.begin(), decode);
  return raster;
}

template <typename Code>
const std::vector<float>& LinearTable() {
  static const std::vector<float> table = [] {
    constexpr int kHighest = std::numeric_limits<Code>::max();
    std::vector<float> linear(kHighest + 1);
    for (int code = 0; code <= kHighest; ++code) {
      linear[code] = static_cast<float>(LinearFromSrgb(static_cast<double>(code) / kHighest));
    }
    return linear;
  }();
  return table;
}

template <typename Code>
Raster DecodedCodes(ImageInput& input, const fs::path& path) {
  const std::vector<float>& table = LinearTable<Code>();
  return Decoded<Code>(input, path, [&](Code code) { return table[code]; });
}

void CheckFinite(const Raster& raster, const fs::path& path) {
  for (int y = 0; y < raster.height; ++y) {
    for (int x = 0; x < raster.width; ++x) {
      if (raster.Rgb(x, y).allFinite()) continue;
      throw InputError(path, "pixel (" + std::to_string(x) + ", " + std::to_string(y) +
                                 ") is NaN or infinite, expected finite values");
    }
  }
}

// The nearest code; NaN becomes 0.
template <typename Code>
Code Encoded(float linear) {
  constexpr double kHighest = std::numeric_limits<Code>::max();
  const double clamped = linear > 0 ? std::min(static_cast<double>(linear), 1.0) : 0.0;
  return static_cast<Code>(std::lround(kHighest * SrgbFromLinear(clamped)));
}

template <typename Code>
std::vector<Code> EncodedCodes(const Raster& linear) {
  std::vector<Code> codes(linear.data.size());
  tbb::parallel_for(size_t{0}, static_cast<size_t>(linear.height), [&](size_t y) {
    const size_t row = linear.data.size() / linear.height;
    for (size_t i = y * row; i < (y + 1) * row; ++i) codes[i] = Encoded<Code>(linear.data[i]);
  });
  return codes;
}

template <typename Sample>
void WriteImage(const fs::path& path, ImageSpec spec, const std::vector<Sample>& samples) {
  spec.set_format(OIIO::BaseTypeFromC<Sample>::value);
  const auto output = ImageOutput::create(path.string());
  if (!output) throw std::runtime_error(path.string() + ": " + FirstLine(OIIO::geterror()));
  const bool written = output->open(path.string(), spec) &&
                       output->write_image(spec.format, samples.data()) && output->close();
  if (!written) throw std::runtime_error(path.string() + ": " + FirstLine(output->geterror()));
}

ImageSpec SpecOf(const Raster& raster) {
  INSITU_CHECK(raster.width > 0 && raster.height > 0);
  return ImageSpec(raster.width, raster.height, raster.channels);
}

// The thumbnail is left behind: it shows the photograph before the montage.
void CopyMetadata(const fs::path& source, const fs::path& target) {
  Exiv2::LogMsg::setLevel(Exiv2::LogMsg::mute);  // cameras' own oddities are not the user's
  try {
    const auto from = Exiv2::ImageFactory::open(source.string());
    from->readMetadata();
    Exiv2::ExifData exif = from->exifData();
    Exiv2::ExifThumb(exif).erase();
    const auto to = Exiv2::ImageFactory::open(target.string());
    to->readMetadata();
    to->setExifData(exif);
    to->setXmpData(from->xmpData());
    if (from->iccProfileDefined()) {
      Exiv2::DataBuf profile(from->iccProfile()->pData_, from->iccProfile()->size_);
      to->setIccProfile(profile);
    }
    to->writeMetadata();
  } catch (const Exiv2::Error& error) {
    throw InputError(source, std::string("its metadata cannot be copied: ") + error.what());
  }
}

bool MayHoldMetadata(const fs::path& path) {
  if (!fs::is_regular_file(path)) throw InputError(path, "no such file, expected a photograph");
  return Exiv2::ImageFactory::getType(path.string()) != Exiv2::ImageType::none;
}

}  // namespace

double LinearFromSrgb(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

double SrgbFromLinear(double linear) {
  return linear <= 0.0031308 ? linear * 12.92 : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

Photograph ReadPhotograph(const fs::path& path) {
  const auto input = Open(path);
  const Encoding encoding = EncodingOf(input->spec(), path);
  if (encoding == Encoding::kSrgb8) return {DecodedCodes<uint8_t>(*input, path), encoding};
  if (encoding == Encoding::kSrgb16) return {DecodedCodes<uint16_t>(*input, path), encoding};
  Photograph photo{Decoded<float>(*input, path, [](float value) { return value; }), encoding};
  CheckFinite(photo.linear, path);
  return photo;
}

CodedPhotograph ReadCodedPhotograph(const fs::path& path) {
  const auto input = Open(path);
  CodedPhotograph photo{input->spec().width, input->spec().height, {}};
  switch (EncodingOf(input->spec(), path)) {
    case Encoding::kSrgb8:
      photo.samples = ReadThreeChannels<uint8_t>(*input, path);
      break;
    case Encoding::kSrgb16:
      photo.samples = ReadThreeChannels<uint16_t>(*input, path);
      break;
    case Encoding::kLinear:
      photo.samples = std::move(ReadPhotograph(path).linear.data);  // finite
      break;
  }
  return photo;
}

Eigen::Vector2i ReadPhotographSize(const fs::path& path) {
  const auto input = Open(path);
  return {input->spec().width, input->spec().height};
}

std::string SizeText(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height) + " px";
}

void RequirePhotographSize(const fs::path& path, int width, int height) {
  const Eigen::Vector2i size = ReadPhotographSize(path);
  if (size == Eigen::Vector2i(width, height)) return;
  throw InputError(path, "is " + SizeText(size.x(), size.y()) + ", expected " +
                             SizeText(width, height) + " as its camera was calibrated");
}

bool IsClipped(const Photograph& photo, int x, int y) {
  return photo.encoding != Encoding::kLinear && photo.linear.Rgb(x, y).maxCoeff() >= 1;
}

void WriteExr(const fs::path& path, const Raster& linear) {
  ImageSpec spec = SpecOf(linear);
  spec.attribute("compression", "zip");
  spec.attribute("DateTime", "");  // else the time of writing would change the bytes
  WriteWhole(path, [&](const fs::path& temporary) { WriteImage(temporary, spec, linear.data); });
}

void WritePng(const fs::path& path, const Raster& linear, Encoding encoding) {
  const ImageSpec spec = SpecOf(linear);
  WriteWhole(path, [&](const fs::path& temporary) {
    if (encoding == Encoding::kSrgb8) {
      WriteImage(temporary, spec, EncodedCodes<uint8_t>(linear));
    } else {
      WriteImage(temporary, spec, EncodedCodes<uint16_t>(linear));
    }
  });
}

void WriteJpeg(const fs::path& path, const Raster& linear, const fs::path& metadata_source) {
  ImageSpec spec = SpecOf(linear);
  spec.attribute("CompressionQuality", 95);
  spec.attribute("jpeg:subsampling", "4:4:4");
  WriteWhole(path, [&](const fs::path& temporary) {
    WriteImage(temporary, spec, EncodedCodes<uint8_t>(linear));
    if (MayHoldMetadata(metadata_source)) CopyMetadata(metadata_source, temporary);
  });
}

}  // namespace insitu
